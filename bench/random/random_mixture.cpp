#include "random_mixture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "draw.h"
#include "geometry/nearest.h"
#include "scene/overlap.h"
#include "scene_parts.h"

namespace carom::bench {

namespace {

constexpr double kHalf = 1.5;       // m, of the room
constexpr double kLeastGap = 1e-3;  // m, between bodies at the start that do not touch

Vec3 random_gravity(Draw& draw) {
    const double which = draw.unit();
    if (which < 0.5) return {0, 0, -9.81};
    if (which < 0.7) return Vec3::Zero();
    return draw.uniform(0.5, 25) * draw.direction();
}

std::optional<double> random_friction(Draw& draw) {
    const double which = draw.unit();
    if (which < 0.25) return std::nullopt;
    if (which < 0.35) return 0;
    if (which < 0.7) return draw.unit();
    return draw.chance(0.3) ? 5 : draw.uniform(0, 5);
}

void add_materials(Scene& scene, Draw& draw) {
    const int materials = draw.integer(1, 3);
    const bool smooth = draw.chance(0.25);
    for (int i = 0; i < materials; ++i) {
        const double e = draw.chance(0.5) ? draw.pick({0, 0.3, 0.6, 1}) : draw.unit();
        add_material(scene, e, smooth ? std::nullopt : random_friction(draw));
    }
    if (draw.chance(0.25)) {
        PairRule rule;
        rule.between = {draw.integer(1, materials), draw.integer(1, materials)};
        rule.restitution = draw.unit();
        if (!smooth) rule.friction = draw.unit();
        scene.pairs.push_back(rule);
    }
}

int any_material(const Scene& scene, Draw& draw) {
    return draw.integer(1, static_cast<int>(scene.materials.size()) - 1);
}

void add_planes(Scene& scene, Draw& draw) {
    const double which = draw.unit();
    if (which < 0.15) return;
    const Quat turn = draw.chance(0.5) ? Quat::Identity() : draw.rotation();
    const double share = which < 0.5 ? 1 : 0.5;  // a whole room, or some walls
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0})
            if (draw.chance(share))
                add_surface(scene, PlaneShape{turn * Vec3(side * Vec3::Unit(axis)), -kHalf},
                            any_material(scene, draw));
}

/// One of the shapes with round edges.
SurfaceShape rimmed_shape(const Vec3& at, Draw& draw) {
    const Vec3 axis = draw.chance(0.4) ? Vec3(Vec3::Unit(draw.integer(0, 2))) : draw.direction();
    const double radius = draw.log_uniform(0.03, 0.8);
    switch (draw.integer(0, 3)) {
        case 0:
            return RingShape{at, axis, radius, radius * draw.log_uniform(0.01, 0.9)};
        case 1:
            return BowlShape{at, radius, axis, radius * draw.uniform(0.1, 1.9)};
        case 2: {
            const double angle = draw.chance(0.2) ? 7 : draw.uniform(0.2, 6.2);
            return PipeShape{at, at + draw.log_uniform(0.01, 1.5) * axis, radius,
                             axis.unitOrthogonal(), angle};
        }
        default:
            break;
    }
    return CylinderShape{at, at + draw.log_uniform(0.01, 1.5) * axis, radius};
}

void add_rimmed_bodies(Scene& scene, Draw& draw) {
    for (int i = draw.integer(1, 4); i > 0; --i) {
        const Vec3 at = draw.in_cube(kHalf);
        add_surface(scene, rimmed_shape(at, draw), any_material(scene, draw));
    }
}

void add_bodies(Scene& scene, Draw& draw) {
    const int bodies = draw.chance(0.3) ? 0 : draw.integer(1, 5);
    for (int i = 0; i < bodies; ++i) {
        const Vec3 at = draw.in_cube(kHalf);
        SurfaceShape shape;
        switch (draw.integer(0, 2)) {
            case 0:
                shape = SphereShape{at, draw.log_uniform(0.05, 0.6)};
                break;
            case 1:
                shape = CapsuleShape{at, at + draw.uniform(0.1, 2) * draw.direction(),
                                     draw.log_uniform(0.03, 0.4)};
                break;
            default:
                shape = BoxShape{at, Vec3::Constant(0.6) + draw.in_cube(0.5),
                                 draw.chance(0.5) ? Quat::Identity() : draw.rotation()};
        }
        add_surface(scene, shape, any_material(scene, draw));
    }
}

