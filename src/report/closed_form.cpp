#include "report/closed_form.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "sim/contact/restitution.h"

namespace carom {

namespace {

using Real = long double;

/// Hops below this fraction of the ball's place end the series.
constexpr Real kSmallestHop = 1e-12L;

/// What a ball meets: nothing (-1), one plane, or more than has a closed form (empty).
std::optional<int> only_plane(const Scene& scene, const Motion& motion, int ball) {
    int surface = -1;
    for (const Event& e : motion.events) {
        if (e.ball != ball && (e.other.is_surface || e.other.index != ball)) continue;
        if (!e.other.is_surface || (surface >= 0 && surface != e.other.index)) return std::nullopt;
        surface = e.other.index;
    }
    if (surface >= 0 && !std::holds_alternative<PlaneShape>(
                            scene.surfaces[static_cast<std::size_t>(surface)].shape))
        return std::nullopt;
    return surface;
}

/// One ball above its plane: the gap between two impacts is y + v s - g s^2 / 2.
class Bounces {
  public:
    Bounces(const Scene& scene, const Ball& ball, const PlaneShape& plane, Real restitution)
        : ball_(ball),
          gravity_(scene.simulation.gravity),
          normal_(plane.normal),
          offset_(static_cast<Real>(plane.offset_m) + static_cast<Real>(ball.radius)),
          g_(-along(gravity_)),
          e_(restitution) {}

    /// Whether the ball starts above the plane and falls towards it.
    bool fall() const { return g_ > 0 && along(ball_.position) - offset_ > 0; }

    /// Fills in the ball's pieces and tops, and appends its impacts to `motion`.
    void follow(int index, int surface, Motion& motion) const {
        const Real y = along(ball_.position) - offset_, v = along(ball_.velocity);
        const Real u = std::sqrt(v * v + 2 * g_ * y);
        Real time = (v + u) / g_, speed = u;
        piece(motion, index, 0, y, v, g_);
        while (time <= motion.duration) {
            const Real leaving = e_ * speed;
            impact(motion, index, surface, time, speed, leaving);
            const Real hop = leaving * leaving / (2 * g_);
            const Real place = std::max<Real>(ball_.radius, at(time).cwiseAbs().maxCoeff());
            if (e_ < 1 && hop < kSmallestHop * place) {
                const Real end = time + 2 * leaving / (g_ * (1 - e_));
                piece(motion, index, end, 0, 0, 0);
                return;
            }
            piece(motion, index, time, 0, leaving, g_);
            const Real top = time + leaving / g_;
            if (top <= motion.duration && hop > 0)
                motion.peaks[static_cast<std::size_t>(index)].push_back(
                    {static_cast<double>(top), static_cast<double>(hop)});
            time += 2 * leaving / g_;
            speed = leaving;
        }
    }

  private:
    Real along(const Vec3& v) const {
        return static_cast<Real>(v.x()) * static_cast<Real>(normal_.x()) +
               static_cast<Real>(v.y()) * static_cast<Real>(normal_.y()) +
               static_cast<Real>(v.z()) * static_cast<Real>(normal_.z());
    }

    /// Where the ball is along the plane: `at(t)` has no part across it.
    Vec3 at(Real t) const {
        Vec3 x;
        for (int i = 0; i < 3; ++i)
            x[i] = static_cast<double>(
                tangential(ball_.position, i) +
                t * (tangential(ball_.velocity, i) + t / 2 * tangential(gravity_, i)));
        return x;
    }
    Real tangential(const Vec3& v, int i) const {
        return static_cast<Real>(v[i]) - along(v) * static_cast<Real>(normal_[i]);
    }

    /// A piece from `start` on, at the instant that this is after rounding.
    void piece(Motion& motion, int index, Real start, Real y, Real v, Real g) const {
        Piece p;
        p.start = static_cast<double>(start);
        const Real t = p.start, s = t - start;
        for (int i = 0; i < 3; ++i) {
            const Real n = normal_[i];
            p.position[i] = static_cast<double>(
                tangential(ball_.position, i) +
                t * (tangential(ball_.velocity, i) + t / 2 * tangential(gravity_, i)) +
                n * (offset_ + y + s * (v - g * s / 2)));
            p.velocity[i] = static_cast<double>(tangential(ball_.velocity, i) +
                                                t * tangential(gravity_, i) + n * (v - g * s));
            p.acceleration[i] = static_cast<double>(tangential(gravity_, i) - n * g);
        }
        p.spin = ball_.spin;
        Trajectory& trajectory = motion.balls[static_cast<std::size_t>(index)];
        if (!trajectory.pieces().empty())
            p.orientation = trajectory.pieces().back().at(p.start).orientation;
        if (p.start <= motion.duration) trajectory.append(p);
    }

    void impact(Motion& motion, int index, int surface, Real time, Real speed, Real leaving) const {
        Event event;
        event.time = static_cast<double>(time);
        event.ball = index;
        event.other = {true, surface};
        event.normal = normal_;
        event.point = at(time) + static_cast<double>(offset_ - ball_.radius) * normal_;
        event.approach_speed = static_cast<double>(speed);
        event.separation_speed = static_cast<double>(leaving);
        event.restitution = static_cast<double>(e_);
        event.impulse = static_cast<double>(ball_.mass * (speed + leaving));
        motion.events.push_back(event);
    }

    const Ball& ball_;
    Vec3 gravity_, normal_;
    Real offset_;  ///< of the centre when they touch, along the normal
    Real g_;       ///< towards the plane, m/s^2
    Real e_;
};

Piece flight(const Scene& scene, const Ball& ball) {
    Piece p;
    p.position = ball.position;
    p.velocity = ball.velocity;
    p.acceleration = scene.simulation.gravity;
    p.spin = ball.spin;
    return p;
}

}  // namespace

std::optional<Motion> closed_form_motion(const Scene& scene, const Motion& motion) {
    if (scene.air) return std::nullopt;
    const PairTable pairs(scene);
    Motion result;
    result.duration = motion.duration;
    result.ball_names = motion.ball_names;
    result.surface_names = motion.surface_names;
    result.balls.resize(scene.balls.size());
    result.peaks.resize(scene.balls.size());
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
        const Ball& ball = scene.balls[i];
        const std::optional<int> surface = only_plane(scene, motion, static_cast<int>(i));
        if (!surface) return std::nullopt;
        if (*surface < 0) {
            // Held by something from the start on, it writes no events either.
            const Vec3& a = motion.balls[i].pieces().front().acceleration;
            if (a != scene.simulation.gravity) return std::nullopt;
            result.balls[i].append(flight(scene, ball));
            continue;
        }
        const Surface& met = scene.surfaces[static_cast<std::size_t>(*surface)];
        const PairProperties pair = pairs.at(ball.material, met.material);
        const Bounces bounces(scene, ball, std::get<PlaneShape>(met.shape), pair.restitution);
        if (pair.friction > 0 || pair.laws != nullptr || !bounces.fall()) return std::nullopt;
        bounces.follow(static_cast<int>(i), *surface, result);
    }
    std::stable_sort(result.events.begin(), result.events.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    return result;
}

}  // namespace carom
