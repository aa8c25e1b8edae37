#include "simbenchmark_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clock.h"
#include "core/failure.h"

namespace carom::bench {

namespace {

constexpr double kEnoughTiming = 0.5;  // CPU seconds of timed passes, after which there is no more
constexpr std::size_t kMostPasses = 201;

template <class Pass>
double median_cpu(const Pass& pass) {
    std::vector<double> seconds;
    double sum = 0;
    while (seconds.empty() || (sum < kEnoughTiming && seconds.size() < kMostPasses)) {
        const double start = cpu_seconds();
        pass();
        seconds.push_back(cpu_seconds() - start);
        sum += seconds.back();
    }
    return median(seconds);
}

double place_error(const Task& task, const std::vector<Vec3>& places) {
    if (task.chaotic) return std::numeric_limits<double>::quiet_NaN();
    return bouncing_place_error(task, places);
}

}  // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Point run_stepped(const MakeTask& make, const std::string& engine, const MakeWorld& world,
                  double step, int seeds, bool timed) {
    const Task task = make(1);
    Point point;
    point.task = task.name;
    point.engine = engine;
    point.step = step;
    point.seeds = task.chaotic ? seeds : 1;
    point.duration = *task.scene.simulation.duration;
    std::vector<double> errors;
    for (int seed = 1; seed <= point.seeds; ++seed) {
        const Task one = make(static_cast<std::uint64_t>(seed));
        const auto stepped = world(one.scene, step);
        errors.push_back(stepped_error(one, *stepped, step));
        std::vector<Vec3> places;
        for (std::size_t i = 0; i < one.scene.balls.size(); ++i)
            places.push_back(stepped->position(i));
        point.place_error = place_error(one, places);
    }
    point.error = median(errors);
    point.worst = *std::max_element(errors.begin(), errors.end());
    if (!timed) return point;
    const auto steps = static_cast<long>(point.duration / step);
    point.cpu_s = median_cpu([&] {
        const auto stepped = world(task.scene, step);
        for (long k = 0; k < steps; ++k) stepped->step();
    });
    return point;
}

std::vector<Point> run_exact(const MakeTask& make, double sampling, int seeds, bool timed) {
    const Task task = make(1);
    Point events;
    events.task = task.name;
    events.engine = "exact";
    events.seeds = task.chaotic ? seeds : 1;
    events.duration = *task.scene.simulation.duration;
    std::vector<double> errors;
    for (int seed = 1; seed <= events.seeds; ++seed) {
        const Task one = make(static_cast<std::uint64_t>(seed));
        try {
            const Motion motion = simulate(one.scene).motion;
            errors.push_back(motion_error(one, motion, sampling));
            std::vector<Vec3> places;
            for (const Trajectory& ball : motion.balls)
                places.push_back(ball.at(motion.duration).position);
            events.place_error = place_error(one, places);
        } catch (const Failure& failure) {
            errors.push_back(std::numeric_limits<double>::infinity());
            ++events.failed;
            events.failure = failure.what();
        }
    }
    events.error = median(errors);
    events.worst = *std::max_element(errors.begin(), errors.end());
    Point sampled = events;
    sampled.engine = "exact, sampled";
    sampled.step = sampling;
    if (!timed) return {events};
    events.cpu_s = median_cpu([&] { simulate(task.scene); });
    volatile double sink = 0;
    sampled.cpu_s = median_cpu([&] { sink = sample(task, simulate(task.scene).motion, sampling); });
    return {events, sampled};
}

}  // namespace carom::bench
