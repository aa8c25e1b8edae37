#include "report/plot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "core/check.h"

namespace carom {

namespace {

/// Colours that stay apart for most forms of colour blindness and on paper (after Okabe and Ito,
/// "Color Universal Design", 2008); the last, pale one is for wide lines that lie under others.
constexpr std::array kPalette = {"#0b5fa5", "#d55e00", "#008a62", "#a3508c",
                                 "#b8860b", "#4b5563", "#f0c36d"};
constexpr const char* kInk = "#1f2937";
constexpr const char* kGrid = "#d8dce2";
constexpr const char* kFont = "Inter";

const char* palette(int index) {
    return kPalette[static_cast<std::size_t>(index) % kPalette.size()];
}

/// In single quotes, where only the quote itself is special; what gnuplot's markup would take for a
/// command is marked as text, but for _{ and ^{.
std::string script_text(std::string_view text) {
    std::string out = "'";
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool script = (c == '_' || c == '^') && i + 1 < text.size() && text[i + 1] == '{';
        if (c == '\'') out += '\'';
        if (!script && std::string_view("_^@&~\\").find(c) != std::string_view::npos) out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out + "'";
}

std::string terminal(const Plot& plot, PlotFormat format) {
    // Letters of the same share of the picture in all three: 1 px of the SVG is 1/100 in of the
    // PDF.
    switch (format) {
        case PlotFormat::kSvg:
            return fmt::format("svg size {},{} font '{},14' background '#ffffff' enhanced\n",
                               plot.width_px, plot.height_px, kFont);
        case PlotFormat::kPng:
            return fmt::format("pngcairo size {},{} font '{},10.5' background '#ffffff' enhanced\n",
                               plot.width_px, plot.height_px, kFont);
        case PlotFormat::kPdf:
            break;
    }
    return fmt::format(
        "pdfcairo size {:.2f}in,{:.2f}in font '{},10.5' background '#ffffff' enhanced\n",
        plot.width_px / 100.0, plot.height_px / 100.0, kFont);
}

std::string axis_text(const char* name, const Axis& axis) {
    std::string text =
        fmt::format("set {}label {} tc rgb '{}'\n", name, script_text(axis.label), kInk);
    if (axis.logarithmic)
        text += fmt::format("set logscale {0}\nset format {0} '10^{{%T}}'\n", name);
    const auto bound = [](const std::optional<double>& value) {
        return value ? fmt::format("{}", *value) : std::string("*");
    };
    return text + fmt::format("set {}range [{}:{}]\n", name, bound(axis.min), bound(axis.max));
}

std::string theme(const Plot& plot) {
    std::string text =
        fmt::format("set title {} font ',16' tc rgb '{}'\n", script_text(plot.title), kInk);
    if (plot.diagram)
        return text +
               "unset border\nunset tics\nunset key\nset size ratio -1\nset margins 1,1,1,3\n";
    text += fmt::format(
        "set border 3 lc rgb '{0}' lw 1\nset tics nomirror out scale 0.6 tc rgb '{0}'\n"
        "set grid lc rgb '{1}' lt 1 lw 0.7\n",
        kInk, kGrid);
    switch (plot.legend) {
        case Legend::kTopLeft:
            return text + "set key top left Left reverse samplen 2.5 spacing 1.25\n";
        case Legend::kTopRight:
            return text + "set key top right samplen 2.5 spacing 1.25\n";
        case Legend::kBottomLeft:
            return text + "set key bottom left Left reverse samplen 2.5 spacing 1.25\n";
        case Legend::kBottomRight:
            return text + "set key bottom right samplen 2.5 spacing 1.25\n";
        case Legend::kNone:
            break;
    }
    return text + "unset key\n";
}

std::string shapes(const Plot& plot) {
    std::string text;
    for (const PlotCircle& c : plot.circles)
        text += fmt::format("set object circle at {},{} size {} {} lw 1.6 {} fc rgb '{}' front\n",
                            c.x, c.y, c.radius,
                            c.fill > 0 ? fmt::format("fs transparent solid {} border rgb '{}'",
                                                     c.fill, palette(c.color))
                                       : fmt::format("fs empty border rgb '{}'", palette(c.color)),
                            c.dashed ? "dt 2" : "", palette(c.color));
    for (const PlotArrow& a : plot.arrows)
        text += fmt::format(
            "set arrow from {},{} to {},{} {} filled size screen 0.010,18 lw 1.6 "
            "lc rgb '{}' front\n",
            a.from_x, a.from_y, a.to_x, a.to_y,
            a.both_ends ? "heads" : (a.head ? "head" : "nohead"), palette(a.color));
    for (const PlotText& t : plot.texts)
        text += fmt::format("set label {} at {},{} {} tc rgb '{}' front\n", script_text(t.text),
                            t.x, t.y, t.centered ? "center" : "left", kInk);
    return text;
}

std::string data_block(const Series& series, std::size_t index) {
    CAROM_CHECK(series.x.size(), ==, series.y.size());
    const bool band = series.style == SeriesStyle::kBand;
    if (band) CAROM_CHECK(series.x.size(), ==, series.upper.size());
    std::string text = fmt::format("$data{} << END\n", index);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        // A place that is no number leaves a gap in the line.
        if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i]))
            text += '\n';
        else if (band)
            text += fmt::format("{} {} {}\n", series.x[i], series.y[i], series.upper[i]);
        else
            text += fmt::format("{} {}\n", series.x[i], series.y[i]);
    }
    return text + "END\n";
}

