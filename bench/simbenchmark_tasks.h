// The tasks of SimBenchmark that have balls only, as their authors define them.
// Source: D. Kang and J. Hwangbo, SimBenchmark, github.com/leggedrobotics/SimBenchmark, benchmark/
// and data/ (2018).
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "sim/simulate.h"
#include "stepped_world.h"

namespace carom::bench {

enum class TaskKind {
    kEnergy,   ///< mean of (E - E0)^2 over the samples, J^2
    kOverlap,  ///< mean over the samples of the sum of overlap^2, m^2
};

struct Task {
    std::string name;  ///< "Bouncing"
    TaskKind kind = TaskKind::kEnergy;
    std::string unit;           ///< of the error: "J²"
    Scene scene;                ///< of the seed
    std::vector<double> steps;  ///< the ladder, s
    bool chaotic = false;       ///< the error is the median over seeds
};

Task bouncing();                         ///< 7 x 7 balls, e = 1, 20 s
Task elastic_666(std::uint64_t seed);    ///< 6 x 6 x 6 balls, e = 1, 10 s
Task inelastic_666(std::uint64_t seed);  ///< the same with e = 0, from the ground

/// The task's error for states at k dt, k = 0 ... n - 1, n = floor(duration / dt): the samples that
/// SimBenchmark takes, before each step.
double stepped_error(const Task& task, SteppedWorld& world, double step);
double motion_error(const Task& task, const Motion& motion, double sampling);

/// The samples of a motion alone, for their cost: energies, or places, of all balls at k dt.
/// Returns a number that depends on all of them.
double sample(const Task& task, const Motion& motion, double sampling);

/// Bouncing's closed form: the largest distance of a ball from where it must be at the end, m.
double bouncing_place_error(const Task& task, const std::vector<Vec3>& places);

/// A point of their chart: without error reduction ("erp 0"), from data/*/sample.csv.
struct Published {
    const char* task;
    const char* engine;
    double step;     ///< s
    double error;    ///< J^2, or m^2
    double seconds;  ///< of their machine
};
const std::vector<Published>& published();

}  // namespace carom::bench
