// What is written and drawn over the picture with cairo: ruler, clock, labels, trails.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/image.h"
#include "motion/motion.h"
#include "render/camera.h"
#include "scene/scene.h"

namespace carom {

/// Two layers, because a ball may pass in front of a ruler but never in front of the clock:
/// `under` lies on the background and below the balls, `over` is drawn on the finished picture.
/// Fonts come from a package (see packages.txt); a missing one is Failure(kRun).
class OverlayPainter {
  public:
    /// `scene` and `motion` must outlive it.
    OverlayPainter(const Scene& scene, const Motion& motion, const View& view);
    ~OverlayPainter();
    OverlayPainter(OverlayPainter&&) noexcept;
    OverlayPainter& operator=(OverlayPainter&&) noexcept;

    /// Pixels, half open; empty when width or height is 0.
    struct Rect {
        int x = 0, y = 0, width = 0, height = 0;
        bool empty() const { return width <= 0 || height <= 0; }
    };

    /// The ruler: does not change with time, so it is drawn at each call and not kept. Empty
    /// picture if nothing is to be drawn.
    Image static_under_layer() const;

    /// The trails at t, premultiplied on transparent, kept up to date in one picture of the film's
    /// size; returns the rectangle that changed since the last call.
    bool has_moving_under_layer() const;
    Rect update_moving_under_layer(double t);
    const Image& moving_under_layer() const;

    /// Clock, verdict and labels on the finished picture.
    void draw_over(double t, Image& picture) const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace carom
