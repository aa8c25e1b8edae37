#include "render/layers/tile_lists.h"

#include <algorithm>
#include <cmath>

#include "render/balls/balls_in_view.h"
#include "render/view/view_space.h"

namespace carom {

TileLists::TileLists(int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      columns_((width_px + kTilePx - 1) / kTilePx),
      rows_((height_px + kTilePx - 1) / kTilePx),
      first_(count() + 1) {}

PixelRect TileLists::bounds(std::size_t tile) const {
    const auto columns = static_cast<std::size_t>(columns_);
    const int column = static_cast<int>(tile % columns), row = static_cast<int>(tile / columns);
    return PixelRect::at(column * kTilePx, row * kTilePx, kTilePx, kTilePx)
        .common({0, 0, width_px_, height_px_});
}

void TileLists::fill(const std::vector<PixelRect>& places) {
    const auto for_each_tile = [&](const auto& use) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const PixelRect place = places[i].common({0, 0, width_px_, height_px_});
            if (place.empty()) continue;
            for (int y = place.top / kTilePx; y <= (place.bottom - 1) / kTilePx; ++y)
                for (int x = place.left / kTilePx; x <= (place.right - 1) / kTilePx; ++x)
                    use(index_of(x * kTilePx, y * kTilePx), static_cast<int>(i));
        }
    };
    std::fill(first_.begin(), first_.end(), 0);
    for_each_tile([&](std::size_t tile, int) { ++first_[tile + 1]; });
    for (std::size_t tile = 0; tile < count(); ++tile) first_[tile + 1] += first_[tile];
    items_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for_each_tile([&](std::size_t tile, int item) { items_[next[tile]++] = item; });
}

PixelRect pixels_of_sphere(const Vec3& center, double radius_m, const View& view) {
    const PixelRect whole{0, 0, view.width_px(), view.height_px()};
    const Vec3 seen = view_point(view, center);
    if (!std::isfinite(radius_m)) return whole;
    if (seen.z() < -radius_m) return {};
    const Outline outline = project_sphere(seen, radius_m, view);
    if (!outline.is_ellipse) return whole;
    constexpr double kRoom = 1;  // px
    const double x = std::hypot(outline.major.x(), outline.minor.x()) + kRoom;
    const double y = std::hypot(outline.major.y(), outline.minor.y()) + kRoom;
    const auto pixel = [](double place, int most) {
        return static_cast<int>(std::floor(std::clamp(place, -1.0, most + 1.0)));
    };
    return PixelRect{pixel(outline.center.x() - x, view.width_px()),
                     pixel(outline.center.y() - y, view.height_px()),
                     pixel(outline.center.x() + x, view.width_px()) + 1,
                     pixel(outline.center.y() + y, view.height_px()) + 1}
        .common(whole);
}

}  // namespace carom
