#include "render/tile/screen_tiles.h"

#include <algorithm>
#include <cmath>

#include "render/view/view_space.h"

namespace carom {

namespace {

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

}  // namespace

ScreenTiles::ScreenTiles(const View& view)
    : pixel_width_(pixel_width(view)),
      orthographic_(view.orthographic()),
      middle_px_(0.5 * view.width_px(), 0.5 * view.height_px()),
      columns_((view.width_px() + kTilePx - 1) / kTilePx),
      rows_((view.height_px() + kTilePx - 1) / kTilePx) {}

std::vector<Vec2> ScreenTiles::project(const std::vector<Vec3>& points) const {
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

ScreenTiles::Window ScreenTiles::bound_of(const std::vector<Vec3>& points) const {
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

std::vector<ScreenTiles::Span> ScreenTiles::hull(const std::vector<Vec3>& points,
                                                 const Window& window, double around_px) const {
    std::vector<Span> spans;
    const std::vector<Vec2> corners = convex_hull(project(points));
    if (corners.empty()) return spans;
    visit_polygon(corners.data(), corners.size(), window, around_px,
                  [&](const Span& span) { spans.push_back(span); });
    return spans;
}

std::array<Vec3, 8> octagon_around(const Vec3& center, const Vec3& a, const Vec3& b) {
    // Corners at odd multiples of 22.5 degrees, 1 / cos 22.5 degrees away.
    const double kLong = 1, kShort = std::tan(M_PI / 8);
    const Vec3 al = kLong * a, as = kShort * a, bl = kLong * b, bs = kShort * b;
    return {center + al + bs, center + as + bl, center - as + bl, center - al + bs,
            center - al - bs, center - as - bl, center + as - bl, center + al - bs};
}

}  // namespace carom
