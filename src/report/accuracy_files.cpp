#include "report/accuracy_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "media/output_file.h"

namespace carom {

namespace {

/// Where an error of 0 is drawn: the rounding of a number.
constexpr double kSmallestDrawn = 1e-16;

Cell number_or_empty(double value, int decimals) {
    return std::isfinite(value) ? Cell(value, decimals) : Cell();
}

const char* solver_word(const AccuracyRun& run) {
    if (run.method == Method::kExact) return "";
    return run.solver == Solver::kQuick ? "quick" : "world";
}

nlohmann::ordered_json number_json(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json run_json(const AccuracyRun& run) {
    nlohmann::ordered_json json;
    json["method"] = run.method == Method::kExact ? "exact" : "fixed";
    if (run.method == Method::kFixed) {
        json["solver"] = solver_word(run);
        json["step_s"] = run.step;
    }
    if (!run.error) {
        json["missing"] = run.missing;
        return json;
    }
    const MotionError& e = *run.error;
    json["position_error_m"] = e.position_m;
    json["position_error_rms_m"] = e.position_rms_m;
    json["position_error_relative"] = e.position_relative;
    json["peak_error_relative"] = number_json(e.peak_relative);
    json["peaks"] = e.peaks;
    json["impact_time_error_s"] = number_json(e.impact_time_s);
    json["impacts_compared"] = e.impacts;
    json["impacts_missed"] = e.impacts_missed;
    json["energy_error_relative"] = number_json(e.energy_relative);
    json["penetration_relative"] = e.penetration_relative;
    json["cpu_s_per_s"] = run.cpu_s_per_s;
    json["steps"] = run.steps;
    json["impacts"] = run.impacts;
    return json;
}

Series line_of(const AccuracyReport& report, const std::string& title, Method method, Solver solver,
               double (*error)(const MotionError&)) {
    Series series{.title = title, .style = SeriesStyle::kLineWithPoints, .x = {}, .y = {}};
    for (const AccuracyRun& run : report.runs) {
        if (!run.error || run.method != method) continue;
        if (method == Method::kFixed && run.solver != solver) continue;
        const double value = error(*run.error);
        if (!std::isfinite(value)) continue;
        series.x.push_back(run.cpu_s_per_s);
        series.y.push_back(std::max(value, kSmallestDrawn));
    }
    return series;
}

double position_of(const MotionError& e) { return e.position_relative; }
double peak_of(const MotionError& e) { return e.peak_relative; }

}  // namespace

std::vector<std::string> accuracy_file_names() {
    return {"accuracy.csv", "accuracy.json",      "accuracy.svg",
            "accuracy.png", "accuracy-peaks.svg", "accuracy-peaks.png"};
}

TextTable accuracy_table(const AccuracyReport& report) {
    TextTable table;
    table.columns = {{"method", "Method"},
                     {"solver", "Solver"},
                     {"step_s", "Step [s]"},
                     {"position_error_m", "Position [m]"},
                     {"position_error_rms_m", "Position, rms [m]"},
                     {"position_error_relative", "Position / extent"},
                     {"peak_error_relative", "Peaks, relative"},
                     {"peaks", "Peaks"},
                     {"impact_time_error_s", "Impact times [s]"},
                     {"impacts_compared", "Impacts compared"},
                     {"impacts_missed", "Impacts missed"},
                     {"energy_error_relative", "Energy, relative"},
                     {"penetration_relative", "Overlap / radius"},
                     {"cpu_s_per_s", "CPU s per s"},
                     {"steps", "Steps"},
                     {"impacts", "Impacts"},
                     {"status", "Status"}};
    for (const AccuracyRun& run : report.runs) {
        std::vector<Cell> row = {run.method == Method::kExact ? "exact" : "fixed", solver_word(run),
                                 run.method == Method::kFixed ? Cell(run.step, 6) : Cell()};
        if (run.error) {
            const MotionError& e = *run.error;
            for (const double v :
                 {e.position_m, e.position_rms_m, e.position_relative, e.peak_relative,
                  double(e.peaks), e.impact_time_s, double(e.impacts), double(e.impacts_missed),
                  e.energy_relative, e.penetration_relative, run.cpu_s_per_s, double(run.steps),
                  double(run.impacts)})
                row.push_back(number_or_empty(v, 12));
            row.emplace_back("done");
        } else {
            row.resize(table.columns.size() - 1);
            row.emplace_back(run.missing);
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string accuracy_json(const AccuracyReport& report) {
    nlohmann::ordered_json json;
    json["scene"] = report.scene;
    json["duration_s"] = report.duration_s;
    json["extent_m"] = report.extent_m;
    json["reference"] = report.closed_form ? "closed form" : "exact";
    json["chaotic"] = report.sensitivity.chaotic;
    json["trusted_until_s"] = report.sensitivity.trusted_until_s;
    json["lyapunov_time_s"] = report.sensitivity.lyapunov_time_s
                                  ? nlohmann::ordered_json(*report.sensitivity.lyapunov_time_s)
                                  : nlohmann::ordered_json();
    json["rounding_grows_to_m"] = report.sensitivity.largest_m;
    json["runs"] = nlohmann::ordered_json::array();
    for (const AccuracyRun& run : report.runs) json["runs"].push_back(run_json(run));
    json["summary"] = accuracy_summary(report);
    // File names need be no UTF-8, JSON has to be.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::optional<Plot> work_precision_plot(const AccuracyReport& report, const std::string& measure,
                                        double (*error)(const MotionError&)) {
    Plot plot;
    plot.title = std::filesystem::path(report.scene).stem().string() + ": cost against error";
    plot.x = {.label = "CPU seconds per simulated second", .logarithmic = true};
    plot.y = {.label = measure, .logarithmic = true};
    plot.series = {line_of(report, "exact", Method::kExact, Solver::kWorld, error),
                   line_of(report, "fixed, dWorldStep", Method::kFixed, Solver::kWorld, error),
                   line_of(report, "fixed, QuickStep", Method::kFixed, Solver::kQuick, error)};
    plot.legend = Legend::kBottomRight;  // the lines run along the top
    plot.series[1].width = 5;            // the two solvers often agree: one shows behind the other
    std::erase_if(plot.series, [](const Series& s) { return s.x.empty(); });
    if (plot.series.empty()) return std::nullopt;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Series& s : plot.series)
        for (const double x : s.x) {
            least = std::min(least, x);
            most = std::max(most, x);
        }
    // Whole decades, so that the only point of a line never stands on the frame.
    plot.x.min = std::pow(10.0, std::floor(std::log10(least) - 0.3));
    plot.x.max = std::pow(10.0, std::ceil(std::log10(most) + 0.3));
    plot.y.min = kSmallestDrawn / 10;
    return plot;
}

std::vector<std::string> write_accuracy(const AccuracyReport& report, const std::string& folder,
                                        Existing existing, const std::stop_token& stop) {
    std::vector<std::string> written;
    const auto path = [&](const std::string& name) {
        written.push_back(name);
        return (std::filesystem::path(folder) / name).string();
    };
    write_text_file(path("accuracy.csv"), csv_text(accuracy_table(report)), Durability::kSynced,
                    existing);
    write_text_file(path("accuracy.json"), accuracy_json(report), Durability::kSynced, existing);
    const auto draw = [&](const char* stem, const std::optional<Plot>& plot) {
        if (!plot) return;
        for (const char* extension : {".svg", ".png"})
            write_plot(*plot, path(std::string(stem) + extension), existing, stop);
    };
    draw("accuracy", work_precision_plot(report, "position error / extent", position_of));
    draw("accuracy-peaks", work_precision_plot(report, "relative error of peaks", peak_of));
    return written;
}

}  // namespace carom
