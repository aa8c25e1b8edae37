// What the measures read off a motion. Only trajectories are read, never an engine's own events, so
// that every engine is judged alike.
#pragma once

#include <string>
#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom::bench {

/// A top or bottom of the height of a ball's centre along `normal`.
struct Turning {
    double time = 0;    ///< s
    double height = 0;  ///< m
    bool bottom = false;
};
std::vector<Turning> turning_points(const Motion& motion, std::size_t ball, const Vec3& normal);

/// Times of the bottoms (bounces), and heights of the tops between them.
std::vector<double> bounce_times(const Motion& motion, std::size_t ball, const Vec3& normal);
std::vector<double> top_heights(const Motion& motion, std::size_t ball, const Vec3& normal);

/// values[i], or not a number where there are not so many.
double at_or_nan(const std::vector<double>& values, std::size_t i);

/// The last time at which the centre is higher than `height` along `normal`, s; 0 if it never is.
double last_time_above(const Motion& motion, std::size_t ball, const Vec3& normal, double height);

/// Total way of the centre along `normal`, up and down.
double path_length(const Motion& motion, std::size_t ball, const Vec3& normal);

/// How often the ball's velocity jumps by more than `speed` (without gravity: its impacts).
int velocity_jumps(const Motion& motion, std::size_t ball, double speed);

/// Start of the last run of pieces in which only gravity acts, s: when the ball took off.
double last_flight_start(const Scene& scene, const Motion& motion, std::size_t ball);

/// Kinetic and potential energy of all balls, J; the latter 0 at the origin.
double kinetic_energy(const Scene& scene, const Motion& motion, double t);
double total_energy(const Scene& scene, const Motion& motion, double t);
Vec3 momentum(const Scene& scene, const Motion& motion, double t);

/// The deepest overlap at t between balls, or of a ball with a surface, m; 0 if none.
double deepest_overlap(const Scene& scene, const Motion& motion, double t);

/// What goes wrong in general, in words: overlaps, lost balls, energy from nowhere; "" if nothing.
std::string diagnosis(const Scene& scene, const Motion& motion);

}  // namespace carom::bench
