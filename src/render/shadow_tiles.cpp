#include "render/shadow_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/surface_table.h"

namespace carom {

namespace {

/// Radii within which a ball takes ambient light from a surface; ball_shadow_fragment.glsl fades it
/// out to the same reach.
constexpr double kAmbientReach = 3.0;
/// A shadow whose lamp looks so much larger than the ball that it hides less than this is left out.
constexpr double kFaintest = 0.004;
/// Light that grazes a surface by less than this (cosine) draws shadows without end on it.
constexpr double kGrazing = 0.02;
/// Points nearer to the eye's plane are cut off there, in units of 1 / (picture height in pixels):
/// any small positive depth serves, since what lies nearer cannot be told from it.
constexpr double kNear = 1e-6;

/// Corners of a box around the segment a ... b with square cross-sections.
std::vector<Vec3> segment_corners(const Vec3& a, const Vec3& b, double radius, const Vec3& axis) {
    const Vec3 u = axis.unitOrthogonal() * radius, v = axis.cross(u);
    std::vector<Vec3> corners;
    for (const Vec3& end : {Vec3(a - radius * axis), Vec3(b + radius * axis)})
        for (const double i : {-1.0, 1.0})
            for (const double j : {-1.0, 1.0}) corners.push_back(end + i * u + j * v);
    return corners;
}

/// An octagon around the ellipse center + cos a + sin b.
std::vector<Vec3> octagon(const Vec3& center, const Vec3& a, const Vec3& b) {
    const double around = 1.0 / std::cos(M_PI / 8);
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const double turn = (i + 0.5) * M_PI / 4;
        corners.push_back(center + around * (std::cos(turn) * a + std::sin(turn) * b));
    }
    return corners;
}

double cross(const Vec2& o, const Vec2& a, const Vec2& b) {
    return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

/// Andrew's monotone chain (1979).
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    if (points.size() < 3) return points;
    std::vector<Vec2> hull;
    for (int half = 0; half < 2; ++half) {
        const std::size_t base = hull.size();
        for (const Vec2& p : points) {
            while (hull.size() >= base + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

/// Tile index of a pixel coordinate, between -1 and `count`.
int tile_of(double px, int count) {
    return static_cast<int>(
        std::clamp(std::floor(px / ShadowTiles::kTilePx), -1.0, static_cast<double>(count)));
}

}  // namespace

ShadowTiles::ShadowTiles(const Scene& scene, const View& view, const Lights& lights,
                         std::vector<TileBound> seen)
    : to_light_(view_direction(view, lights.to_light)),
      tan_radius_(lights.tan_radius),
      pixel_width_(carom::pixel_width(view)),
      orthographic_(view.orthographic()),
      middle_px_(0.5 * view.width_px(), 0.5 * view.height_px()),
      columns_((view.width_px() + kTilePx - 1) / kTilePx),
      rows_((view.height_px() + kTilePx - 1) / kTilePx),
      seen_(std::move(seen)),
      marked_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (const Surface& surface : scene.surfaces) {
        if (const auto* plane = std::get_if<PlaneShape>(&surface.shape))
            add_plane(*plane, view);
        else if (const auto* box = std::get_if<BoxShape>(&surface.shape))
            add_body(box->center, 0.5 * box->size.norm(), view);
        else if (const auto* sphere = std::get_if<SphereShape>(&surface.shape))
            add_body(sphere->center, sphere->radius, view);
        else if (const auto* capsule = std::get_if<CapsuleShape>(&surface.shape))
            add_body(0.5 * (capsule->from + capsule->to),
                     0.5 * (capsule->to - capsule->from).norm() + capsule->radius, view);
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
    const Window seen = bound_of(segment_corners(body.center, body.center, radius, axis));
    body.first_column = seen.first_column;
    body.last_column = seen.last_column;
    body.first_row = seen.first_row;
    body.last_row = seen.last_row;
    bodies_.push_back(body);
}

std::vector<Vec2> ShadowTiles::project(const std::vector<Vec3>& points) const {
    std::vector<Vec2> result;
    const auto add = [&](const Vec3& p) {
        result.push_back(middle_px_ +
                         Vec2(p.x(), p.y()) / ((orthographic_ ? 1.0 : p.z()) * pixel_width_));
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (orthographic_ || points[i].z() >= kNear) {
            add(points[i]);
            continue;
        }
        // Where the hull passes behind the eye, every line that crosses stands for its border.
        for (const Vec3& ahead : points) {
            if (ahead.z() < kNear) continue;
            const double part = (ahead.z() - kNear) / (ahead.z() - points[i].z());
            Vec3 crossing = ahead + part * (points[i] - ahead);
            crossing.z() = kNear;
            add(crossing);
        }
    }
    return result;
}

ShadowTiles::Window ShadowTiles::bound_of(const std::vector<Vec3>& points) const {
    const std::vector<Vec2> seen = project(points);
    if (seen.empty()) return {0, -1, 0, -1};
    Vec2 low = seen.front(), high = seen.front();
    for (const Vec2& p : seen) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return {std::max(0, tile_of(low.x() - 1, columns_)),
            std::min(columns_ - 1, tile_of(high.x() + 1, columns_)),
            std::max(0, tile_of(low.y() - 1, rows_)),
            std::min(rows_ - 1, tile_of(high.y() + 1, rows_))};
}

bool ShadowTiles::reaches(std::size_t tile, const BallInView& ball) const {
    if (seen_.empty()) return true;
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

void ShadowTiles::mark_hull(const std::vector<Vec3>& points, const Window& window,
                            const BallInView& ball) {
    const std::vector<Vec2> hull = convex_hull(project(points));
    if (hull.empty()) return;
    double low = hull.front().y(), high = low;
    for (const Vec2& p : hull) {
        low = std::min(low, p.y());
        high = std::max(high, p.y());
    }
    const int first = std::max(window.first_row, tile_of(low - 1, rows_));
    const int last = std::min(window.last_row, tile_of(high + 1, rows_));
    for (int row = first; row <= last; ++row) {
        // Extent in x of the hull within this row of tiles, with a pixel around.
        const double top = row * kTilePx - 1.0, bottom = (row + 1) * kTilePx + 1.0;
        double left = HUGE_VAL, right = -HUGE_VAL;
        const auto widen = [&](double x) {
            left = std::min(left, x);
            right = std::max(right, x);
        };
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Vec2& a = hull[i];
            const Vec2& b = hull[(i + 1) % hull.size()];
            if (a.y() >= top && a.y() <= bottom) widen(a.x());
            for (const double y : {top, bottom})
                if ((a.y() - y) * (b.y() - y) < 0)
                    widen(a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
        }
        const int begin = std::max(window.first_column, tile_of(left - 1, columns_));
        const int end = std::min(window.last_column, tile_of(right + 1, columns_));
        for (int column = begin; column <= end; ++column) {
            const std::size_t tile =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(column);
            std::vector<int>& list = marked_[tile];
            if ((list.empty() || list.back() != caster_) && reaches(tile, ball))
                list.push_back(caster_);
        }
    }
}

void ShadowTiles::cast_on_plane(const Plane& plane, const BallInView& ball) {
    const double height = plane.normal.dot(ball.center) - plane.offset;
    if (height < -ball.radius) return;

    // Ambient light: a circle below the ball.
    const double reach = kAmbientReach * ball.radius;
    if (height < reach) {
        const Vec3 u = plane.normal.unitOrthogonal();
        const double r = std::sqrt(reach * reach - height * height);
        const Vec3 foot = ball.center - plane.normal * height;
        mark_hull(octagon(foot, r * u, r * plane.normal.cross(u)), whole(), ball);
    }

    // Key light: an ellipse where the cylinder behind the ball meets the plane, widened by the
    // penumbra at its far end.
    const double facing = plane.normal.dot(to_light_);
    if (facing < kGrazing) return;
    const double along = std::max(0.0, height) / facing;
    const double spread = (along + ball.radius / facing) * tan_radius_;
    if (ball.radius * ball.radius < kFaintest * spread * spread) return;
    const double r = ball.radius + spread;
    const Vec3 level = to_light_ - plane.normal * facing;
    const Vec3 stretch =
        level.norm() > 1e-9 ? Vec3(level.normalized()) : Vec3(plane.normal.unitOrthogonal());
    const double stretched = r / std::max(kGrazing, facing - tan_radius_);
    mark_hull(octagon(ball.center - to_light_ * (height / facing), stretched * stretch,
                      r * plane.normal.cross(stretch)),
              whole(), ball);
}

void ShadowTiles::cast_on_body(const Body& body, const BallInView& ball) {
    const Window window = {body.first_column, body.last_column, body.first_row, body.last_row};
    const Vec3 rel = body.center - ball.center;
    const double reach = kAmbientReach * ball.radius;
    if (rel.norm() < body.radius + reach)
        mark_hull(segment_corners(ball.center, ball.center, reach, to_light_), window, ball);

    const double behind = -rel.dot(to_light_);  // of the body's middle, away from the lamp
    const double far = behind + body.radius;
    if (far < 0) return;
    const double r = ball.radius + far * tan_radius_;
    if (ball.radius * ball.radius < kFaintest * (r - ball.radius) * (r - ball.radius)) return;
    if ((rel + behind * to_light_).norm() > body.radius + r) return;
    const double near = std::max(0.0, behind - body.radius);
    mark_hull(segment_corners(ball.center - to_light_ * far, ball.center - to_light_ * near, r,
                              to_light_),
              window, ball);
}

void ShadowTiles::update(const std::vector<BallInView>& balls) {
    for (std::vector<int>& list : marked_) list.clear();
    for (std::size_t i = 0; i < balls.size(); ++i) {
        caster_ = static_cast<int>(i);
        for (const Plane& plane : planes_) cast_on_plane(plane, balls[i]);
        for (const Body& body : bodies_) cast_on_body(body, balls[i]);
    }

    tiles_.clear();
    casters_.clear();
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const std::vector<int>& list =
                marked_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column)];
            if (list.empty()) continue;
            for (const std::size_t value :
                 {static_cast<std::size_t>(column), static_cast<std::size_t>(row),
                  casters_.size() / 4, list.size()})
                tiles_.push_back(static_cast<float>(value));
            for (const int caster : list) {
                const BallInView& ball = balls[static_cast<std::size_t>(caster)];
                for (int axis = 0; axis < 3; ++axis)
                    casters_.push_back(static_cast<float>(ball.center[axis]));
                casters_.push_back(static_cast<float>(ball.radius));
            }
        }
    }
}

}  // namespace carom
