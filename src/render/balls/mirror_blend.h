// Mirror images laid over the surface that mirrors them, by the processor: they cover little of a
// picture, and a program for it would take longer to compile than all of a picture's balls.
#pragma once

#include <cstdint>
#include <vector>

#include "render/balls/mirrors.h"
#include "render/view/camera.h"

namespace carom {

/// A part of the picture in memory, row by row from (left_px, top_px), four values a pixel.
struct MirrorPart {
    int left_px = 0, top_px = 0, width_px = 0, height_px = 0;
    std::vector<std::uint32_t> g_buffer;  ///< BackgroundPicture::g_buffer()
    std::vector<float> mirrored;          ///< BackgroundPicture::mirror()
    std::vector<float> images;            ///< RGBA, the balls behind the mirror alone: linear light
    std::vector<std::uint8_t> picture;    ///< BGRA
};

/// Takes away from the picture what the images hide of the light that is mirrored without them, and
/// adds them. `fade_m`: PictureScale.
void blend_images(const Mirror& mirror, const View& view, double fade_m, MirrorPart& part);

}  // namespace carom
