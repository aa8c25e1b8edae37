// Points of many runs on a page: a result over what differs between them.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// One series of points; NaN for what is missing.
struct ScatterSeries {
    std::string name;  ///< "" for the only one
    std::vector<double> x, y;
};

struct ScatterPlot {
    std::string across, upwards;  ///< what the axes are of
    std::vector<ScatterSeries> series;
    bool joined = false;  ///< by lines, in the order of x
};

/// An SVG with a list of its series. The scale across goes by powers of ten where the values do:
/// all above 0, and the largest 50 times the smallest or more. Of more than kMostPoints a series
/// every second, third ... one is drawn. "" where no point is there.
std::string scatter_plot(const ScatterPlot& plot);
inline constexpr std::size_t kMostPoints = 2000;
inline constexpr std::size_t kMostSeries = 7;  ///< there are so many colours

}  // namespace carom
