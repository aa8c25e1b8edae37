#include "render/balls/shadow_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/bounds.h"
#include "render/background/surface_table.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

/// Radii within which a ball takes ambient light from a surface; ball_shadow_fragment.glsl fades it
/// out to the same reach.
constexpr double kAmbientReach = 3.0;
/// A shadow whose lamp looks so much larger than the ball that it hides less than this is left out.
constexpr double kFaintest = 0.004;
/// Light that grazes a surface by less than this (cosine) draws shadows without end on it.
constexpr double kGrazing = 0.02;
/// Corners of a box around the segment a ... b with square cross-sections.
std::vector<Vec3> segment_corners(const Vec3& a, const Vec3& b, double radius, const Vec3& axis) {
    const Vec3 u = axis.unitOrthogonal() * radius, v = axis.cross(u);
    std::vector<Vec3> corners;
    for (const Vec3& end : {Vec3(a - radius * axis), Vec3(b + radius * axis)})
        for (const double i : {-1.0, 1.0})
            for (const double j : {-1.0, 1.0}) corners.push_back(end + i * u + j * v);
    return corners;
}

/// Where the shadow of a ball is looked for. While it is swept its soft edges reach further than
/// its way, by a part of it (ball_shadow_fragment.glsl).
std::vector<Vec3> places(const BallInView& ball) {
    constexpr double kReach = 0.7;  // of the way, from its middle
    if (!ball.swept) return {ball.center};
    return {ball.center - kReach * ball.sweep, ball.center + kReach * ball.sweep};
}

void append(const std::vector<Vec3>& points, std::vector<Vec3>& to) {
    to.insert(to.end(), points.begin(), points.end());
}

}  // namespace

ShadowTiles::ShadowTiles(const Scene& scene, const View& view, const Lights& lights,
                         std::vector<TileBound> seen)
    : to_light_(view_direction(view, lights.to_light)),
      tan_radius_(lights.tan_radius),
      grid_(view),
      seen_(std::move(seen)),
      marked_(grid_.count()) {
    for (const Surface& surface : scene.surfaces) {
        if (const auto* plane = std::get_if<PlaneShape>(&surface.shape)) {
            add_plane(*plane, view);
        } else {
            const SphereAround around = sphere_around(surface.shape);
            add_body(around.center, around.radius, view);
        }
    }
}

void ShadowTiles::add_plane(const PlaneShape& plane, const View& view) {
    if (!seen_from_front(plane, view)) return;
    planes_.push_back(
        {view_direction(view, plane.normal), plane.offset_m - plane.normal.dot(view.eye())});
}

void ShadowTiles::add_body(const Vec3& center, double radius, const View& view) {
    Body body;
    body.center = view_point(view, center);
    body.radius = radius;
    const Vec3 axis = Vec3::UnitZ();
    body.seen_in = grid_.bound_of(segment_corners(body.center, body.center, radius, axis));
    bodies_.push_back(body);
}

bool ShadowTiles::reaches(std::size_t tile, const BallInView& ball) const {
    if (seen_.empty() || ball.swept) return true;
    const TileBound& seen = seen_[tile];
    if (seen.radius < 0) return false;
    const Vec3 rel = ball.center - seen.center;
    const double ambient_reach = kAmbientReach * ball.radius + seen.radius;
    if (rel.squaredNorm() < ambient_reach * ambient_reach) return true;
    const double along = rel.dot(to_light_);
    const double key_reach =
        ball.radius + seen.radius + std::max(0.0, along + seen.radius) * tan_radius_;
    return along > -seen.radius && rel.squaredNorm() - along * along < key_reach * key_reach;
}

/// Marks it, or, where the ball is swept, adds it to the points whose hull will be marked.
void ShadowTiles::add_octagon(const std::array<Vec3, 8>& octagon, const BallInView& ball,
                              std::vector<Vec3>& points) {
    if (ball.swept)
        points.insert(points.end(), octagon.begin(), octagon.end());
    else
        grid_.visit_octagon(octagon, grid_.whole(),
                            [&](const ScreenTiles::Span& span) { mark_span(span, ball); });
}

void ShadowTiles::mark_span(const ScreenTiles::Span& span, const BallInView& ball) {
    for (int column = span.first_column; column <= span.last_column; ++column) {
        const std::size_t tile = grid_.index(column, span.row);
        std::vector<int>& list = marked_[tile];
        if ((list.empty() || list.back() != caster_) && reaches(tile, ball))
            list.push_back(caster_);
    }
}

void ShadowTiles::mark_hull(const std::vector<Vec3>& points, const ScreenTiles::Window& window,
                            const BallInView& ball) {
    for (const ScreenTiles::Span& span : grid_.hull(points, window)) mark_span(span, ball);
}

