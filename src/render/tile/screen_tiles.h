// The picture in square tiles, and which of them a convex body may be seen in.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/view/camera.h"

namespace carom {

class ScreenTiles {
  public:
    static constexpr int kTilePx = 16;

    explicit ScreenTiles(const View& view);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    std::size_t count() const {
        return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    }
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }

    /// Tiles from a first to a last column and row, both included.
    struct Window {
        int first_column, last_column, first_row, last_row;
    };
    Window whole() const { return {0, columns_ - 1, 0, rows_ - 1}; }

    /// Around what is seen of the convex hull of the points (view space; also behind the eye).
    Window bound_of(const std::vector<Vec3>& points) const;

    /// Neighbouring tiles of one row, both ends included.
    struct Span {
        int row, first_column, last_column;
    };
    /// The tiles of `window` that the hull may be seen in. Nothing is missed: the hull is taken
    /// `around_px` pixels larger.
    std::vector<Span> hull(const std::vector<Vec3>& points, const Window& window,
                           double around_px = 1.0) const;

    /// The same of an octagon (octagon_around()), handed to `visit` span by span: many small ones.
    template <class Visit>
    void visit_octagon(const std::array<Vec3, 8>& points, const Window& window,
                       const Visit& visit) const;

  private:
    /// Points nearer to the eye's plane are cut off there, in units of 1 / (picture height in
    /// pixels): any small positive depth serves, since what lies nearer cannot be told from it.
    static constexpr double kNear = 1e-6;

    /// Of a convex polygon of `count` corners in the picture, in either order.
    template <class Visit>
    void visit_polygon(const Vec2* corners, std::size_t count, const Window& window,
                       double around_px, const Visit& visit) const;
    /// Tile index of a pixel coordinate, between -1 and `count`.
    static int tile_of(double px, int count) {
        return static_cast<int>(
            std::clamp(std::floor(px / kTilePx), -1.0, static_cast<double>(count)));
    }
    std::vector<Vec2> project(const std::vector<Vec3>& points) const;

    double pixel_width_;
    bool orthographic_;
    Vec2 middle_px_;
    int columns_, rows_;
};

/// Corners of an octagon around the ellipse center + cos a + sin b.
std::array<Vec3, 8> octagon_around(const Vec3& center, const Vec3& a, const Vec3& b);

template <class Visit>
void ScreenTiles::visit_polygon(const Vec2* corners, std::size_t count, const Window& window,
                                double around_px, const Visit& visit) const {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i) {
        low = std::min(low, corners[i].y());
        high = std::max(high, corners[i].y());
    }
    const int first = std::max(window.first_row, tile_of(low - around_px, rows_));
    const int last = std::min(window.last_row, tile_of(high + around_px, rows_));
    for (int row = first; row <= last; ++row) {
        // Extent in x of the polygon within this row of tiles, with some pixels around.
        const double top = row * kTilePx - around_px, bottom = (row + 1) * kTilePx + around_px;
        double left = HUGE_VAL, right = -HUGE_VAL;
        const auto widen = [&](double x) {
            left = std::min(left, x);
            right = std::max(right, x);
        };
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2& a = corners[i];
            const Vec2& b = corners[i + 1 < count ? i + 1 : 0];
            if (a.y() >= top && a.y() <= bottom) widen(a.x());
            for (const double y : {top, bottom})
                if ((a.y() - y) * (b.y() - y) < 0)
                    widen(a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
        }
        const int begin = std::max(window.first_column, tile_of(left - around_px, columns_));
        const int end = std::min(window.last_column, tile_of(right + around_px, columns_));
        if (begin <= end) visit(Span{row, begin, end});
    }
}

template <class Visit>
void ScreenTiles::visit_octagon(const std::array<Vec3, 8>& points, const Window& window,
                                const Visit& visit) const {
    constexpr double kAroundPx = 1.0;
    std::array<Vec2, 8> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3& p = points[i];
        if (!orthographic_ && p.z() < kNear) {  // cut off by the eye's plane: no octagon any more
            for (const Span& span : hull({points.begin(), points.end()}, window, kAroundPx))
                visit(span);
            return;
        }
        corners[i] =
            middle_px_ + Vec2(p.x(), p.y()) / ((orthographic_ ? 1.0 : p.z()) * pixel_width_);
    }
    visit_polygon(corners.data(), corners.size(), window, kAroundPx, visit);
}

}  // namespace carom
