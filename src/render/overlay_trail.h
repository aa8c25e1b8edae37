// The trails: the exact paths of the balls' centres up to an instant.
#pragma once

#include <deque>
#include <vector>

#include "motion/motion.h"
#include "render/camera.h"
#include "render/overlay.h"
#include "render/trail_curve.h"
#include "render/trail_raster.h"
#include "scene/scene.h"

namespace carom {

/// A colour of the ball's look that is legible on a light floor, or on a dark one.
Ink trail_ink(const Look& look, Theme theme = Theme::kLight);

/// Without end, each frame adds what is new; with `seconds`, the trail fades towards its past and
/// is drawn anew. Either way the picture at t is the same whatever was drawn before.
class OverlayTrails {
  public:
    /// `scene`, `motion` and `view` must outlive it.
    OverlayTrails(const Scene& scene, const Motion& motion, const View& view);

    /// All is drawn anew.
    void view_has_changed();

    /// Returns what changed since the last call.
    OverlayPainter::Rect update(double t);
    const Image& picture() const { return raster_.picture(); }

  private:
    struct Line {
        TrailCurve curve;
        std::deque<TrailPoint> corners;  ///< of the part that is still to be drawn
    };

    void start_over();
    void extend(std::size_t line, double t);
    void draw_fading(std::size_t line, double t);
    void segment(std::size_t line, const TrailPoint& from, const TrailPoint& to, double t,
                 bool for_good);

    const Motion& motion_;
    const View& view_;
    double seconds_;
    double half_width_;  ///< px
    std::vector<Line> lines_;
    TrailRaster raster_;
    double last_ = 0;
};

}  // namespace carom
