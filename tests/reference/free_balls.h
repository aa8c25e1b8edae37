// Balls between planes, as a textbook has them: brute force in long double, from event to event. It
// shares nothing with src, so that both can hardly be wrong in the same way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace carom::reference {

using Real = long double;
using Vec = std::array<Real, 3>;

inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator*(Real s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Real length(const Vec& a) { return std::sqrt(dot(a, a)); }
inline Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// SI units; the numbers of a material are against a reference of 1, a pair's are products.
struct FreeBall {
    Real radius = 0, mass = 0, inertia = 0, restitution = 1, friction = 0;
    Vec position{}, velocity{}, spin{};
};

/// Points with normal . p = offset; balls are on the side of the unit normal.
struct Wall {
    Vec normal{};
    Real offset = 0, restitution = 1, friction = 0;
};

struct World {
    std::vector<FreeBall> balls;
    std::vector<Wall> walls;
    Vec gravity{};
    int impacts = 0;
    bool bounces = true;  ///< until an impact so slow that a series of bounces is about to end

    void run(Real seconds) {
        while (bounces) {
            const Event next = first_event();
            if (next.time >= seconds) break;
            fly(next.time);
            meet(next);
            ++impacts;
            seconds -= next.time;
        }
        fly(seconds);
    }

  private:
    static constexpr Real kNever = std::numeric_limits<Real>::infinity();
    /// m, and m^2 for squares: what is nearer touches, which is so only after an impact.
    static constexpr Real kTouching = 1e-14L;
    static constexpr Real kSlow = 1e-3L;  ///< m/s, of an approach

    struct Event {
        Real time = kNever;
        std::size_t ball = 0, other = 0;
        bool is_wall = false;
    };

    void fly(Real t) {
        for (FreeBall& b : balls) {
            b.position = b.position + t * b.velocity + (t * t / 2) * gravity;
            b.velocity = b.velocity + t * gravity;
        }
    }

    /// The first t >= 0 with a t^2 + b t + c = 0 and a slope below 0; c is the gap.
    static Real first_root(Real a, Real b, Real c) {
        if (c < kTouching) {  // touches: parts, or comes back by a
            if (b < 0) return 0;
            return a < 0 ? -b / a : kNever;
        }
        const Real d = b * b - 4 * a * c;
        if (d < 0) return kNever;
        const Real q = b < 0 ? (-b + std::sqrt(d)) / 2 : (-b - std::sqrt(d)) / 2;
        // The roots are q / a and c / q: the smaller one above 0 at which the gap falls.
        Real best = kNever;
        for (const Real t : {a == 0 ? kNever : q / a, q == 0 ? kNever : c / q})
            if (t >= 0 && 2 * a * t + b < 0) best = std::min(best, t);
        return best;
    }

    Event first_event() const {
        Event first;
        const auto take = [&first](Real time, std::size_t ball, std::size_t other, bool is_wall) {
            if (time < first.time) first = {time, ball, other, is_wall};
        };
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const FreeBall& b = balls[i];
            for (std::size_t w = 0; w < walls.size(); ++w)
                take(first_root(dot(walls[w].normal, gravity) / 2, dot(walls[w].normal, b.velocity),
                                dot(walls[w].normal, b.position) - walls[w].offset - b.radius),
                     i, w, true);
            for (std::size_t j = i + 1; j < balls.size(); ++j) {
                const Vec d = b.position - balls[j].position, u = b.velocity - balls[j].velocity;
                const Real reach = b.radius + balls[j].radius;
                take(first_root(dot(u, u), 2 * dot(d, u), dot(d, d) - reach * reach), i, j, false);
            }
        }
        return first;
    }

    /// Newton's restitution along the normal; Coulomb's friction, which of spheres acts in one
    /// direction all through an impact: it takes the slip away, or as much as its cone allows.
    void meet(const Event& event) {
        FreeBall& a = balls[event.ball];
        const Wall* wall = event.is_wall ? &walls[event.other] : nullptr;
        FreeBall* b = event.is_wall ? nullptr : &balls[event.other];
        Vec n = wall != nullptr ? wall->normal : a.position - b->position;
        n = (1 / length(n)) * n;
        const Real e = a.restitution * (wall != nullptr ? wall->restitution : b->restitution);
        const Real mu = a.friction * (wall != nullptr ? wall->friction : b->friction);
        Vec u = a.velocity + cross(a.spin, (-a.radius) * n);
        Real along = 1 / a.mass, across = 1 / a.mass + a.radius * a.radius / a.inertia;
        if (b != nullptr) {
            u = u - b->velocity - cross(b->spin, b->radius * n);
            along += 1 / b->mass;
            across += 1 / b->mass + b->radius * b->radius / b->inertia;
        }
        const Real approach = -dot(n, u);
        bounces = bounces && approach > kSlow;
        const Real normal_impulse = (1 + e) * approach / along;
        const Vec slip = u - dot(n, u) * n;
        const Real speed = length(slip);
        Vec impulse = normal_impulse * n;
        if (speed > 0)
            impulse = impulse - (std::min(mu * normal_impulse, speed / across) / speed) * slip;
        a.velocity = a.velocity + (1 / a.mass) * impulse;
        a.spin = a.spin + (1 / a.inertia) * cross((-a.radius) * n, impulse);
        if (b == nullptr) return;
        b->velocity = b->velocity - (1 / b->mass) * impulse;
        b->spin = b->spin - (1 / b->inertia) * cross(b->radius * n, impulse);
    }
};

}  // namespace carom::reference
