#include "report/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/failure.h"
#include "media/thread_clock.h"
#include "report/closed_form.h"
#include "sim/simulate.h"

namespace carom {

namespace {

/// Perturbed runs that show what rounding does.
constexpr int kPerturbedRuns = 3;

/// A motion is trusted while rounding moves no ball by more than this fraction of a radius.
constexpr double kTrusted = 0.01;

/// Errors grow by at least this before a growth rate is read off them.
constexpr double kGrowth = 1000;

/// A timed run shorter than this is repeated until it has taken as long, s.
constexpr double kShortestTiming = 0.02;

struct Timed {
    SimulationResult result;
    double cpu_s = 0;
};

Timed run_timed(const Scene& scene, const std::stop_token& stop) {
    Timed timed;
    const double start = calling_thread_cpu_s();
    timed.result = simulate(scene, stop);
    timed.cpu_s = calling_thread_cpu_s() - start;
    return timed;
}

Scene with_method(Scene scene, const AccuracyRun& run) {
    scene.simulation.method = run.method;
    scene.simulation.solver = run.solver;
    if (run.method == Method::kFixed) scene.simulation.step = run.step;
    return scene;
}

/// Every coordinate one unit in the last place up or down, or where it was.
Scene perturbed(Scene scene, unsigned seed) {
    std::mt19937 random(seed);
    for (Ball& ball : scene.balls)
        for (double& x : ball.position) {
            const double unit =
                std::max(std::abs(x), ball.radius) * std::numeric_limits<double>::epsilon();
            x += unit * (static_cast<double>(random() % 3) - 1);
        }
    return scene;
}

/// Largest distance so far, per instant: over the perturbed runs.
std::vector<double> divergence(const Scene& scene, const Motion& exact,
                               const AccuracyOptions& options, const std::stop_token& stop) {
    std::vector<double> largest(static_cast<std::size_t>(options.instants) + 1, 0.0);
    for (unsigned seed = 1; seed <= kPerturbedRuns; ++seed) {
        const Motion moved = simulate(perturbed(scene, seed), stop).motion;
        const std::vector<double> apart = distances(exact, moved, exact.duration, options.instants);
        for (std::size_t k = 0; k < apart.size(); ++k) largest[k] = std::max(largest[k], apart[k]);
    }
    for (std::size_t k = 1; k < largest.size(); ++k)
        largest[k] = std::max(largest[k], largest[k - 1]);
    return largest;
}

Sensitivity sensitivity_of(const Scene& scene, const Motion& exact, const AccuracyOptions& options,
                           const std::stop_token& stop) {
    double radius = std::numeric_limits<double>::infinity();
    for (const Ball& b : scene.balls) radius = std::min(radius, b.radius);
    const std::vector<double> apart = divergence(scene, exact, options, stop);
    const auto time = [&](std::size_t k) {
        return exact.duration * static_cast<double>(k) / static_cast<double>(apart.size() - 1);
    };
    std::size_t last = apart.size() - 1;
    Sensitivity result;
    for (std::size_t k = 0; k < apart.size(); ++k) {
        if (apart[k] <= kTrusted * radius) continue;
        result.chaotic = true;
        last = k > 0 ? k - 1 : 0;
        break;
    }
    result.trusted_until_s = time(last);
    result.largest_m = apart[last];
    // From the first distance that is more than rounding to the last.
    const auto first = static_cast<std::size_t>(
        std::find_if(apart.begin(), apart.end(), [](double d) { return d > 0; }) - apart.begin());
    if (first < last && apart[last] >= kGrowth * apart[first])
        result.lyapunov_time_s = (time(last) - time(first)) / std::log(apart[last] / apart[first]);
    return result;
}

/// Fills in the error of one row; `cost` keeps the CPU seconds of this first run.
void find_error(const Scene& scene, const Motion& reference, const AccuracyReport& report,
                const AccuracyOptions& options, const std::stop_token& stop, AccuracyRun& run,
                double& cost) {
    try {
        const Timed timed = run_timed(with_method(scene, run), stop);
        cost = timed.cpu_s;
        run.steps = timed.result.report.steps;
        run.impacts = timed.result.report.impacts;
        ErrorOptions how;
        how.until = report.sensitivity.trusted_until_s;
        how.instants = options.instants;
        if (run.method == Method::kFixed)
            how.slowest_impact = 4 * scene.simulation.gravity.norm() * run.step;
        run.error = motion_error(scene, reference, timed.result.motion, how);
    } catch (const Failure& failure) {
        if (stop.stop_requested()) throw;
        run.missing = fmt::format("failed: {}", failure.what());
    }
}

/// The median over timed runs, each as often as a clock needs.
double time_run(const Scene& scene, const AccuracyOptions& options, const std::stop_token& stop,
                double first_cost) {
    std::vector<double> seconds;
    const int in_a_row =
        std::max(1, static_cast<int>(std::ceil(kShortestTiming / std::max(first_cost, 1e-7))));
    for (int i = 0; i < options.repeats; ++i) {
        double sum = 0;
        for (int k = 0; k < in_a_row; ++k) sum += run_timed(scene, stop).cpu_s;
        seconds.push_back(sum / in_a_row);
        if (static_cast<double>(i + 2) * seconds.back() > options.budget_s) break;
    }
    std::nth_element(seconds.begin(),
                     seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                     seconds.end());
    return seconds[seconds.size() / 2];
}

/// The rows of one solver of `fixed`, until one would take too long.
void run_ladder(const Scene& scene, const Motion& reference, Solver solver,
                const AccuracyOptions& options, const std::stop_token& stop,
                const AccuracyProgress& progress, AccuracyReport& report,
                std::vector<double>& costs) {
    double per_step = 0;
    for (const double step : options.steps) {
        AccuracyRun run;
        run.method = Method::kFixed;
        run.solver = solver;
        run.step = step;
        double cost = 0;
        const double expected = per_step * report.duration_s / step;
        if (expected > options.budget_s) {
            run.missing =
                fmt::format("left out: it would take about {:.0f} s of CPU time", expected);
        } else {
            progress(run.name());
            find_error(scene, reference, report, options, stop, run, cost);
            per_step = cost / (report.duration_s / step);
        }
        report.runs.push_back(run);
        costs.push_back(cost);
    }
}

}  // namespace

std::string AccuracyRun::name() const {
    if (method == Method::kExact) return "exact";
    return fmt::format("fixed, {}, step {} s", solver == Solver::kQuick ? "quick" : "world", step);
}

const AccuracyRun* AccuracyReport::cheapest(double relative_error,
                                            std::optional<Method> method) const {
    const AccuracyRun* best = nullptr;
    for (const AccuracyRun& run : runs) {
        if (!run.error || !(run.error->position_relative <= relative_error)) continue;
        if (method && run.method != *method) continue;
        if (best == nullptr || run.cpu_s_per_s < best->cpu_s_per_s) best = &run;
    }
    return best;
}

AccuracyReport measure_accuracy(const Scene& original, const AccuracyOptions& options,
                                const std::stop_token& stop, const AccuracyProgress& progress) {
    Scene scene = original;
    scene.simulation.method = Method::kExact;
    progress("exact");
    const Motion exact = simulate(scene, stop).motion;
    scene.simulation.duration = exact.duration;  // `rest`: the methods run equally long

    AccuracyReport report;
    report.scene = scene.file;
    report.duration_s = exact.duration;
    progress("exact, perturbed by rounding");
    report.sensitivity = sensitivity_of(scene, exact, options, stop);
    const double until = report.sensitivity.trusted_until_s;
    report.extent_m = extent_of(scene, exact, until, options.instants);
    report.sensitivity.largest_relative = report.sensitivity.largest_m / report.extent_m;

    const std::optional<Motion> closed = closed_form_motion(scene, exact);
    report.closed_form = closed.has_value();
    const Motion& reference = closed ? *closed : exact;

    std::vector<double> costs;
    AccuracyRun run;
    double cost = 0;
    find_error(scene, reference, report, options, stop, run, cost);
    if (run.error && !closed) {  // against itself it has no error but what rounding makes of it
        run.error->position_m = report.sensitivity.largest_m;
        run.error->position_relative = report.sensitivity.largest_relative;
    }
    report.runs.push_back(run);
    costs.push_back(cost);
    for (const Solver solver : {Solver::kWorld, Solver::kQuick})
        run_ladder(scene, reference, solver, options, stop, progress, report, costs);

    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        if (!report.runs[i].error) continue;
        progress(report.runs[i].name() + ", timed");
        report.runs[i].cpu_s_per_s =
            time_run(with_method(scene, report.runs[i]), options, stop, costs[i]) /
            report.duration_s;
    }
    return report;
}

}  // namespace carom
