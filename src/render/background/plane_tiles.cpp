#include "render/background/plane_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "render/tile/screen_tiles.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

/// As surface_tiles.cpp: samples lie half a pixel from a pixel's middle, edges a pixel from there.
constexpr double kAroundPlanePx = 2.5;

/// How near a plane is along the ray of a pixel, the larger the nearer, and linear in the pixel's
/// place: of n . p = w, seen along (x, y, 1) from the eye, 1 / depth = n . (x, y, 1) / w; along
/// parallel rays -depth.
struct Nearness {
    double center = 0;            ///< in the middle of the picture
    Vec2 step_px = Vec2::Zero();  ///< from pixel to pixel
    double deep = 0;              ///< what n . p - w is less on the ray, per nearness
    bool always = false;          ///< it has none: edge-on to parallel rays, or through the eye

    double at(const Vec2& from_center_px) const { return center + step_px.dot(from_center_px); }
    double spread(const Vec2& half_px) const { return step_px.cwiseAbs().dot(half_px); }
};

Nearness nearness_of(const Eigen::Vector4d& plane, double pixel, bool orthographic) {
    const Vec3 n = plane.head<3>();
    const double w = plane.w();
    constexpr double kEdgeOn = 1e-7;  // as surfaces.glsl
    if (!orthographic && w != 0) return {n.z() / w, n.head<2>() * (pixel / w), std::abs(w), false};
    if (!orthographic || n.z() > -kEdgeOn) return {0, Vec2::Zero(), 0, true};
    return {-w / n.z(), n.head<2>() * (pixel / n.z()), -n.z(), false};
}

struct TileRange {
    double low, high;
};

}  // namespace

PlaneTiles sort_planes_into_tiles(const SurfaceTable& table, const View& view,
                                  const PictureScale& scale) {
    const ScreenTiles grid(view);
    const auto count = static_cast<std::size_t>(table.planes);
    PlaneTiles tiles;
    if (table.reflection) {
        std::vector<int> all(count);
        std::iota(all.begin(), all.end(), 0);
        tiles.seen.assign(grid.count(), all);
        tiles.shading = tiles.seen;
        return tiles;
    }
    const bool orthographic = view.orthographic();
    std::vector<Nearness> planes;
    std::vector<Vec3> normals;
    std::vector<bool> alone;  // false for a plane in the place of one before it
    std::set<std::array<double, 4>> places;
    for (int i = 0; i < table.planes; ++i) {
        const Eigen::Vector4d plane = table.at(i, 0);
        planes.push_back(nearness_of(plane, pixel_width(view), orthographic));
        normals.emplace_back(plane.head<3>());
        alone.push_back(places.insert({plane[0], plane[1], plane[2], plane[3]}).second);
    }

    // A crevice is looked for at heights h up to the reach above what is seen: a plane as far away
    // from there as it is from the surface, or farther, takes nothing.
    constexpr double kRoom = 1e-4;
    const bool only_planes = table.count() == table.planes;
    const auto darkens = [&](double away, std::size_t plane, const std::vector<int>& seen) {
        const double reach = (1 + kRoom) * scale.ao_reach_m;
        if (away >= 2 * reach) return false;
        if (!only_planes) return true;
        const Vec3& n = normals[plane];
        return std::any_of(seen.begin(), seen.end(), [&](int other) {
            return away < (1 - n.dot(normals[static_cast<std::size_t>(other)]) + kRoom) * reach;
        });
    };

    constexpr double kTilePx = ScreenTiles::kTilePx;
    const Vec2 middle_px = 0.5 * Vec2(view.width_px(), view.height_px());
    const Vec2 half_px = Vec2::Constant(0.5 * kTilePx + kAroundPlanePx);
    constexpr double kSky = 0;  // nearness of what no perspective ray meets
    std::vector<TileRange> ranges(count);
    tiles.seen.resize(grid.count());
    tiles.shading.resize(grid.count());
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            const Vec2 center = kTilePx * Vec2(column + 0.5, row + 0.5) - middle_px;
            // Wherever in the tile, something is as near as this.
            double nearest = orthographic ? -std::numeric_limits<double>::infinity() : kSky;
            for (std::size_t i = 0; i < count; ++i) {
                if (planes[i].always) continue;
                const double at = planes[i].at(center), spread = planes[i].spread(half_px);
                ranges[i] = {at - spread, at + spread};
                nearest = std::max(nearest, ranges[i].low);
            }
            constexpr double kRounding = 1e-5;  // of a nearness: the shader has floats
            const double least = nearest - kRounding * std::abs(nearest);
            const std::size_t tile = grid.index(column, row);
            std::vector<int>& seen = tiles.seen[tile];
            for (std::size_t i = 0; i < count; ++i) {
                const bool in_front = orthographic || ranges[i].high > kSky;
                if (alone[i] && (planes[i].always || (in_front && ranges[i].high >= least)))
                    seen.push_back(static_cast<int>(i));
            }
            for (std::size_t i = 0; i < count; ++i) {
                if (!alone[i]) continue;
                const Nearness& plane = planes[i];
                // How far what is seen in the tile is at least from the plane, m: a point at
                // nearness q, its rays' plane at q', has a distance of deep (1 - q' / q), along
                // parallel rays deep (q - q').
                const double high = ranges[i].high;
                double away = plane.deep;
                if (orthographic)
                    away *= nearest - high;
                else if (high > kSky)
                    away *= nearest > kSky ? 1 - high / nearest : 0;
                if (plane.always || darkens(away - kRoom * plane.deep, i, seen))
                    tiles.shading[tile].push_back(static_cast<int>(i));
            }
        }
    }
    return tiles;
}

}  // namespace carom
