// The layers that may be written beside a picture (docs/layers.md).
#pragma once

#include <span>
#include <string_view>

namespace carom {

enum class LayerKind {
    kDepth,
    kDistance,
    kSegmentation,
    kNormals,
    kFlow,
    kBackflow,
    kCoordinates,
};

struct LayerKindInfo {
    LayerKind kind;
    std::string_view name;  ///< of --layers, and in file names
    /// Names of its channels in a file, in the order of FloatImage; none for ids.
    std::span<const std::string_view> channels;
    std::string_view unit;
    std::string_view what;
};

/// One row for each kind, in the order of LayerKind.
std::span<const LayerKindInfo> layer_kinds();
const LayerKindInfo& layer_kind_info(LayerKind kind);

/// Null if none is called so.
const LayerKindInfo* find_layer_kind(std::string_view name);

}  // namespace carom
