// Layers of encoded colours laid over a picture in linear light, by the processor.
#pragma once

#include "core/image.h"
#include "core/pixel_rect.h"

namespace carom {

/// The smallest part that holds every pixel with some opacity.
PixelRect filled_part(const Image& layer);

/// Lays the part of `layer` (encoded colours, premultiplied as cairo leaves them) that begins at
/// (left, top) over the whole of `target` (encoded; where it is not opaque, premultiplied in linear
/// light).
void lay_over_in_linear_light(const Image& layer, int left, int top, Image& target);

}  // namespace carom
