#include "core/measures_text.h"

#include <fmt/format.h>

#include <cmath>

namespace carom {

std::string measures_text(const ImageMeasures& m) {
    if (!m.same_size) return "the sizes differ";
    if (m.identical()) return "identical";
    return fmt::format(
        "largest difference {:.6g} of 255, {} of {} pixels ({:.4f} %) differ, PSNR {:.2f} dB, "
        "SSIM {:.6f}",
        m.largest, m.differing, m.pixels, 100 * m.differing_fraction(), m.psnr_db, m.ssim);
}

std::string limits_text(const ImageTolerance& limits) {
    return fmt::format("{} of 255 and {:.6g} % of the pixels", limits.channel,
                       100 * limits.differing);
}

std::string missed_text(const ImageTolerance& limits, const ImageMeasures& m) {
    if (!m.same_size) return "the sizes differ";
    std::string text;
    if (m.largest > limits.channel)
        text = fmt::format("off by {:.6g}, {:.6g} more than the {} of 255 allowed", m.largest,
                           m.largest - limits.channel, limits.channel);
    if (m.differing_fraction() > limits.differing) {
        const auto allowed =
            static_cast<std::int64_t>(std::floor(limits.differing * static_cast<double>(m.pixels)));
        text += fmt::format("{}{} pixels differ, {} more than the {} ({:.6g} %) allowed",
                            text.empty() ? "" : "; ", m.differing, m.differing - allowed, allowed,
                            100 * limits.differing);
    }
    return text;
}

}  // namespace carom
