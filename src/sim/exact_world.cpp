#include "sim/exact_world.h"

#include <fmt/core.h>

#include <algorithm>

namespace carom {

namespace {

/// Places are made of a few operations on numbers of their size.
constexpr double kTouchRounding = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

ExactWorld::ExactWorld(const Scene& s) : scene(s), pairs(s), balls(s.balls.size()) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Ball& body = s.balls[i];
        Piece& piece = balls[i].piece;
        piece.position = body.position;
        piece.velocity = body.velocity;
        piece.acceleration = s.simulation.gravity;
        piece.spin = body.spin;
    }
}

Path ExactWorld::path(int i, double t) const {
    const BallState now = state(i, t);
    return {now.position, now.velocity, ball(i).piece.acceleration};
}

std::string ExactWorld::name(const Partner& partner) const {
    return partner.is_surface ? surface(partner.index).name : body(partner.index).name;
}

double ExactWorld::touch_tolerance(const Vec3& a, const Vec3& b, double size) const {
    return kTouchRounding * (a.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff() + size);
}

Contact ExactWorld::contact_at(int i, const Partner& partner, double t) const {
    Contact c;
    c.ball = i;
    c.other = partner;
    const Vec3 x = state(i, t).position;
    const double radius = body(i).radius;
    int material = 0;
    if (partner.is_surface) {
        const Nearest nearest = nearest_on_surface(x, radius, surface(partner.index).shape);
        c.normal = nearest.normal;
        c.depth = -nearest.gap;
        c.point = nearest.point;
        material = surface(partner.index).material;
    } else {
        if (partner.index < i) std::swap(c.ball, c.other.index);
        const Vec3 a = state(c.ball, t).position, b = state(c.other.index, t).position;
        const double distance = (a - b).norm();
        const double sum = body(c.ball).radius + body(c.other.index).radius;
        c.normal = distance > 0 ? Vec3((a - b) / distance) : Vec3::UnitZ();
        c.depth = sum - distance;
        c.arm_other = body(c.other.index).radius * c.normal;
        c.point = b + c.arm_other;
        material = body(c.other.index).material;
    }
    c.arm = -body(c.ball).radius * c.normal;
    const PairProperties pair = pairs.at(body(c.ball).material, material);
    c.restitution = pair.restitution;
    c.friction = pair.friction;
    return c;
}

bool ExactWorld::touches(const Contact& c, double t) const {
    const Vec3 a = state(c.ball, t).position;
    if (c.other.is_surface) return -c.depth <= touch_tolerance(a, c.point, body(c.ball).radius);
    const double size = body(c.ball).radius + body(c.other.index).radius;
    return -c.depth <= touch_tolerance(a, state(c.other.index, t).position, size);
}

}  // namespace carom
