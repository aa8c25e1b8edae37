#include "report/motion_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "geometry/nearest.h"
#include "scene/overlap.h"

namespace carom {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double instant(int k, int instants, double until) {
    return until * static_cast<double>(k) / static_cast<double>(instants);
}

void compare_positions(const Motion& reference, const Motion& motion, const ErrorOptions& options,
                       MotionError& error) {
    double squares = 0;
    for (int k = 0; k <= options.instants; ++k) {
        const double t = instant(k, options.instants, options.until);
        for (std::size_t b = 0; b < reference.balls.size(); ++b) {
            const double d2 =
                (reference.balls[b].at(t).position - motion.balls[b].at(t).position).squaredNorm();
            squares += d2;
            error.position_m = std::max(error.position_m, std::sqrt(d2));
        }
    }
    const double count = double(options.instants + 1) * double(reference.balls.size());
    error.position_rms_m = count > 0 ? std::sqrt(squares / count) : 0;
}

void compare_peaks(const Motion& reference, const Motion& motion, const ErrorOptions& options,
                   MotionError& error) {
    for (std::size_t b = 0; b < reference.balls.size(); ++b) {
        const std::vector<Peak>&expected = reference.peaks[b], &found = motion.peaks[b];
        double highest = 0;
        for (const Peak& p : expected) highest = std::max(highest, p.height);
        for (std::size_t i = 0; i < std::min(expected.size(), found.size()); ++i) {
            if (expected[i].time > options.until) break;
            if (expected[i].height < options.smallest_peak * highest) continue;
            error.peak_relative =
                std::max(error.peak_relative, std::abs(found[i].height / expected[i].height - 1));
            ++error.peaks;
        }
    }
    if (error.peaks == 0) error.peak_relative = kNothing;
}

using PairKey = std::tuple<int, bool, int>;

std::map<PairKey, std::vector<double>> impact_times(const Motion& motion, double slowest,
                                                    double until) {
    std::map<PairKey, std::vector<double>> times;
    for (const Event& e : motion.events)
        if (e.kind == EventKind::kImpact && e.approach_speed > slowest && e.time <= until)
            times[{e.ball, e.other.is_surface, e.other.index}].push_back(e.time);
    return times;
}

void compare_impacts(const Motion& reference, const Motion& motion, const ErrorOptions& options,
                     MotionError& error) {
    const auto expected = impact_times(reference, options.slowest_impact, options.until);
    // What is a little slower, or a little later, may still be the one that is looked for.
    const auto found =
        impact_times(motion, 0.5 * options.slowest_impact, std::numeric_limits<double>::infinity());
    for (const auto& [pair, times] : expected) {
        const auto match = found.find(pair);
        const std::size_t there = match == found.end() ? 0 : match->second.size();
        if (there < times.size()) error.impacts_missed += static_cast<int>(times.size() - there);
        if (there == 0) continue;
        for (const double t : times) {
            const auto after = std::lower_bound(match->second.begin(), match->second.end(), t);
            double nearest = std::numeric_limits<double>::infinity();
            if (after != match->second.end()) nearest = *after - t;
            if (after != match->second.begin()) nearest = std::min(nearest, t - *std::prev(after));
            error.impact_time_s = std::max(error.impact_time_s, nearest);
            ++error.impacts;
        }
    }
    if (error.impacts == 0) error.impact_time_s = kNothing;
}

struct Energy {
    double kinetic = 0;    ///< J
    double potential = 0;  ///< J, 0 at the origin
};

Energy energy_at(const Scene& scene, const Motion& motion, double t) {
    Energy sum;
    for (std::size_t b = 0; b < scene.balls.size(); ++b) {
        const Ball& ball = scene.balls[b];
        const BallState s = motion.balls[b].at(t);
        sum.kinetic += 0.5 * ball.mass *
                       (s.velocity.squaredNorm() +
                        ball.inertia_factor * ball.radius * ball.radius * s.spin.squaredNorm());
        const bool carried = scene.air && scene.air->buoyancy;
        const double weight = carried ? 1 - buoyant_part(*scene.air, ball.radius, ball.mass) : 1;
        sum.potential -= weight * ball.mass * scene.simulation.gravity.dot(s.position);
    }
    return sum;
}

void compare_energy(const Scene& scene, const Motion& reference, const Motion& motion,
                    const ErrorOptions& options, MotionError& error) {
    double squares = 0, largest = 0;
    for (int k = 0; k <= options.instants; ++k) {
        const double t = instant(k, options.instants, options.until);
        const Energy expected = energy_at(scene, reference, t), found = energy_at(scene, motion, t);
        largest = std::max(largest, expected.kinetic);
        const double off = found.kinetic - expected.kinetic + found.potential - expected.potential;
        squares += off * off;
    }
    error.energy_relative =
        largest > 0 ? std::sqrt(squares / (options.instants + 1)) / largest : kNothing;
}

/// Overlap of the two bodies of an impact, at its instant, over the smaller radius.
double overlap_at(const Scene& scene, const Motion& motion, const Event& e) {
    const auto ball = static_cast<std::size_t>(e.ball);
    const auto other = static_cast<std::size_t>(e.other.index);
    const Vec3 x = motion.balls[ball].at(e.time).position;
    const double radius = scene.balls[ball].radius;
    if (e.other.is_surface) return 1 - signed_distance(scene.surfaces[other].shape, x) / radius;
    const double other_radius = scene.balls[other].radius;
    const double distance = (x - motion.balls[other].at(e.time).position).norm();
    return (radius + other_radius - distance) / std::min(radius, other_radius);
}

void find_penetration(Scene scene, const Motion& motion, const ErrorOptions& options,
                      MotionError& error) {
    for (const Event& e : motion.events)
        if (e.kind == EventKind::kImpact && e.time <= options.until)
            error.penetration_relative =
                std::max(error.penetration_relative, overlap_at(scene, motion, e));
    const std::vector<bool> balls(scene.balls.size(), true), surfaces(scene.surfaces.size(), true);
    for (int k = 0; k <= options.penetration_instants; ++k) {
        const double t = instant(k, options.penetration_instants, options.until);
        for (std::size_t b = 0; b < scene.balls.size(); ++b)
            scene.balls[b].position = motion.balls[b].at(t).position;
        const OverlapList overlaps = find_overlaps(scene, balls, surfaces);
        const auto radius = [&scene](int b) {
            return scene.balls[static_cast<std::size_t>(b)].radius;
        };
        for (const BallOverlap& o : overlaps.balls)
            error.penetration_relative = std::max(
                error.penetration_relative, o.depth / std::min(radius(o.first), radius(o.second)));
        for (const SurfaceOverlap& o : overlaps.surfaces)
            error.penetration_relative =
                std::max(error.penetration_relative, o.depth / radius(o.ball));
    }
}

}  // namespace

