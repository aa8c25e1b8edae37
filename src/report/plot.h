// Plots as values, and the one writer of gnuplot scripts. gnuplot runs as a program and writes SVG,
// PNG or PDF; nothing else in carom knows it.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "media/output_file.h"

namespace carom {

/// Texts of a plot are plain UTF-8, but for x_{A} and m^{2}, which lower and raise.

enum class SeriesStyle {
    kLine,
    kDashedLine,
    kPoints,
    kLineWithPoints,
    kBand,  ///< the area between `y` and `upper`
};

/// One set of data. `x` and `y` have the same length, `upper` too in a band.
struct Series {
    std::string title;  ///< in the legend; empty: not listed
    SeriesStyle style = SeriesStyle::kLine;
    std::vector<double> x{};
    std::vector<double> y{};
    std::vector<double> upper{};
    std::optional<int> color{};  ///< index into the palette; by default the series' own place
    double width = 2;            ///< of lines, px
};

struct Axis {
    std::string label;  ///< with the unit: "height, m"
    bool logarithmic = false;
    std::optional<double> min{};
    std::optional<double> max{};
};

/// A text in the plot, its left end (or middle) at a point of the axes.
struct PlotText {
    double x = 0;
    double y = 0;
    std::string text;
    bool centered = false;
};

/// For diagrams: an outline, or a disc where `fill` is above 0.
struct PlotCircle {
    double x = 0, y = 0, radius = 1;
    int color = 0;  ///< index into the palette
    bool dashed = false;
    double fill = 0;  ///< opacity
};

struct PlotArrow {
    double from_x = 0, from_y = 0, to_x = 0, to_y = 0;
    int color = 0;
    bool both_ends = false;
    bool head = true;
};

enum class Legend { kTopLeft, kTopRight, kBottomLeft, kBottomRight, kNone };

struct Plot {
    std::string title;
    Axis x;
    Axis y;
    std::vector<Series> series{};
    std::vector<PlotText> texts{};
    std::vector<PlotCircle> circles{};
    std::vector<PlotArrow> arrows{};
    Legend legend = Legend::kTopRight;
    bool diagram = false;  ///< no axes, and a unit of x is as long as a unit of y
    int width_px = 800;    ///< of SVG and PNG; the PDF has the same proportions
    int height_px = 500;
};

enum class PlotFormat { kSvg, kPng, kPdf };

/// By the extension of `path`: .svg, .png or .pdf; nothing for another one.
std::optional<PlotFormat> plot_format_of(std::string_view path);

/// The whole script, with its data, that makes gnuplot write the plot to `output`.
std::string gnuplot_script(const Plot& plot, PlotFormat format, const std::string& output);

/// Draws the plot into `path` (.svg, .png or .pdf), whole or not at all; an existing file is
/// replaced (ask require_writable() before the work). The same plot gives the same bytes.
/// Throws Failure(kRun) where gnuplot is missing (with the package to install) or fails (with its
/// text) or `stop` was requested, Failure(kInput) for another extension, Failure(kOutput) where the
/// file cannot be written.
void write_plot(const Plot& plot, const std::string& path, Existing existing = Existing::kReplace,
                const std::stop_token& stop = {});

/// Throws Failure(kRun) unless gnuplot can be started: ask before the work.
void require_gnuplot(const std::stop_token& stop = {});

}  // namespace carom
