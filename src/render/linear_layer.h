// Layers of encoded colours laid over a picture in linear light, by the processor.
#pragma once

#include "core/image.h"

namespace carom {

/// A part of a picture, pixels, half open.
struct LayerBounds {
    int left = 0, top = 0, right = 0, bottom = 0;
    bool empty() const { return left >= right || top >= bottom; }
};

/// The smallest part that holds every pixel with some opacity.
LayerBounds filled_part(const Image& layer);

/// Lays the part of `layer` (encoded colours, premultiplied as cairo leaves them) that begins at
/// (left, top) over the whole of `target` (encoded; where it is not opaque, premultiplied in linear
/// light). The same as layer_fragment.glsl blends.
void lay_over_in_linear_light(const Image& layer, int left, int top, Image& target);

}  // namespace carom
