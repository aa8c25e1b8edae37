#include "render/background/surface_rectangles.h"

#include <algorithm>
#include <map>
#include <utility>

namespace carom {

namespace {

class Writer {
  public:
    Writer(const SurfaceTable& table, const ScreenTiles& grid, const std::array<int, 2>& size_px,
           const std::vector<SurfaceSet>& seen, const std::vector<SurfaceSet>& shading,
           const PlaneTiles* planes)
        : table_(table),
          grid_(grid),
          size_px_(size_px),
          seen_(seen),
          shading_(shading),
          planes_(planes) {}
    SurfaceTiles written();

  private:
    std::array<float, 4> range_of(const SurfaceSet& set);
    std::array<float, 4> planes_of(std::size_t tile);
    void put(float record) { tiles_.entries.insert(tiles_.entries.end(), {record, 0, 0, 0}); }
    float filled() const {
        const std::size_t vec4s = tiles_.entries.size() / 4;
        return static_cast<float>(vec4s);
    }

    const SurfaceTable& table_;
    const ScreenTiles& grid_;
    std::array<int, 2> size_px_;
    const std::vector<SurfaceSet>&seen_, &shading_;  ///< per tile
    const PlaneTiles* planes_;
    std::map<SurfaceSet, std::array<float, 4>> ranges_;
    std::map<std::vector<int>, std::array<float, 2>> plane_ranges_;
    SurfaceTiles tiles_;
};

/// Where the set stands among the entries; written there if it is new.
std::array<float, 4> Writer::range_of(const SurfaceSet& set) {
    const auto [found, is_new] = ranges_.try_emplace(set);
    if (!is_new) return found->second;
    const std::array<int, 3> kinds = {table_.boxes, table_.spheres, table_.others};
    found->second[0] = filled();
    std::size_t body = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        for (int i = 0; i < kinds[kind]; ++i, ++body) {
            if (!set[body]) continue;
            put(static_cast<float>(body + static_cast<std::size_t>(table_.planes)));
        }
        found->second[kind + 1] = filled();
    }
    return found->second;
}

/// Of either list of planes, where it begins and ends among the entries.
std::array<float, 4> Writer::planes_of(std::size_t tile) {
    std::array<float, 4> ranges{};
    if (!planes_) return ranges;
    const auto place = [&](const std::vector<int>& planes, std::size_t at) {
        const auto [found, is_new] = plane_ranges_.try_emplace(planes);
        if (is_new) {
            found->second[0] = filled();
            for (const int plane : planes) put(static_cast<float>(plane));
            found->second[1] = filled();
        }
        ranges[at] = found->second[0];
        ranges[at + 1] = found->second[1];
    };
    place(planes_->seen[tile], 0);
    place(planes_->shading[tile], 2);
    return ranges;
}

/// Neighbouring tiles with the same lists become one rectangle: along a row, then downwards.
SurfaceTiles Writer::written() {
    struct Run {
        int first_column, last_column, row;
        std::array<float, 4> seen, shading, planes;
        bool same_lists(const Run& o) const {
            return seen == o.seen && shading == o.shading && planes == o.planes;
        }
        bool same(const Run& o) const {
            return first_column == o.first_column && last_column == o.last_column && same_lists(o);
        }
    };
    std::vector<Run> open;
    const auto close = [&](const Run& run, int end_row) {
        constexpr int kTilePx = ScreenTiles::kTilePx;
        for (const int px : {run.first_column * kTilePx, run.row * kTilePx,
                             std::min(size_px_[0], (run.last_column + 1) * kTilePx),
                             std::min(size_px_[1], end_row * kTilePx)})
            tiles_.rectangles.push_back(static_cast<float>(px));
        tiles_.rectangles.insert(tiles_.rectangles.end(), run.seen.begin(), run.seen.end());
        tiles_.rectangles.insert(tiles_.rectangles.end(), run.shading.begin(), run.shading.end());
        tiles_.rectangles.insert(tiles_.rectangles.end(), run.planes.begin(), run.planes.end());
    };
    for (int row = 0; row < grid_.rows(); ++row) {
        std::vector<Run> runs;
        for (int column = 0; column < grid_.columns(); ++column) {
            const std::size_t tile = grid_.index(column, row);
            const Run run{
                column,         column, row, range_of(seen_[tile]), range_of(shading_[tile]),
                planes_of(tile)};
            if (!runs.empty() && runs.back().same_lists(run))
                runs.back().last_column = column;
            else
                runs.push_back(run);
        }
        for (const Run& above : open) {
            const auto below = std::find_if(runs.begin(), runs.end(),
                                            [&](const Run& run) { return run.same(above); });
            if (below != runs.end())
                below->row = above.row;
            else
                close(above, row);
        }
        open = std::move(runs);
    }
    for (const Run& run : open) close(run, grid_.rows());
    put(0);
    return std::move(tiles_);
}

}  // namespace

SurfaceTiles joined_rectangles(const SurfaceTable& table, const ScreenTiles& grid,
                               const std::array<int, 2>& size_px,
                               const std::vector<SurfaceSet>& seen,
                               const std::vector<SurfaceSet>& shading, const PlaneTiles* planes) {
    return Writer(table, grid, size_px, seen, shading, planes).written();
}

}  // namespace carom
