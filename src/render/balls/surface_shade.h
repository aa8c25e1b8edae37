// What the static bodies do to the light on a ball, worked out once per ball and frame.
#pragma once

#include <vector>

#include "render/balls/balls_in_view.h"
#include "render/view/lights.h"
#include "scene/scene.h"

namespace carom {

struct BallShade {
    double key = 1;                ///< part of the key light that reaches the ball
    Vec3 contact = Vec3::UnitZ();  ///< view space, unit, towards the nearest surface
    double contact_strength = 0;   ///< 1 where the ball touches it, 0 three radii away
};

/// The static surfaces of a scene, ready to be asked. `scene` must outlive it.
class SurfaceShade {
  public:
    SurfaceShade(const Scene& scene, const View& view, const Lights& lights);
    BallShade on(const BallInView& ball) const;

  private:
    struct Body {
        SurfaceShape shape;  ///< in view space
        Vec3 center = Vec3::Zero();
        double bound = 0;  ///< radius around `center`; infinite for planes
    };
    double key_past(const Body& body, const BallInView& ball) const;

    std::vector<Body> bodies_;
    Vec3 to_light_, side_, side2_;  ///< view space
    double tan_radius_;
};

}  // namespace carom
