#include "page/plot_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "render/draw2d/round_steps.h"

namespace carom {

std::vector<double> round_values(double low, double high, int count) {
    const double step = step_at_least((high - low) / count);
    std::vector<double> values;
    for (double k = std::ceil(low / step); k * step <= high; ++k) values.push_back(k * step + 0.0);
    return values;
}

std::string PlotFrame::axes(const std::string& across, const std::string& upwards) const {
    std::string text;
    for (const double value : round_values(low, high, 5))
        text += fmt::format(
            "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">{:.6g}</text>\n",
            kLeft, y(value), kRight, kLeft - 6, y(value) + 4, value);
    for (const double value : round_values(begin, end, 6))
        text += fmt::format(
            "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}v5\"/><text x=\"{0:.1f}\" y=\"{2:.1f}\" "
            "text-anchor=\"middle\">{3:.6g}</text>\n",
            x(value), kBottom, kBottom + 18, value);
    return text + fmt::format(
                      "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text><text "
                      "x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
                      kRight, kHeight - 4, across, kRight - 2, kTop + 12, upwards);
}

}  // namespace carom
