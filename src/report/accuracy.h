// Speed against error of the methods on one scene: `carom accuracy`.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "report/motion_error.h"
#include "scene/scene.h"

namespace carom {

struct AccuracyOptions {
    /// Steps of the method `fixed`, s, from large to small.
    std::vector<double> steps = {1e-2, 4e-3, 1e-3, 4e-4, 1e-4, 4e-5, 1e-5};
    double budget_s = 20;  ///< CPU seconds that one row of the table may take
    int repeats = 3;       ///< timed runs of a row; their median counts
    int instants = 1000;   ///< at which motions are compared
};

/// One method and step on the scene.
struct AccuracyRun {
    Method method = Method::kExact;
    Solver solver = Solver::kWorld;  ///< `fixed` only
    double step = 0;                 ///< s, `fixed` only
    std::optional<MotionError> error;
    double cpu_s_per_s = 0;  ///< median CPU seconds per simulated second
    std::int64_t steps = 0;  ///< of ODE
    std::int64_t impacts = 0;
    std::string missing;  ///< why there is no error: left out, or failed

    std::string name() const;  ///< exact; fixed, world, 0.001 s
};

/// What perturbations of rounding size (one unit in the last place of each coordinate at the start)
/// grow to.
struct Sensitivity {
    bool chaotic = false;        ///< they pass 1 % of the smallest radius before the end
    double trusted_until_s = 0;  ///< the time up to which they do not
    /// In which they grow by e, s; nothing where they grow by less than a thousand.
    std::optional<double> lyapunov_time_s;
    double largest_m = 0;         ///< until then
    double largest_relative = 0;  ///< the same over the extent of the motion
};

struct AccuracyReport {
    std::string scene;
    double duration_s = 0;
    double extent_m = 0;       ///< diagonal of the box around the centres' paths
    bool closed_form = false;  ///< what errors are measured against; else the method `exact`
    Sensitivity sensitivity;
    std::vector<AccuracyRun> runs;  ///< exact first

    /// The cheapest run with a position error of at most this fraction of the extent.
    const AccuracyRun* cheapest(double relative_error, std::optional<Method> method = {}) const;
};

/// Told what is being done: "fixed, world, step 0.001 s".
using AccuracyProgress = std::function<void(const std::string&)>;

/// Runs the scene with all methods: first for the errors, then, separately, for the times.
/// Errors are measured up to Sensitivity::trusted_until_s. Throws Failure(kRun) where `exact` fails
/// or `stop` was requested; where `fixed` fails, its row says so.
AccuracyReport measure_accuracy(const Scene& scene, const AccuracyOptions& options,
                                const std::stop_token& stop, const AccuracyProgress& progress);

/// Which method and step the scene needs for 1 %, 0.1 % and 1e-6 of its extent, and how far its
/// motion can be trusted.
std::string accuracy_summary(const AccuracyReport& report);

}  // namespace carom
