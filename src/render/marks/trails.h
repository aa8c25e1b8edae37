// The trails: the exact paths of the balls' centres up to an instant.
#pragma once

#include <deque>
#include <vector>

#include "core/image.h"
#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/element/element.h"
#include "render/element/trail_curve.h"
#include "render/element/trail_raster.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// Without end, each frame adds what is new; with `seconds`, the trail fades towards its past and
/// is drawn anew. Either way the picture at t is the same whatever was drawn before.
class TrailsElement : public Element {
  public:
    /// `scene` and `motion` must outlive it.
    TrailsElement(const Scene& scene, const Motion& motion, const View& view);

    void set_view(const View& view, const std::vector<PixelRect>& around) override;
    PixelRect update(double t) override;
    const Image& picture() const override { return raster_.picture(); }

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
    View view_;  ///< at which the curves look
    double seconds_;
    double half_width_;  ///< px
    std::vector<Line> lines_;
    TrailRaster raster_;
    double last_ = 0;
};

ElementKind trails_kind();

}  // namespace carom
