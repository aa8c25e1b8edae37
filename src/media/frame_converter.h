// From drawn pictures to the pixels of a film.
#pragma once

#include "core/image.h"
#include "media/palette.h"
#include "media/pixel_format.h"
#include "media/straight_alpha.h"
#include "media/yuv420.h"
#include "media/yuv_planes.h"

namespace carom {

/// Converts frame after frame into one pixel format. Where that has alpha it is straight; where it
/// has none, what is transparent lies over black. Exact for RGB; Y'CbCr is rounded once. One object
/// per film and thread: it keeps buffers, and for kPalette the palette.
class FrameConverter {
  public:
    explicit FrameConverter(PixelFormat format) : info_(pixel_format_info(format)) {}

    /// The planes are as FFmpeg lays them out: of kPalette the second holds 256 colours 0xAARRGGBB;
    /// alpha is left out where its plane is null. Planes that hold the frame before are brought up
    /// to date in what has `changed` since.
    void convert(const Image& image, const ChangedParts& changed, const FramePlanes& planes);

  private:
    void convert_part(const Image& image, const PixelRect& part, const FramePlanes& planes);
    void convert_rgb(const Image& image, const PixelRect& part, const FramePlanes& planes);
    void convert_palette(const Image& image, const FramePlanes& planes);

    const PixelFormatInfo& info_;
    Image straight_;
    StraightAlpha straight_alpha_;
    Yuv420Converter yuv420_;
    FilmPalette palette_;
};

}  // namespace carom
