// The verdict on a drop test: a plate at the top of the last frames.
#pragma once

#include <string>
#include <vector>

#include "render/overlay.h"
#include "render/overlay_style.h"
#include "render/rebound_verdict.h"

namespace carom {

class OverlayVerdict {
  public:
    /// `scene` has a test. The plate stands in the middle of the top, below what is `written`
    /// there; where it would cover more of what is `taken` (`written`, and the ruler), in the
    /// middle of the bottom, or in rows at a side. If there is no room at all, at the top; where
    /// its letters could not be read there, rect() is empty, and it must not be drawn.
    OverlayVerdict(const Scene& scene, const Motion& motion, const ReboundVerdict& verdict,
                   int width_px, int height_px, const std::vector<OverlayPainter::Rect>& written,
                   const std::vector<OverlayPainter::Rect>& taken, const Palette& palette = {});

    /// Shown in the film's last two seconds, but never before the rebound's top.
    bool shown_at(double t) const { return t >= from_s_; }
    void draw(Image& picture) const;
    OverlayPainter::Rect rect() const { return rect_; }

  private:
    double from_s_ = 0;
    OverlayPainter::Rect rect_;
    Image plate_;
};

}  // namespace carom
