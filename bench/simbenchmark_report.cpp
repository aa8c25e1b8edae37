#include "simbenchmark_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "report/plot.h"
#include "report/text_table.h"

namespace carom::bench {

namespace {

const Point* find(const std::vector<Point>& points, const std::string& task,
                  const std::string& engine, double step) {
    for (const Point& p : points)
        if (p.task == task && p.engine == engine && std::abs(p.step - step) < 1e-9) return &p;
    return nullptr;
}

std::vector<std::string> names_of(const std::vector<Point>& points, const std::string& task) {
    std::vector<std::string> names;
    for (const Point& p : points) {
        const std::string& name = task.empty() ? p.task : p.engine;
        if ((task.empty() || p.task == task) &&
            std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    return names;
}

std::string csv(const std::vector<Point>& points) {
    TextTable table;
    for (const char* name : {"task", "engine", "source", "step_s", "error", "worst_error", "seeds",
                             "failed_seeds", "cpu_s", "real_time_factor", "place_error_m"})
        table.columns.push_back({name, name});
    const auto number = [](double value) { return std::isfinite(value) ? Cell(value, 6) : Cell(); };
    for (const Point& p : points)
        table.rows.push_back({p.task, p.engine, "this run", number(p.step), number(p.error),
                              number(p.worst), number(p.seeds), number(p.failed), number(p.cpu_s),
                              number(p.real_time_factor()), number(p.place_error)});
    for (const Published& p : published())
        table.rows.push_back({p.task, p.engine, "published", number(p.step), number(p.error),
                              Cell(), Cell(), Cell(), number(p.seconds), Cell(), Cell()});
    return csv_text(table);
}

const Published* published_at(const std::string& task, const std::string& engine, double step) {
    for (const Published& p : published())
        if (task == p.task && engine == p.engine && std::abs(p.step - step) < 1e-9) return &p;
    return nullptr;
}

/// The median, and what the seeds hide behind it.
std::string error_text(const Point& p) {
    std::string text = fmt::format("{:.6g}", p.error);
    if (p.failed > 0) return text + fmt::format(" ({} of {} seeds fail)", p.failed, p.seeds);
    if (p.seeds > 1) text += fmt::format(" (worst of {} seeds {:.2g})", p.seeds, p.worst);
    return text;
}

std::string markdown(const std::vector<Point>& points, const std::string& task) {
    std::string text =
        "| Engine | Step, s | Error | CPU, s | × real time | Place at the end, m | Published error "
        "|\n"
        "|---|---|---|---|---|---|---|\n";
    for (const Point& p : points) {
        if (p.task != task) continue;
        const Published* theirs = published_at(task, p.engine, p.step);
        text +=
            fmt::format("| {} | {} | {} | {:.3g} | {:.3g} | {} | {} |\n", p.engine,
                        p.step > 0 ? fmt::format("{:g}", p.step) : "events", error_text(p), p.cpu_s,
                        p.real_time_factor(),
                        std::isfinite(p.place_error) ? fmt::format("{:.2g}", p.place_error) : "–",
                        theirs ? fmt::format("{:.6g}", theirs->error) : "–");
    }
    return text;
}

/// 1 / error over the real-time factor: up and to the right is better.
void add_series(Plot& plot, const std::string& title, SeriesStyle style,
                const std::vector<std::array<double, 2>>& factor_and_error, int color) {
    Series series;
    series.title = title;
    series.style = style;
    series.color = color;
    for (const auto& [factor, error] : factor_and_error) {
        if (!(error > 0) || !std::isfinite(error)) continue;
        series.x.push_back(factor);
        series.y.push_back(1 / error);
    }
    if (!series.x.empty()) plot.series.push_back(series);
}

/// One colour per engine, in this run and published.
int color_of(const std::string& engine) {
    const std::vector<std::string> order = {"exact",  "exact, sampled", "ODE world", "ODE quick",
                                            "Bullet", "RaiSim",         "DART",      "MuJoCo"};
    return static_cast<int>(std::find(order.begin(), order.end(), engine) - order.begin());
}

/// For the legend on the left, and for the points at the top.
void leave_room(Plot& plot) {
    double least = 1e300, most = 0, top = 0;
    for (const Series& series : plot.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            least = std::min(least, series.x[i]);
            most = std::max(most, series.x[i]);
            top = std::max(top, series.y[i]);
        }
    if (plot.series.empty()) return;
    plot.x.min = least * std::pow(least / most, 0.5);
    plot.y.max = 30 * top;
}

Plot chart(const std::vector<Point>& points, const std::string& task) {
    Plot plot;
    const std::string unit = task == "666" ? "m^{-2}" : "J^{-2}";
    plot.title = task + ": up is more exact, right is faster";
    plot.x = {"real-time factor, simulated seconds per CPU second", true};
    plot.y = {"1 / error, " + unit, true};
    plot.legend = Legend::kTopLeft;
    plot.width_px = 1000;
    plot.height_px = 600;
    double duration = 0;
    for (const std::string& engine : names_of(points, task)) {
        std::vector<std::array<double, 2>> data;
        for (const Point& p : points)
            if (p.task == task && p.engine == engine) {
                data.push_back({p.real_time_factor(), p.error});
                duration = p.duration;
            }
        add_series(plot, engine, SeriesStyle::kLineWithPoints, data, color_of(engine));
    }
    std::vector<std::string> engines;
    for (const Published& p : published())
        if (task == p.task && std::string("ODE quick") != p.engine &&  // on the other one's line
            std::find(engines.begin(), engines.end(), p.engine) == engines.end())
            engines.push_back(p.engine);
    for (const std::string& engine : engines) {
        std::vector<std::array<double, 2>> data;
        for (const Published& p : published())
            if (task == p.task && engine == p.engine)
                data.push_back({duration / p.seconds, p.error});
        add_series(plot, engine + ", published 2018", SeriesStyle::kDashedLine, data,
                   color_of(engine));
    }
    leave_room(plot);
    return plot;
}

std::string file_name(const std::string& task) {
    std::string name = "simbenchmark_";
    for (const char c : task)
        name += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return name;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string target_row(const std::string& what, const std::string& wanted, const std::string& found,
                       bool reached) {
    return fmt::format("| {} | {} | {} | {} |\n", what, wanted, found, reached ? "yes" : "**no**");
}

std::string bouncing_rows(const std::vector<Point>& points) {
    const Point* ours = find(points, "Bouncing", "exact", 0);
    const Point* sampled = find(points, "Bouncing", "exact, sampled", 1e-3);
    const Point* ode = find(points, "Bouncing", "ODE world", 1e-3);
    if (!ours || !sampled || !ode) return "";
    const double alone = ode->cpu_s / ours->cpu_s, with = ode->cpu_s / sampled->cpu_s;
    return target_row("Bouncing, mean squared energy error", "≤ 1e-18 J²",
                      fmt::format("{:.1e} J²", ours->error), ours->error <= 1e-18) +
           target_row("Bouncing, place at the end", "≤ 1e-9 m",
                      fmt::format("{:.1e} m", ours->place_error), ours->place_error <= 1e-9) +
           target_row("Bouncing, speed against plain ODE at 1 ms, events alone", "≥ 1000 times",
                      fmt::format("{:.0f} times", alone), alone >= 1000) +
           target_row("Bouncing, the same with samples at 1 ms", "≥ 100 times",
                      fmt::format("{:.0f} times", with), with >= 100);
}

std::string pile_rows(const std::vector<Point>& points) {
    std::string text;
    const Point* elastic = find(points, "Elastic 666", "exact", 0);
    const Point* ode = find(points, "Elastic 666", "ODE world", 1e-3);
    if (elastic && ode) {
        const double times = ode->cpu_s / elastic->cpu_s;
        text += target_row(fmt::format("Elastic 666, error, median of {} seeds", elastic->seeds),
                           "≤ 1e-16 J²", fmt::format("{:.1e} J²", elastic->error),
                           elastic->error <= 1e-16) +
                target_row("Elastic 666, speed against plain ODE at 1 ms", "≥ 10 times",
                           fmt::format("{:.1f} times", times), times >= 10);
    }
    const Point* pile = find(points, "666", "exact", 0);
    if (pile)
        text += target_row(fmt::format("666, of {} seeds fail", pile->seeds), "0",
                           fmt::format("{}", pile->failed), pile->failed == 0);
    const Point* coarse = find(points, "666", "ODE world", 1e-3);
    const Point* fine = find(points, "666", "ODE world", 1e-4);
    if (pile && coarse)
        text += target_row("666, CPU time against plain ODE at 1 ms", "less",
                           fmt::format("{:.3g} s of {:.3g} s", pile->cpu_s, coarse->cpu_s),
                           pile->cpu_s < coarse->cpu_s);
    if (pile && fine)
        text += target_row("666, error against plain ODE at 0.1 ms", "below",
                           fmt::format("{:.1e} m² of {:.1e} m²", pile->error, fine->error),
                           pile->error < fine->error);
    return text;
}

}  // namespace

std::string targets_text(const std::vector<Point>& points) {
    const std::string rows = bouncing_rows(points) + pile_rows(points);
    if (rows.empty()) return "";
    return "| What | Wanted | Found | Reached |\n|---|---|---|---|\n" + rows;
}

void write_simbenchmark(const std::vector<Point>& points, const std::string& folder) {
    const std::filesystem::path out = folder;
    std::filesystem::create_directories(out);
    write_text(out / "simbenchmark.csv", csv(points));
    write_text(out / "simbenchmark_targets.md", targets_text(points));
    for (const std::string& task : names_of(points, "")) {
        write_text(out / (file_name(task) + ".md"), markdown(points, task));
        write_plot(chart(points, task), out / (file_name(task) + ".svg"));
    }
}

}  // namespace carom::bench
