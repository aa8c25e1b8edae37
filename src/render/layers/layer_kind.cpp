#include "render/layers/layer_kind.h"

#include <array>

namespace carom {

namespace {

// What every reader of EXR files takes for depth, for grey, and for three colours.
constexpr std::array<std::string_view, 1> kZ = {"Z"}, kGrey = {"Y"};
constexpr std::array<std::string_view, 3> kThree = {"R", "G", "B"};

constexpr std::array kKinds = {
    LayerKindInfo{LayerKind::kDepth, "depth", kZ, "m",
                  "along the view axis; infinite where nothing is"},
    LayerKindInfo{LayerKind::kDistance, "distance", kGrey, "m",
                  "along the pixel's ray; infinite where nothing is"},
    LayerKindInfo{
        LayerKind::kSegmentation, "segmentation", {}, "", "0 where nothing is, else the body's id"},
    LayerKindInfo{LayerKind::kNormals, "normals", kThree, "",
                  "unit, world axes x, y, z, towards the eye; 0 where nothing is"},
    LayerKindInfo{LayerKind::kFlow, "flow", kThree, "px",
                  "to where the point is in the next frame: x right, y down; then 1 where it is "
                  "hidden there, else 0"},
    LayerKindInfo{LayerKind::kBackflow, "backflow", kThree, "px", "the same to the frame before"},
    LayerKindInfo{LayerKind::kCoordinates, "coordinates", kThree, "m",
                  "the point in the body's own axes from a ball's centre, of a surface in the "
                  "world's; not a number where nothing is"},
};

}  // namespace

std::span<const LayerKindInfo> layer_kinds() { return kKinds; }

const LayerKindInfo& layer_kind_info(LayerKind kind) {
    return kKinds[static_cast<std::size_t>(kind)];
}

const LayerKindInfo* find_layer_kind(std::string_view name) {
    for (const LayerKindInfo& info : kKinds)
        if (info.name == name) return &info;
    return nullptr;
}

}  // namespace carom
