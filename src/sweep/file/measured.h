// Numbers of one run, by names: what the functions of expressions return.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// What a ball meets: "a/floor" is a with the floor, "a" with anything, "*" all balls.
class MeasuredRun {
  public:
    /// Both must outlive it.
    MeasuredRun(const Scene& scene, const Motion& motion) : scene_(scene), motion_(motion) {}

    // All of these are NaN where there is no such thing; n counts from 1, or from the end for -1,
    // -2 and so on. Units are SI. Failure(kRun) for a name that the scene has not.
    double duration() const { return motion_.duration; }
    double balls() const { return static_cast<double>(motion_.balls.size()); }
    double peaks(std::string_view ball) const;
    double peak(std::string_view ball, double n) const;
    double peak_time(std::string_view ball, double n) const;
    double impacts(std::string_view pair) const;
    double impact_time(std::string_view pair, double n) const;
    double approach_speed(std::string_view pair, double n) const;
    double separation_speed(std::string_view pair, double n) const;
    double impulse(std::string_view pair, double n) const;
    /// When the first contact of that kind begins: slide, roll, rest or leave.
    double event_time(std::string_view pair, EventKind kind) const;
    double coordinate(std::string_view ball, int axis, double t) const;  ///< 0, 1, 2: x, y, z
    double velocity(std::string_view ball, int axis, double t) const;    ///< m/s
    double speed(std::string_view ball, double t) const;
    double spin(std::string_view ball, double t) const;  ///< rad/s
    /// J, of translation and rotation, and of place in the field of gravity (0 at the origin).
    double kinetic_energy(std::string_view balls, double t) const;
    double energy(std::string_view balls, double t) const;

  private:
    std::size_t ball_index(std::string_view name) const;
    BallState state(std::string_view ball, double t) const;
    const Peak* find_peak(std::string_view ball, double n) const;
    const Event* find_impact(std::string_view pair, double n) const;
    double of_impact(std::string_view pair, double n, double Event::*what) const;
    std::vector<std::size_t> chosen(std::string_view balls) const;
    double kinetic(std::size_t ball, double t) const;
    template <class Visit>
    void visit_events(std::string_view pair, EventKind kind, const Visit& visit) const;

    const Scene& scene_;
    const Motion& motion_;
};

}  // namespace carom
