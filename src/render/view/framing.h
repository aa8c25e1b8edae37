// Where the camera goes when the scene names none, and where the ruler stands.
#pragma once

#include <array>
#include <optional>

#include "core/types.h"
#include "motion/motion.h"
#include "render/runs/motion_extent.h"
#include "scene/scene.h"

namespace carom {

/// A vertical scale in the world: from (x, y, from_m) up to (x, y, to_m), heights in metres of z.
struct RulerStaff {
    Vec2 foot = Vec2::Zero();  ///< m
    double from_m = 0;
    double to_m = 1;
    bool right_of_motion = false;  ///< on which side of the balls it stands, as the camera sees it
    std::optional<std::array<double, 2>> band{};  ///< heights that it marks, m
};

/// The ruler that the scene asks for, or nothing. `right` is the camera's axis: without a place in
/// the scene the staff stands left of all balls (or right of them), in the depth of the ball that
/// comes nearest to it, so that perspective does not shift that ball's heights against it. A ball d
/// deeper than the staff, with the eye D away, reads wrong by d/D of its height over the eye.
std::optional<RulerStaff> place_ruler(const Scene& scene, const Motion& motion,
                                      const MotionExtent& extent, const Vec3& right,
                                      bool right_of_motion = false);

/// A camera from the front, slightly from above (more so for flat, deep motions), that holds the
/// whole extent and the ruler, with room at the top for clock and labels.
Camera frame_motion(const Scene& scene, const Motion& motion, double aspect);

}  // namespace carom
