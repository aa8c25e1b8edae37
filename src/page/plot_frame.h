// The rectangle of a plot on a page: its two scales, with marks at round values.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// Round values in a range, about so many.
std::vector<double> round_values(double low, double high, int count);

/// From values to pixels of a drawing kWidth by kHeight.
struct PlotFrame {
    static constexpr double kWidth = 480, kHeight = 250;
    static constexpr double kLeft = 50, kRight = 468, kTop = 10, kBottom = 210;

    double begin = 0, end = 1;  ///< from left to right
    double low = 0, high = 1;   ///< from bottom to top

    double x(double value) const {
        return kLeft + (value - begin) / (end - begin) * (kRight - kLeft);
    }
    double y(double value) const {
        return kBottom - (value - low) / (high - low) * (kBottom - kTop);
    }
    /// Lines, numbers and what they are of, as elements of an SVG. The names are markup.
    std::string axes(const std::string& across, const std::string& upwards) const;
};

}  // namespace carom
