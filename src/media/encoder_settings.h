// What FFmpeg's encoders are asked for. Only .cpp files of this folder include it.
#pragma once

#include "media/film_choice.h"
#include "media/libav.h"

namespace carom {

AVPixelFormat libav_pixel_format(PixelFormat format);

/// Size, pixels and colour tags: of Y'CbCr BT.709 in limited range, of RGB sRGB.
void set_picture_format(AVCodecContext& context, PixelFormat format, int width_px, int height_px);

/// Level, preset, and what we want of this encoder besides, on a context that has its size, pixels,
/// rate and threads. Less than 0: FFmpeg's error code.
int apply_settings(AVCodecContext& context, const FilmChoice& choice);

}  // namespace carom
