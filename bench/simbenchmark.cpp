// SimBenchmark's tasks with balls (docs/accuracy.md): carom's `exact`, plain ODE and Bullet in one
// run, and the published points beside them.
//   simbenchmark [--quick] [--task NAME]... [--finest SECONDS] [--seeds N] [--out DIR]
// --quick takes a few points and fails unless plain ODE gives the published errors and `exact`
// keeps its bounds of error (not of time). --finest leaves out smaller steps. --out writes
// simbenchmark.csv, simbenchmark.md and one chart per task.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "command_line.h"
#include "engine.h"
#include "piece_sampling.h"
#include "plain_ode.h"
#include "simbenchmark_report.h"
#include "trajectory_measures.h"
#ifdef CAROM_BENCH_BULLET
#include "bullet_world.h"
#endif

namespace {

using namespace carom;
using namespace carom::bench;

constexpr double kSampling = 1e-3;  // s: of SimBenchmark's charts

struct Options {
    bool quick = false;
    std::vector<std::string> tasks;
    double finest = 0;
    int seeds = 10;
    std::string out;
};

struct Stepped {
    std::string name;
    MakeWorld make;
};

std::vector<Stepped> stepped_engines() {
    std::vector<Stepped> engines;
    engines.push_back({"ODE world", [](const Scene& scene, double step) {
                           return make_plain_ode(scene, step, OdeStepper::kWorld);
                       }});
    engines.push_back({"ODE quick", [](const Scene& scene, double step) {
                           return make_plain_ode(scene, step, OdeStepper::kQuick);
                       }});
#ifdef CAROM_BENCH_BULLET
    engines.push_back({"Bullet", make_bullet_world});
#endif
    return engines;
}

std::vector<MakeTask> all_tasks() {
    return {[](std::uint64_t) { return bouncing(); }, elastic_666, inelastic_666};
}

void print(const Point& p) {
    fmt::print("{:<12} {:<15} {:<8g} error {:<12.6g} {:2} seed{} {:9.3e} s  {:9.3e} x real time",
               p.task, p.engine, p.step, p.error, p.seeds, p.seeds == 1 ? " " : "s", p.cpu_s,
               p.real_time_factor());
    if (std::isfinite(p.place_error)) fmt::print("  place off by {:.3e} m", p.place_error);
    if (p.seeds > 1) fmt::print("  worst {:.6g}", p.worst);
    if (p.failed > 0) fmt::print("  {} seeds fail: {}", p.failed, p.failure);
    fmt::print("\n");
    std::fflush(stdout);
}

/// Stepped engines take minutes for a task: three seeds at most, and one below a millisecond.
int seeds_at(double step, int seeds) { return step < 1e-3 ? 1 : std::min(seeds, 3); }

std::vector<Point> full_run(const Options& options) {
    std::vector<Point> points;
    const auto keep = [&](const Point& p) {
        print(p);
        points.push_back(p);
        if (!options.out.empty()) write_simbenchmark(points, options.out);  // it may be stopped
    };
    for (const MakeTask& make : all_tasks()) {
        const Task task = make(1);
        if (!options.tasks.empty() &&
            std::find(options.tasks.begin(), options.tasks.end(), task.name) == options.tasks.end())
            continue;
        for (const Point& p : run_exact(make, kSampling, options.seeds)) keep(p);
        for (const Stepped& engine : stepped_engines())
            for (const double step : task.steps)
                if (step >= options.finest * (1 - 1e-9))
                    keep(run_stepped(make, engine.name, engine.make, step,
                                     seeds_at(step, options.seeds)));
    }
    return points;
}

bool holds(const char* what, double value, double least, double most) {
    const bool inside = value >= least && value <= most;
    fmt::print("{} {}: {:.6g} must be in {:g} ... {:g}\n", inside ? "ok  " : "FAIL", what, value,
               least, most);
    return inside;
}

/// The samples that are timed are those of the motion: against Motion's own evaluation.
bool samples_agree(const Task& task) {
    const Motion motion = simulate(task.scene).motion;
    const std::vector<double> energies = sample_energies(task.scene, motion, 0.01, 500);
    double worst = 0;
    for (std::size_t k = 0; k < energies.size(); ++k) {
        const double expected = total_energy(task.scene, motion, 0.01 * static_cast<double>(k));
        worst = std::max(worst, std::abs(energies[k] / expected - 1));
    }
    return holds((task.name + ", timed samples, relative").c_str(), worst, 0, 1e-12);
}

/// Six printed digits of a published error.
bool reproduces(const MakeTask& make, double step, double published_error) {
    bool all = true;
    const std::vector<Stepped> engines = stepped_engines();
    for (std::size_t i = 0; i < 2; ++i) {  // both of ODE's steppers
        const Point p = run_stepped(make, engines[i].name, engines[i].make, step, 1, false);
        all &= holds((p.task + ", " + p.engine).c_str(), p.error, published_error * (1 - 4e-6),
                     published_error * (1 + 4e-6));
    }
    return all;
}

int quick_run() {
    const std::vector<MakeTask> tasks = all_tasks();
    const std::vector<Stepped> engines = stepped_engines();
    bool ok = reproduces(tasks[0], 1e-3, 185.027);
    ok &= reproduces(tasks[0], 1e-2, 18808.3);
    const Point exact = run_exact(tasks[0], kSampling, 1, false)[0];
    ok &= holds("Bouncing, exact", exact.error, 0, 1e-18);
    ok &= holds("Bouncing, exact, place at the end", exact.place_error, 0, 1e-9);
    ok &= samples_agree(bouncing()) && samples_agree(inelastic_666(1));
    const Point ode = run_stepped(tasks[1], engines[1].name, engines[1].make, 1e-3, 1, false);
    ok &= holds("Elastic 666, ODE quick", ode.error, 112.318 / 2, 112.318 * 2);
    ok &= holds("Elastic 666, exact", run_exact(tasks[1], kSampling, 1, false)[0].error, 0, 1e-16);
    return ok ? 0 : 1;
}

int run(const Options& options) {
    fmt::print("{}\n", engine_versions());
    if (options.quick) return quick_run();
    const std::vector<Point> points = full_run(options);
    fmt::print("{}", targets_text(points));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App line({}, "simbenchmark");
    line.add_flag("--quick", options.quick, "a few runs, whose errors must hold");
    line.add_option("--task", options.tasks, "a part of a task's name (repeatable)")
        ->allow_extra_args(false);
    line.add_option("--finest", options.finest, "the finest step, s");
    line.add_option("--seeds", options.seeds, "runs of a task")->check(CLI::PositiveNumber);
    line.add_option("--out", options.out, "folder for tables and plots");
    return run_line(line, argc, argv, [&] { return run(options); });
}
