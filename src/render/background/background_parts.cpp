#include "render/background/background_parts.h"

#include <algorithm>

#include "render/tile/screen_tiles.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

constexpr int kPartPx = ScreenTiles::kTilePx;

/// Of the lists of a rectangle (SurfaceTiles): each has its first entry and the ends of its kinds.
unsigned bodies_in(const float* rectangle) {
    unsigned bodies = 0;
    for (const int list : {4, 8})
        for (const int kind : {0, 1, 2})
            if (rectangle[list + kind + 1] > rectangle[list + kind]) bodies |= 1U << kind;
    return bodies;
}

/// A rectangle of tiles of one kind; pixels.
struct PartRun {
    int left, right, top, bottom;
    PartKind kind;
    bool continues(const PartRun& above) const {
        return above.bottom == top && above.left == left && above.right == right &&
               !(above.kind < kind) && !(kind < above.kind);
    }
};

class Divider {
  public:
    Divider(const SurfaceTable& table, const View& view, const TileMask* detailed)
        : detailed_(detailed),
          pixel_(pixel_width(view)),
          middle_(0.5 * view.width_px(), 0.5 * view.height_px()),
          normal_(table.planes > 0 ? Vec3(table.at(0, 0).head<3>()) : Vec3::Zero()),
          planes_(table.planes) {}

    void divide(const float* rectangle, BackgroundParts& parts);

  private:
    PartView seen_in(const PartRun& tile) const;

    const TileMask* detailed_;
    double pixel_;
    Vec2 middle_;
    Vec3 normal_;  ///< of the plane
    int planes_;
};

/// By the rays through the corners: which side of the horizon a ray lies on is linear in the pixel.
PartView Divider::seen_in(const PartRun& tile) const {
    if (planes_ == 0) return PartView::kSky;
    constexpr double kRounding = 1e-4;  // of a unit normal and a ray; the shader's limit is 1e-7
    bool ground = true, sky = true;
    for (const int x : {tile.left, tile.right}) {
        for (const int y : {tile.top, tile.bottom}) {
            const Vec2 at = (Vec2(x, y) - middle_) * pixel_;
            const double toward = normal_.dot(Vec3(at.x(), at.y(), 1));
            ground = ground && toward < -kRounding;
            sky = sky && toward > kRounding;
        }
    }
    return ground ? PartView::kGround : (sky ? PartView::kSky : PartView::kHorizon);
}

void Divider::divide(const float* rectangle, BackgroundParts& parts) {
    const auto edge = [&](int i) { return static_cast<int>(rectangle[i]); };
    const auto close = [&](const PartRun& run) {
        std::vector<float>& list = parts[run.kind];
        for (const int px : {run.left, run.top, run.right, run.bottom})
            list.push_back(static_cast<float>(px));
        list.insert(list.end(), rectangle + 4, rectangle + SurfaceTiles::kRectangleFloats);
    };
    std::vector<PartRun> open;
    for (int top = edge(1); top < edge(3); top += kPartPx) {
        std::vector<PartRun> runs;
        for (int left = edge(0); left < edge(2); left += kPartPx) {
            PartRun tile{
                left, std::min(left + kPartPx, edge(2)), top, std::min(top + kPartPx, edge(3)), {}};
            tile.kind.seen = seen_in(tile);
            tile.kind.detailed =
                detailed_ == nullptr || detailed_->has_tile(left / kPartPx, top / kPartPx);
            if (!runs.empty() && !(runs.back().kind < tile.kind) && !(tile.kind < runs.back().kind))
                runs.back().right = tile.right;
            else
                runs.push_back(tile);
        }
        for (const PartRun& above : open) {
            const auto below = std::find_if(
                runs.begin(), runs.end(), [&](const PartRun& run) { return run.continues(above); });
            if (below != runs.end())
                below->top = above.top;
            else
                close(above);
        }
        open = std::move(runs);
    }
    for (const PartRun& run : open) close(run);
}

}  // namespace

unsigned bodies_in(const SurfaceTable& table) {
    return (table.boxes > 0 ? kBoxes : 0U) | (table.spheres > 0 ? kSpheres : 0U) |
           (table.others > 0 ? kOthers : 0U);
}

BackgroundParts divided(const SurfaceTiles& tiles, const SurfaceTable& table, const View& view,
                        const TileMask* detailed) {
    BackgroundParts parts;
    Divider divider(table, view, detailed);
    for (std::size_t i = 0; i < tiles.rectangles.size(); i += SurfaceTiles::kRectangleFloats) {
        const float* rectangle = &tiles.rectangles[i];
        const unsigned bodies = bodies_in(rectangle);
        // Parallel rays may also meet a plane edge-on.
        if (bodies == 0 && table.planes <= 1 && !view.orthographic()) {
            divider.divide(rectangle, parts);
        } else {
            std::vector<float>& list = parts[{bodies, PartView::kAny, true}];
            list.insert(list.end(), rectangle, rectangle + SurfaceTiles::kRectangleFloats);
        }
    }
    return parts;
}

}  // namespace carom
