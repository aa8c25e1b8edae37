// The texture that pictures are drawn into, and what passes between it and memory.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "render/background/background_picture.h"
#include "render/gl/offscreen.h"

namespace carom {

class PictureTarget {
  public:
    /// In the context, which is current and outlives it. Failure(kRun) where its driver draws
    /// nothing so large.
    PictureTarget(OffscreenContext& context, int width_px, int height_px);

    /// Until then there is no color().
    void make_color();
    const GlTexture& color() const { return color_; }
    PixelRect whole() const { return {0, 0, width_px_, height_px_}; }

    /// Lays the background into parts of the picture that do not overlap; `frame` is a framebuffer
    /// of color(), which is bound afterwards.
    void restore(const std::vector<PixelRect>& parts, const BackgroundPicture& background,
                 const GlFramebuffer& frame);

    /// Makes `frame` the one that is drawn into.
    void aim(const GlFramebuffer& frame);

    /// Reads parts into a picture of the same size.
    void read(const std::vector<PixelRect>& parts, const GlFramebuffer& frame, Image& picture);

    /// Keeps parts of a picture as they are, to find those that differ from them later.
    void keep(const std::vector<PixelRect>& parts, const Image& picture);
    std::vector<PixelRect> differing(const std::vector<PixelRect>& parts,
                                     const Image& picture) const;

    /// Drivers are known that draw nothing and report no error: Failure(kRun).
    void check_not_blank(bool transparent, const BackgroundPicture& background,
                         const GlFramebuffer& frame);
    /// The same in two halves, around the first drawing into `frame`.
    void expect_drawing(bool transparent, const GlFramebuffer& frame);
    void check_drawn(bool transparent, const GlFramebuffer& frame);
    bool checked() const { return checked_; }

  private:
    OffscreenContext& context_;
    const Gl& gl_;
    int width_px_, height_px_;
    bool checked_ = false;
    GlTexture color_;
    std::vector<std::uint8_t> kept_;  ///< row by row, part by part
};

}  // namespace carom
