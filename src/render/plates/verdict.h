// The verdict on a drop test: a plate at the top of the last frames.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "render/runs/rebound_verdict.h"
#include "scene/scene.h"

namespace carom {

class VerdictElement : public Element {
  public:
    /// `scene` has a test. The plate stands in the middle of the top, below what is `written`
    /// there; where it would cover more of what is `taken` (`written`, and the ruler), in the
    /// middle of the bottom, or in rows at a side. If there is no room at all, at the top; where
    /// its letters could not be read there, rect() is empty, and it must not be drawn.
    VerdictElement(const Scene& scene, const Motion& motion, const ReboundVerdict& verdict,
                   int width_px, int height_px, const std::vector<PixelRect>& written,
                   const std::vector<PixelRect>& taken, const Palette& palette = {});

    /// Shown in the film's last two seconds, but never before the rebound's top.
    bool shown_at(double t) const { return t >= from_s_; }
    void draw(double t, Image& picture) override;
    Appearance appearance(double t) override;
    PixelRect rect() const override { return rect_; }

  private:
    double from_s_ = 0;
    PixelRect rect_;
    Image plate_;
};

ElementKind verdict_kind();

}  // namespace carom