void ShadowTiles::cast_on_plane(const Plane& plane, const BallInView& ball) {
    ambient_.clear();
    key_.clear();
    for (const Vec3& center : places(ball)) {
        const double height = plane.normal.dot(center) - plane.offset;
        if (height < -ball.radius) continue;
        add_ambient(plane, center, height, ball);
        add_key(plane, center, height, ball);
    }
    if (!ambient_.empty()) mark_hull(ambient_, grid_.whole(), ball);
    if (!key_.empty()) mark_hull(key_, grid_.whole(), ball);
}

/// Ambient light: a circle below the ball.
void ShadowTiles::add_ambient(const Plane& plane, const Vec3& center, double height,
                              const BallInView& ball) {
    const double reach = kAmbientReach * ball.radius;
    if (height >= reach) return;
    const Vec3 u = plane.normal.unitOrthogonal();
    const double r = std::sqrt(reach * reach - height * height);
    const Vec3 foot = center - plane.normal * height;
    add_octagon(octagon_around(foot, r * u, r * plane.normal.cross(u)), ball, ambient_);
}

/// Key light: an ellipse where the cylinder behind the ball meets the plane, widened by the
/// penumbra at its far end.
void ShadowTiles::add_key(const Plane& plane, const Vec3& center, double height,
                          const BallInView& ball) {
    const double radius = ball.radius;
    const double facing = plane.normal.dot(to_light_);
    if (facing < kGrazing) return;
    const double along = std::max(0.0, height) / facing;
    const double spread = (along + radius / facing) * tan_radius_;
    if (radius * radius < kFaintest * spread * spread) return;
    const double r = radius + spread;
    const Vec3 level = to_light_ - plane.normal * facing;
    const Vec3 stretch =
        level.norm() > 1e-9 ? Vec3(level.normalized()) : Vec3(plane.normal.unitOrthogonal());
    const double stretched = r / std::max(kGrazing, facing - tan_radius_);
    add_octagon(octagon_around(center - to_light_ * (height / facing), stretched * stretch,
                               r * plane.normal.cross(stretch)),
                ball, key_);
}

void ShadowTiles::cast_on_body(const Body& body, const BallInView& ball) {
    ambient_.clear();
    key_.clear();
    for (const Vec3& center : places(ball)) {
        const Vec3 rel = body.center - center;
        const double reach = kAmbientReach * ball.radius;
        if (rel.norm() < body.radius + reach)
            append(segment_corners(center, center, reach, to_light_), ambient_);

        const double behind = -rel.dot(to_light_);  // of the body's middle, away from the lamp
        const double far = behind + body.radius;
        if (far < 0) continue;
        const double r = ball.radius + far * tan_radius_;
        if (ball.radius * ball.radius < kFaintest * (r - ball.radius) * (r - ball.radius)) continue;
        const double way = ball.swept ? ball.sweep.norm() : 0;
        if ((rel + behind * to_light_).norm() > body.radius + r + way) continue;
        const double near = std::max(0.0, behind - body.radius);
        append(segment_corners(center - to_light_ * far, center - to_light_ * near, r, to_light_),
               key_);
    }
    if (!ambient_.empty()) mark_hull(ambient_, body.seen_in, ball);
    if (!key_.empty()) mark_hull(key_, body.seen_in, ball);
}

void ShadowTiles::update(const std::vector<BallInView>& balls) {
    for (std::vector<int>& list : marked_) list.clear();
    swept_ = std::any_of(balls.begin(), balls.end(),
                         [](const BallInView& ball) { return ball.drawn && ball.swept; });
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!balls[i].drawn) continue;
        caster_ = static_cast<int>(i);
        for (const Plane& plane : planes_) cast_on_plane(plane, balls[i]);
        for (const Body& body : bodies_) cast_on_body(body, balls[i]);
    }

    tiles_.clear();
    casters_.clear();
    caster_balls_.clear();
    for (int row = 0; row < grid_.rows(); ++row) {
        for (int column = 0; column < grid_.columns(); ++column) {
            const std::vector<int>& list = marked_[grid_.index(column, row)];
            if (list.empty()) continue;
            for (const std::size_t value :
                 {static_cast<std::size_t>(column), static_cast<std::size_t>(row),
                  caster_balls_.size(), list.size()})
                tiles_.push_back(static_cast<float>(value));
            for (const int caster : list) {
                const BallInView& ball = balls[static_cast<std::size_t>(caster)];
                for (int axis = 0; axis < 3; ++axis)
                    casters_.push_back(static_cast<float>(ball.center[axis]));
                casters_.push_back(static_cast<float>(ball.radius));
                for (int axis = 0; swept_ && axis < 4; ++axis)
                    casters_.push_back(axis < 3 ? static_cast<float>(ball.sweep[axis]) : 0.0F);
                caster_balls_.push_back(ball.index);
            }
        }
    }
}

}  // namespace carom
