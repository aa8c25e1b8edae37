// What moves below the balls, trails and peaks, as part of a picture.
#pragma once

#include <vector>

#include "core/pixel_rect.h"
#include "render/gl/gl.h"
#include "render/overlay/overlay.h"

namespace carom {

class MovingLayer {
  public:
    /// `gl` and `overlay` must outlive it; `view_moves` from picture to picture.
    MovingLayer(const Gl& gl, OverlayPainter& overlay, bool view_moves)
        : gl_(gl), overlay_(overlay), view_moves_(view_moves) {}

    /// Brings it to the instant t; returns what changed of it, within the picture.
    PixelRect update(double t);

    /// Lays it over parts of the picture that `frame` draws into `color`; `frame` is bound
    /// afterwards.
    void lay_over(const std::vector<PixelRect>& parts, const GlFramebuffer& frame,
                  const GlTexture& color) const;

  private:
    const Gl& gl_;
    OverlayPainter& overlay_;
    bool view_moves_;
    std::vector<PixelRect> filled_;  ///< it has never filled anything else
};

}  // namespace carom
