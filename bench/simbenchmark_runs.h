// One engine at one step on one task of SimBenchmark: error passes and timed passes apart.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "simbenchmark_tasks.h"

namespace carom::bench {

/// A point of the chart.
struct Point {
    std::string task;
    std::string engine;  ///< "ODE world"
    double step = 0;     ///< s; 0: events alone
    double error = 0;    ///< median over the seeds
    double worst = 0;    ///< of the seeds
    int seeds = 1;
    int failed = 0;          ///< of the seeds: the engine gave up; their error counts as infinite
    std::string failure;     ///< what it said
    double cpu_s = 0;        ///< median of the timed passes
    double duration = 0;     ///< s simulated
    double place_error = 0;  ///< m, at the end; not a number where there is no closed form
    double real_time_factor() const { return duration / cpu_s; }
};

using MakeTask = std::function<Task(std::uint64_t seed)>;
using MakeWorld = std::function<std::unique_ptr<SteppedWorld>(const Scene&, double step)>;

/// Passes with `seeds` seeds for the error, then, if `timed`, at least one for the time.
Point run_stepped(const MakeTask& make, const std::string& engine, const MakeWorld& world,
                  double step, int seeds, bool timed = true);

/// carom's `exact`: the same errors from samples at `sampling`; two points, without and with the
/// cost of those samples.
std::vector<Point> run_exact(const MakeTask& make, double sampling, int seeds, bool timed = true);

double median(std::vector<double> values);

}  // namespace carom::bench
