#include "motion_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trials.h"

namespace carom::bench {

namespace {

/// Rounding that every number of a motion may have, whatever the spread, in units of the last
/// place of its size.
constexpr double kRoundings = 2;

}  // namespace

StateDifference difference(const Scene& scene, const Motion& base, const Motion& moved,
                           const Transform& transform, double t) {
    StateDifference d;
    for (std::size_t i = 0; i < base.balls.size(); ++i) {
        const auto name =
            std::find(moved.ball_names.begin(), moved.ball_names.end(), base.ball_names[i]);
        const auto j = static_cast<std::size_t>(name - moved.ball_names.begin());
        const BallState a = base.balls[i].at(t), b = moved.balls.at(j).at(t);
        d.place = std::max(d.place, (transform.place_back(b.position) - a.position).norm());
        const Vec3 v = transform.linear.transpose() * b.velocity - a.velocity;
        const Vec3 w = transform.spin_back(b.spin) - a.spin;
        d.speed = std::max({d.speed, v.norm(), scene.balls[i].radius * w.norm()});
    }
    return d;
}

Worst first_other_row(const Motion& base, const Motion& other, double apart) {
    const std::size_t rows = std::min(base.events.size(), other.events.size());
    for (std::size_t i = 0; i < rows; ++i) {
        const Event &a = base.events[i], &b = other.events[i];
        if (a.kind != b.kind || a.ball != b.ball || std::abs(a.time - b.time) > apart)
            return {1, std::min(a.time, b.time)};
    }
    if (base.events.size() == other.events.size()) return {};
    return {1, (base.events.size() > rows ? base : other).events[rows].time};
}

Deviation deviation(const Scene& scene, const Motion& base, const std::vector<Motion>& spread,
                    const Motion& moved, const Transform& transform,
                    const std::vector<double>& times) {
    const double far = transform.shift.cwiseAbs().maxCoeff();
    const double unit = kRoundings * std::numeric_limits<double>::epsilon();
    StateDifference widest{unit * std::max(1.0, far), unit};
    Deviation worst;
    for (const double t : times) {
        for (const Motion& near : spread) {
            const StateDifference d = difference(scene, base, near, Transform{}, t);
            widest.place = std::max(widest.place, d.place);
            widest.speed = std::max(widest.speed, d.speed);
        }
        if (widest.place > kLargestSpread) break;
        const StateDifference d = difference(scene, base, moved, transform, t);
        if (d.place / widest.place > worst.ratio)
            worst = {d.place / widest.place, t, d.place, widest.place, "m"};
        if (d.speed / widest.speed > worst.ratio)
            worst = {d.speed / widest.speed, t, d.speed, widest.speed, "m/s"};
        if (worst.ratio > kSpreadFactor) break;  // the first place tells most
    }
    return worst;
}

}  // namespace carom::bench