/// Between a ball and the nearest other body.
double gap_of(const Scene& scene, const Ball& ball) {
    double gap = 1e300;
    for (const Surface& s : scene.surfaces)
        gap = std::min(gap, signed_distance(s.shape, ball.position) - ball.radius);
    for (const Ball& other : scene.balls)
        gap = std::min(gap, (other.position - ball.position).norm() - ball.radius - other.radius);
    return gap;
}

/// Where a ball touches a shape near its place; not onto boxes and capsules, as the seeds have it.
struct MoveOnto {
    const Ball& ball;
    Vec3 operator()(const PlaneShape& plane) const {
        const Vec3& p = ball.position;
        return p + (plane.offset_m + ball.radius - plane.normal.dot(p)) * plane.normal;
    }
    Vec3 operator()(const SphereShape& sphere) const {
        return sphere.center +
               (sphere.radius + ball.radius) * (ball.position - sphere.center).normalized();
    }
    Vec3 operator()(const BoxShape&) const { return ball.position; }
    Vec3 operator()(const CapsuleShape&) const { return ball.position; }
    Vec3 operator()(const CylinderShape& cylinder) const { return moved_onto(cylinder); }
    Vec3 operator()(const RingShape& ring) const { return moved_onto(ring); }
    Vec3 operator()(const BowlShape& bowl) const { return moved_onto(bowl); }
    Vec3 operator()(const PipeShape& pipe) const { return moved_onto(pipe); }

    template <class Shape>
    Vec3 moved_onto(const Shape& shape) const {
        const Nearest nearest = nearest_on(shape, ball.position, ball.radius);
        return ball.position - nearest.gap * nearest.normal;
    }
};

/// Moves a ball onto a surface, or another ball.
void make_touch(const Scene& scene, Draw& draw, Ball& ball) {
    if (!scene.balls.empty() && draw.chance(0.3)) {
        const Ball& other = scene.balls.front();
        const Vec3 up = scene.simulation.gravity.isZero(0)
                            ? draw.direction()
                            : Vec3(-scene.simulation.gravity.normalized());
        ball.position = other.position + (other.radius + ball.radius) * up;
        return;
    }
    if (scene.surfaces.empty()) return;
    const int last = static_cast<int>(scene.surfaces.size()) - 1;
    const SurfaceShape& shape =
        scene.surfaces[static_cast<std::size_t>(draw.integer(0, last))].shape;
    ball.position = std::visit(MoveOnto{ball}, shape);
}

Ball random_ball(Scene& scene, Draw& draw, bool touching) {
    Ball ball;
    ball.material = any_material(scene, draw);
    ball.radius = draw.log_uniform(0.01, 0.3);
    if (draw.chance(0.5)) ball.mass = draw.log_uniform(0.1, 10);
    if (draw.chance(0.5)) ball.inertia_factor = draw.pick({2.0 / 3, draw.uniform(0.1, 0.6)});
    ball.position = draw.in_cube(kHalf);
    if (touching && draw.chance(0.4)) make_touch(scene, draw, ball);
    if (draw.chance(0.8)) ball.velocity = draw.uniform(0, 8) * draw.direction();
    if (draw.chance(0.5)) ball.spin = draw.log_uniform(0.1, 20) / ball.radius * draw.direction();
    return ball;
}

}  // namespace

Scene random_mixture(std::uint64_t seed, bool touching, Bodies bodies) {
    Draw draw(seed);
    const double duration = draw.uniform(0.8, 2);
    Scene scene = empty_scene(duration, random_gravity(draw));
    if (draw.chance(0.2)) scene.simulation.restitution_constant = draw.uniform(3, 6);
    add_materials(scene, draw);
    if (draw.chance(0.95)) {
        add_planes(scene, draw);
        bodies == Bodies::kRimmed ? add_rimmed_bodies(scene, draw) : add_bodies(scene, draw);
    }
    const int balls = draw.integer(1, 8);
    for (int tries = 0; tries < 40 * balls; ++tries) {
        if (static_cast<int>(scene.balls.size()) == balls) break;
        const Ball ball = random_ball(scene, draw, touching);
        const double gap = gap_of(scene, ball);
        const bool touches = touching && std::abs(gap) <= 0.9 * kTouchingDepth * ball.radius;
        if (!touches && gap < kLeastGap) continue;
        Ball& added = add_ball(scene, ball.radius, ball.position, ball.material);
        const std::string name = added.name;
        added = ball;
        added.name = name;
    }
    return scene;
}

}  // namespace carom::bench