MotionError motion_error(const Scene& scene, const Motion& reference, const Motion& motion,
                         const ErrorOptions& options) {
    MotionError error;
    compare_positions(reference, motion, options, error);
    error.position_relative =
        error.position_m / extent_of(scene, reference, options.until, options.instants);
    compare_peaks(reference, motion, options, error);
    compare_impacts(reference, motion, options, error);
    compare_energy(scene, reference, motion, options, error);
    find_penetration(scene, motion, options, error);
    return error;
}

std::vector<double> distances(const Motion& a, const Motion& b, double until, int instants) {
    std::vector<double> result;
    for (int k = 0; k <= instants; ++k) {
        const double t = instant(k, instants, until);
        double largest = 0;
        for (std::size_t i = 0; i < a.balls.size(); ++i)
            largest =
                std::max(largest, (a.balls[i].at(t).position - b.balls[i].at(t).position).norm());
        result.push_back(largest);
    }
    return result;
}

double extent_of(const Scene& scene, const Motion& motion, double until, int instants) {
    Eigen::AlignedBox3d box;
    for (int k = 0; k <= instants; ++k)
        for (const Trajectory& ball : motion.balls)
            box.extend(ball.at(instant(k, instants, until)).position);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Ball& ball : scene.balls) smallest = std::min(smallest, ball.radius);
    const double diagonal = motion.balls.empty() ? 0 : box.diagonal().norm();
    return diagonal > 0 ? diagonal : smallest;
}

}  // namespace carom
