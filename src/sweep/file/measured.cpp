#include "sweep/file/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/failure.h"

namespace carom {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The n-th of `size`, counted from 1 or from the end; -1 for none.
std::ptrdiff_t place_of(double n, std::size_t size) {
    if (n != std::floor(n) || std::abs(n) > 1e9) return -1;
    const auto count = static_cast<std::ptrdiff_t>(size);
    const auto place = static_cast<std::ptrdiff_t>(n > 0 ? n - 1 : static_cast<double>(count) + n);
    return n != 0 && place >= 0 && place < count ? place : -1;
}

}  // namespace

std::size_t MeasuredRun::ball_index(std::string_view name) const {
    const auto& names = motion_.ball_names;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw Failure(FailureKind::kRun, fmt::format("results: this run has no ball '{}'", name));
    return static_cast<std::size_t>(found - names.begin());
}

std::vector<std::size_t> MeasuredRun::chosen(std::string_view balls) const {
    if (balls != "*") return {ball_index(balls)};
    std::vector<std::size_t> all(motion_.balls.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
}

/// Instants outside of the motion are none.
BallState MeasuredRun::state(std::string_view ball, double t) const {
    const std::size_t index = ball_index(ball);
    if (t >= 0 && t <= motion_.duration) return motion_.balls[index].at(t);
    BallState none;
    none.position = none.velocity = none.spin = Vec3::Constant(kNone);
    return none;
}

template <class Visit>
void MeasuredRun::visit_events(std::string_view pair, EventKind kind, const Visit& visit) const {
    const std::size_t slash = pair.find('/');
    const std::string_view one = pair.substr(0, slash);
    const std::string_view other = slash == pair.npos ? "*" : pair.substr(slash + 1);
    const auto known = [&](std::string_view name) {
        const auto has = [&](const auto& names) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        if (name == "*" || has(motion_.ball_names) || has(motion_.surface_names)) return;
        throw Failure(FailureKind::kRun,
                      fmt::format("results: this run has no ball or surface '{}'", name));
    };
    known(one);
    known(other);
    for (const Event& event : motion_.events) {
        if (event.kind != kind) continue;
        const auto& names = event.other.is_surface ? motion_.surface_names : motion_.ball_names;
        const std::string_view a = motion_.ball_names[static_cast<std::size_t>(event.ball)];
        const std::string_view b = names[static_cast<std::size_t>(event.other.index)];
        const auto fits = [](std::string_view wanted, std::string_view name) {
            return wanted == "*" || wanted == name;
        };
        if ((fits(one, a) && fits(other, b)) || (fits(one, b) && fits(other, a)))
            if (!visit(event)) return;
    }
}

double MeasuredRun::peaks(std::string_view ball) const {
    return static_cast<double>(motion_.peaks[ball_index(ball)].size());
}

const Peak* MeasuredRun::find_peak(std::string_view ball, double n) const {
    const std::vector<Peak>& all = motion_.peaks[ball_index(ball)];
    const std::ptrdiff_t place = place_of(n, all.size());
    return place < 0 ? nullptr : &all[static_cast<std::size_t>(place)];
}

double MeasuredRun::peak(std::string_view ball, double n) const {
    const Peak* found = find_peak(ball, n);
    return found == nullptr ? kNone : found->height;
}

double MeasuredRun::peak_time(std::string_view ball, double n) const {
    const Peak* found = find_peak(ball, n);
    return found == nullptr ? kNone : found->time;
}

double MeasuredRun::impacts(std::string_view pair) const {
    std::int64_t count = 0;
    visit_events(pair, EventKind::kImpact, [&](const Event&) { return ++count, true; });
    return static_cast<double>(count);
}

const Event* MeasuredRun::find_impact(std::string_view pair, double n) const {
    std::vector<const Event*> all;
    visit_events(pair, EventKind::kImpact, [&](const Event& event) {
        all.push_back(&event);
        return n < 0 || static_cast<double>(all.size()) < n;
    });
    const std::ptrdiff_t place = place_of(n, all.size());
    return place < 0 ? nullptr : all[static_cast<std::size_t>(place)];
}

double MeasuredRun::of_impact(std::string_view pair, double n, double Event::*what) const {
    const Event* found = find_impact(pair, n);
    return found == nullptr ? kNone : found->*what;
}

double MeasuredRun::impact_time(std::string_view pair, double n) const {
    return of_impact(pair, n, &Event::time);
}

double MeasuredRun::approach_speed(std::string_view pair, double n) const {
    return of_impact(pair, n, &Event::approach_speed);
}

double MeasuredRun::separation_speed(std::string_view pair, double n) const {
    return of_impact(pair, n, &Event::separation_speed);
}

double MeasuredRun::impulse(std::string_view pair, double n) const {
    return of_impact(pair, n, &Event::impulse);
}

double MeasuredRun::event_time(std::string_view pair, EventKind kind) const {
    double time = kNone;
    visit_events(pair, kind, [&](const Event& event) {
        time = event.time;
        return false;
    });
    return time;
}

double MeasuredRun::coordinate(std::string_view ball, int axis, double t) const {
    return state(ball, t).position[axis];
}

double MeasuredRun::velocity(std::string_view ball, int axis, double t) const {
    return state(ball, t).velocity[axis];
}

double MeasuredRun::speed(std::string_view ball, double t) const {
    return state(ball, t).velocity.norm();
}

double MeasuredRun::spin(std::string_view ball, double t) const {
    return state(ball, t).spin.norm();
}

double MeasuredRun::kinetic(std::size_t ball, double t) const {
    const Ball& body = scene_.balls[ball];
    const BallState s = motion_.balls[ball].at(t);
    const double inertia = body.inertia_factor * body.mass * body.radius * body.radius;
    return 0.5 * (body.mass * s.velocity.squaredNorm() + inertia * s.spin.squaredNorm());
}

double MeasuredRun::kinetic_energy(std::string_view balls, double t) const {
    const std::vector<std::size_t> all = chosen(balls);
    if (!(t >= 0 && t <= motion_.duration)) return kNone;
    double sum = 0;
    for (const std::size_t ball : all) sum += kinetic(ball, t);
    return sum;
}

double MeasuredRun::energy(std::string_view balls, double t) const {
    double sum = kinetic_energy(balls, t);
    if (std::isnan(sum)) return sum;
    for (const std::size_t ball : chosen(balls))
        sum -= scene_.balls[ball].mass *
               scene_.simulation.gravity.dot(motion_.balls[ball].at(t).position);
    return sum;
}

}  // namespace carom
