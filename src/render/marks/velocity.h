// The balls' velocities as arrows.
#pragma once

#include <optional>
#include <vector>

#include "motion/motion.h"
#include "render/draw2d/style.h"
#include "render/element/element.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// An arrow on the screen, from a ball's centre p to p + scale v, px.
struct VelocityArrow {
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();
};

/// Drawn on the finished picture, in the colours of the trails. An arrow that is too short to be
/// seen fades out.
class VelocityElement : public Element {
  public:
    /// `scene` and `motion` must outlive it.
    VelocityElement(const Scene& scene, const Motion& motion, const View& view,
                    const Palette& palette);

    void set_view(const View& view, const std::vector<PixelRect>& around) override;

    /// Metres of arrow per m/s: the scene's, or 1, 2 or 5 times a power of ten, such that the
    /// fastest ball's arrow is at most a quarter of the picture high at the motion's distance.
    double scale_s() const { return scale_s_; }
    /// None behind the camera.
    std::optional<VelocityArrow> arrow(std::size_t ball, double t) const;
    void draw(double t, Image& picture) override;
    Appearance appearance(double t) override;

  private:
    double unit_px() const;

    const Scene& scene_;
    const Motion& motion_;
    View view_;
    Palette palette_;
    double scale_s_ = 0.1;
    std::vector<Ink> inks_;  ///< by ball
};

ElementKind velocity_kind();

}  // namespace carom
