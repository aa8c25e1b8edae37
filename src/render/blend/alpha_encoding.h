// Transparent pictures for viewers that blend encoded values, as nearly all do.
#pragma once

#include "core/image.h"
#include "core/pixel_rect.h"

namespace carom {

/// Turns what, in a part of a picture, was blended in linear light, with linear colour times
/// coverage stored as sRGB, into the Image's own form, such that a viewer that lays the picture
/// over white by blending encoded values shows what light would: with C the linear colour times
/// coverage, A the coverage and e the encoding of sRGB, the colour becomes e(C), which is right
/// over black, and
///   alpha = 1 - min over the channels of (e(C + 1 - A) - e(C)),
/// which is right over white for shadows and grey, and for colours in their largest channel.
void encode_alpha(Image& picture, const PixelRect& part);
inline void encode_alpha(Image& picture) {
    encode_alpha(picture, {0, 0, picture.width_px, picture.height_px});
}

}  // namespace carom