std::string drawn_series(const Series& series, std::size_t index) {
    const char* color = palette(series.color.value_or(static_cast<int>(index)));
    const std::string title =
        series.title.empty() ? "notitle" : "title " + script_text(series.title);
    const std::string source = fmt::format("$data{} using ", index);
    switch (series.style) {
        case SeriesStyle::kLine:
            return fmt::format("{}1:2 with lines lw {} lc rgb '{}' {}", source, series.width, color,
                               title);
        case SeriesStyle::kDashedLine:
            return fmt::format("{}1:2 with lines lw {} dt '-' lc rgb '{}' {}", source, series.width,
                               color, title);
        case SeriesStyle::kPoints:
            return fmt::format("{}1:2 with points pt 7 ps 0.9 lc rgb '{}' {}", source, color,
                               title);
        case SeriesStyle::kLineWithPoints:
            return fmt::format("{}1:2 with linespoints pt 7 ps 0.7 lw {} lc rgb '{}' {}", source,
                               series.width, color, title);
        case SeriesStyle::kBand:
            break;
    }
    return fmt::format(
        "{}1:2:3 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder {}", source,
        color, title);
}

}  // namespace

std::optional<PlotFormat> plot_format_of(std::string_view path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".svg") return PlotFormat::kSvg;
    if (extension == ".png") return PlotFormat::kPng;
    if (extension == ".pdf") return PlotFormat::kPdf;
    return std::nullopt;
}

std::string gnuplot_script(const Plot& plot, PlotFormat format, const std::string& output) {
    std::string script = "set encoding utf8\nset terminal " + terminal(plot, format);
    // No markup in file names: single quotes double, the rest stands for itself.
    std::string name;
    for (const char c : output) name += c == '\'' ? std::string("''") : std::string(1, c);
    script += fmt::format("set output '{}'\n", name);
    script += theme(plot) + axis_text("x", plot.x) + axis_text("y", plot.y) + shapes(plot);
    for (std::size_t i = 0; i < plot.series.size(); ++i) script += data_block(plot.series[i], i);

    script += "plot ";
    for (std::size_t i = 0; i < plot.series.size(); ++i)
        script += (i > 0 ? ", \\\n  " : "") + drawn_series(plot.series[i], i);
    // A diagram has no data: gnuplot draws it around a curve that is nowhere.
    if (plot.series.empty()) script += "1/0 notitle";
    return script + "\nset output\n";
}

}  // namespace carom
