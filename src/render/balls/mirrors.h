// Flat surfaces that mirror the balls: looks with `reflection` on planes and boxes' tops.
#pragma once

#include <vector>

#include "render/balls/balls_in_view.h"

namespace carom {

/// A flat part of a surface that mirrors; view space, metres.
struct Mirror {
    Vec3 normal = Vec3::UnitZ();  ///< unit
    double offset = 0;            ///< points p with normal . p = offset
    double strength = 0;          ///< Look::reflection
    /// Of a box's top: its middle, and its axes over their half lengths, so that inside
    /// |axis . (p - middle)| <= 1 holds for both. 0 on a plane.
    Vec3 middle = Vec3::Zero(), axis_a = Vec3::Zero(), axis_b = Vec3::Zero();
    bool fades = false;  ///< a plane, which melts into the horizon
};

/// The mirrors of a scene that this view sees from their front.
std::vector<Mirror> find_mirrors(const Scene& scene, const View& view);

/// The balls behind the mirror, in the order in which they must be drawn.
std::vector<BallInView> mirror_images(const std::vector<BallInView>& balls, const Mirror& mirror,
                                      const View& view);

/// True where a look asks for a reflection on a plane or a box.
bool wants_reflection(const Scene& scene);

}  // namespace carom
