#include "page/sweep_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "core/markup.h"
#include "page/embedded_files.h"
#include "page/frame.h"
#include "page/html_table.h"
#include "page/scatter_plot.h"
#include "sweep/runs/run_record.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPlots = 24;
constexpr std::size_t kMostPictures = 12;
constexpr std::size_t kPictureBytes = 800'000;  // all of them, as PNGs

/// What is no number is NaN.
double number(const std::string& cell) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return error == std::errc() && end == cell.data() + cell.size()
               ? value
               : std::numeric_limits<double>::quiet_NaN();
}

/// One column of the table.
struct Column {
    std::string name;
    std::vector<double> numbers;
    std::vector<std::string> words;  ///< the different cells, as they come; at most kMostSeries + 1
    bool numeric = true;             ///< what is there is numbers

    Column(const RunTable& table, std::size_t index) : name(table.columns[index]) {
        for (const std::vector<std::string>& row : table.rows) {
            const std::string& cell = row[index];
            numbers.push_back(number(cell));
            numeric = numeric && (cell.empty() || !std::isnan(numbers.back()));
            if (words.size() <= kMostSeries &&
                std::find(words.begin(), words.end(), cell) == words.end())
                words.push_back(cell);
        }
    }
    bool varies() const { return words.size() > 1; }
    bool few() const { return words.size() <= kMostSeries; }
};

/// A result over an axis; where one other axis has few values, a series of each.
ScatterPlot plot_of(const RunTable& table, const Column& across, const Column& upwards,
                    std::optional<std::size_t> by) {
    ScatterPlot plot{across.name, upwards.name, {}, by.has_value()};
    std::map<std::string, std::size_t> series;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const std::string key = by ? table.rows[row][*by] : "";
        const auto [place, is_new] = series.emplace(key, plot.series.size());
        if (is_new) plot.series.push_back({by ? table.columns[*by] + " " + key : "", {}, {}});
        plot.series[place->second].x.push_back(across.numbers[row]);
        plot.series[place->second].y.push_back(upwards.numbers[row]);
    }
    return plot;
}

/// Which column tells the series of a plot over `axis` apart: the only other one that varies.
std::optional<std::size_t> series_column(const RunTable& table, const std::vector<Column>& axes,
                                         std::size_t axis) {
    std::optional<std::size_t> other;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (i == axis || !axes[i].varies()) continue;
        if (other || !axes[i].few()) return std::nullopt;
        other = table.axis(i);
    }
    return other;
}

std::string plots(const RunTable& table, const std::vector<Column>& axes,
                  const std::vector<Column>& results) {
    std::string text;
    std::size_t drawn = 0, left_out = 0;
    const auto add = [&](const Column& across, const Column& upwards,
                         std::optional<std::size_t> by) {
        if (drawn == kMostPlots) {
            ++left_out;
            return;
        }
        const std::string svg = scatter_plot(plot_of(table, across, upwards, by));
        if (svg.empty()) return;
        ++drawn;
        text += fmt::format("<figure>{}<figcaption>{} over {}</figcaption></figure>\n", svg,
                            escaped(upwards.name), escaped(across.name));
    };
    const Column run(table, 0);
    for (const Column& result : results) {
        bool shown = false;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if (!axes[i].varies() || !axes[i].numeric) continue;
            add(axes[i], result, series_column(table, axes, i));
            shown = true;
        }
        if (!shown) add(run, result, std::nullopt);
    }
    if (text.empty()) return "";
    return fmt::format("<h2 id=\"plots\">Results</h2>\n<div class=\"many\">\n{}</div>\n{}", text,
                       left_out > 0 ? fmt::format("<p class=\"soft\">{} more of a result over an "
                                                  "axis are not drawn.</p>\n",
                                                  counted(left_out, "plot"))
                                    : "");
}

/// Least, median, mean, largest value and standard deviation of what is there.
std::string summary(const std::vector<Column>& results) {
    HtmlTable table("summary", "Results over all runs that have them",
                    {{"Result"},
                     {"Runs", true},
                     {"Least", true},
                     {"Median", true},
                     {"Mean", true},
                     {"Largest", true},
                     {"Standard deviation", true}});
    for (const Column& result : results) {
        std::vector<double> values;
        for (const double value : result.numbers)
            if (std::isfinite(value)) values.push_back(value);
        std::sort(values.begin(), values.end());
        std::vector<std::string> cells = {escaped(result.name), fmt::format("{}", values.size())};
        if (values.empty()) {
            cells.resize(7);
        } else {
            const std::size_t half = values.size() / 2, count = values.size();
            const double median =
                count % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
            const double mean =
                std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
            double squares = 0;
            for (const double value : values) squares += (value - mean) * (value - mean);
            for (const double value : {values.front(), median, mean, values.back()})
                cells.push_back(fmt::format("{:.6g}", value));
            cells.push_back(
                count < 2
                    ? ""
                    : fmt::format("{:.4g}", std::sqrt(squares / static_cast<double>(count - 1))));
        }
        table.row(cells);
    }
    return table.text();
}

