// Which bodies the rays of a tile of the picture may meet.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/pixel_rect.h"
#include "render/view/camera.h"

namespace carom {

/// The picture in square tiles, each with a list of numbers.
class TileLists {
  public:
    static constexpr int kTilePx = 16;

    TileLists() = default;
    TileLists(int width_px, int height_px);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    std::size_t count() const {
        return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    }
    std::size_t index_of(int x_px, int y_px) const {
        return static_cast<std::size_t>(y_px / kTilePx) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(x_px / kTilePx);
    }
    PixelRect bounds(std::size_t tile) const;

    /// Replaces all lists: item i stands in those of the tiles that places[i] touches.
    void fill(const std::vector<PixelRect>& places);
    std::span<const int> list(std::size_t tile) const {
        return {items_.data() + first_[tile], first_[tile + 1] - first_[tile]};
    }

  private:
    int width_px_ = 0, height_px_ = 0, columns_ = 0, rows_ = 0;
    std::vector<std::size_t> first_;  ///< into items_; one more than there are tiles
    std::vector<int> items_;
};

/// Pixels whose centres a sphere of the world may cover, within the picture; empty behind the eye.
PixelRect pixels_of_sphere(const Vec3& center, double radius_m, const View& view);

}  // namespace carom
