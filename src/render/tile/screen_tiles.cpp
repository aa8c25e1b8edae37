#include "render/tile/screen_tiles.h"

#include <algorithm>
#include <cmath>

#include "render/view/view_space.h"

namespace carom {

namespace {

/// Points nearer to the eye's plane are cut off there, in units of 1 / (picture height in pixels):
/// any small positive depth serves, since what lies nearer cannot be told from it.
constexpr double kNear = 1e-6;

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
        std::clamp(std::floor(px / ScreenTiles::kTilePx), -1.0, static_cast<double>(count)));
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
    double low = corners.front().y(), high = low;
    for (const Vec2& p : corners) {
        low = std::min(low, p.y());
        high = std::max(high, p.y());
    }
    const int first = std::max(window.first_row, tile_of(low - around_px, rows_));
    const int last = std::min(window.last_row, tile_of(high + around_px, rows_));
    for (int row = first; row <= last; ++row) {
        // Extent in x of the hull within this row of tiles, with some pixels around.
        const double top = row * kTilePx - around_px, bottom = (row + 1) * kTilePx + around_px;
        double left = HUGE_VAL, right = -HUGE_VAL;
        const auto widen = [&](double x) {
            left = std::min(left, x);
            right = std::max(right, x);
        };
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec2& a = corners[i];
            const Vec2& b = corners[(i + 1) % corners.size()];
            if (a.y() >= top && a.y() <= bottom) widen(a.x());
            for (const double y : {top, bottom})
                if ((a.y() - y) * (b.y() - y) < 0)
                    widen(a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
        }
        const int begin = std::max(window.first_column, tile_of(left - around_px, columns_));
        const int end = std::min(window.last_column, tile_of(right + around_px, columns_));
        if (begin <= end) spans.push_back({row, begin, end});
    }
    return spans;
}

std::vector<Vec3> octagon_around(const Vec3& center, const Vec3& a, const Vec3& b) {
    const double around = 1.0 / std::cos(M_PI / 8);
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const double turn = (i + 0.5) * M_PI / 4;
        corners.push_back(center + around * (std::cos(turn) * a + std::sin(turn) * b));
    }
    return corners;
}

}  // namespace carom