std::string all_runs(const RunTable& table, const std::vector<Column>& axes,
                     const std::vector<Column>& results) {
    std::vector<HtmlColumn> columns = {{"Run", true}};
    for (const Column& axis : axes) columns.push_back({escaped(axis.name), axis.numeric});
    for (const Column& result : results) columns.push_back({escaped(result.name), true});
    columns.insert(columns.end(), {{"Motion's hash"}, {"Status"}});
    const bool reasons = std::any_of(table.rows.begin(), table.rows.end(),
                                     [&](const auto& row) { return !row[table.reason()].empty(); });
    if (reasons) columns.push_back({"Reason"});
    const std::size_t shown = std::min(kMostRows, table.rows.size());
    std::string caption = "A click on a column's head sorts by it.";
    if (shown < table.rows.size())
        caption += fmt::format(" The first {} of {} runs; the others are in index.csv.", shown,
                               table.rows.size());
    HtmlTable made("runs", caption, columns, true);
    for (std::size_t row = 0; row < shown; ++row) {
        std::vector<std::string> cells;
        for (const std::string& cell : table.rows[row]) cells.push_back(escaped(cell));
        cells.resize(columns.size());
        made.row(cells);
    }
    return made.text();
}

/// ": balls.a.radius 0.1, film.fps 30": of the axes that vary.
std::string values_of(const RunTable& table, const std::vector<Column>& axes, std::size_t row) {
    std::string text;
    for (std::size_t i = 0; i < table.axes; ++i)
        if (axes[i].varies())
            text += fmt::format("{} {} {}", text.empty() ? ":" : ",", axes[i].name,
                                table.rows[row][table.axis(i)]);
    return text;
}

/// The first picture of a run; "" for none. Its size comes from the PNG's header.
std::string picture_of(const RunTable& table, const std::vector<Column>& axes, std::size_t row,
                       std::size_t& bytes_left) {
    const double run = number(table.rows[row].front());
    if (!(run >= 0)) return "";
    const fs::path path =
        fs::path(table.folder) / run_folder(static_cast<std::int64_t>(run)) / "still_000.png";
    std::error_code missing;
    const std::uintmax_t size = fs::file_size(path, missing);
    constexpr std::size_t kHeader = 24;  // up to width and height
    if (missing || size > bytes_left || size < kHeader) return "";
    std::ifstream stream(path, std::ios::binary);
    const std::string png{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (png.size() < kHeader || png.compare(1, 3, "PNG") != 0) return "";
    bytes_left -= std::min<std::size_t>(bytes_left, png.size());
    const auto pixels = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            value = value << 8 | static_cast<unsigned char>(png[i]);
        return value;
    };
    const std::string what =
        fmt::format("Run {}{}", table.rows[row].front(), values_of(table, axes, row));
    return fmt::format(
        "<figure><img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\"><figcaption>{}"
        "</figcaption></figure>\n",
        pixels(16), pixels(20), escaped(what), data_uri("image/png", png), escaped(what));
}

/// Of runs spread evenly over all.
std::string pictures(const RunTable& table, const std::vector<Column>& axes) {
    std::string text;
    std::size_t bytes_left = kPictureBytes;
    const std::size_t count = std::min(kMostPictures, table.rows.size());
    for (std::size_t k = 0; k < count; ++k)
        text += picture_of(table, axes, k * table.rows.size() / count, bytes_left);
    return text.empty() ? ""
                        : fmt::format(
                              "<h2 id=\"pictures\">Pictures of some runs</h2>\n<div class=\"many\">"
                              "\n{}</div>\n",
                              text);
}

std::string facts(const RunTable& table) {
    std::string text = "<h2 id=\"provenance\">Where it comes from</h2>\n<dl>\n";
    const auto fact = [&](std::string_view name, std::string_view value) {
        text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(value));
    };
    fact("seed", table.seed);
    fact("sweep's fingerprint", table.fingerprint);
    fact("hash of all motions", table.motion_hash);
    for (const auto& [name, version] : table.versions) fact(name, version);
    return text + "</dl>\n";
}

}  // namespace

std::string sweep_page(const RunTable& table, const std::string& version) {
    // "out/sweep/" has an empty last part.
    const fs::path folder = fs::absolute(table.folder).lexically_normal();
    const std::string name =
        (folder.has_filename() ? folder : folder.parent_path()).filename().string();
    const std::string title = fmt::format("{}: {}", name, counted(table.rows.size(), "run"));
    std::string counts;
    for (const auto& [what, count] : table.counts)
        if (what != "runs" && count != "0")
            counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, what);
    std::vector<Column> axes, results;
    for (std::size_t i = 0; i < table.axes; ++i) axes.emplace_back(table, table.axis(i));
    for (std::size_t i = 0; i < table.results; ++i) results.emplace_back(table, table.result(i));
    const EmbeddedFile script = overview_script();
    return page_head(title, {script.hash}) +
           fmt::format(
               "<header><h1>{}</h1>\n<p class=\"soft\">{}</p></header>\n<main>\n{}{}{}"
               "<h2 id=\"table\">All runs</h2>\n{}{}</main>\n<footer><p class=\"soft\">carom "
               "{}</p></footer>\n<script>{}</script>\n</body></html>\n",
               escaped(title), escaped(counts), plots(table, axes, results),
               results.empty() ? "" : "<h2 id=\"numbers\">Numbers</h2>\n" + summary(results),
               pictures(table, axes), all_runs(table, axes, results), facts(table),
               escaped(version), script.text);
}

}  // namespace carom
