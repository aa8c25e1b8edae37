// The picture in square tiles, and which of them a convex body may be seen in.
#pragma once

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

  private:
    std::vector<Vec2> project(const std::vector<Vec3>& points) const;

    double pixel_width_;
    bool orthographic_;
    Vec2 middle_px_;
    int columns_, rows_;
};

/// Corners of an octagon around the ellipse center + cos a + sin b.
std::vector<Vec3> octagon_around(const Vec3& center, const Vec3& a, const Vec3& b);

}  // namespace carom
