// The camera: from the scene, or framed around the whole motion.
#pragma once

#include "core/types.h"
#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// The scene's camera, or one that keeps every ball at every time in view with a margin.
Camera choose_camera(const Scene& scene, const Motion& motion, double aspect);

/// World to pixels of a camera: x to the right, y down from the top left corner of the picture.
class View {
  public:
    View(const Camera& camera, int width_px, int height_px);

    /// Pixel coordinates and depth along the view axis [m]; behind the camera depth is <= 0.
    struct Projected {
        double x_px = 0;
        double y_px = 0;
        double depth_m = 0;
    };
    Projected project(const Vec3& world) const;
    double pixels_per_metre(double depth_m) const;
    /// Parallel rays: a metre is as many pixels at any depth.
    bool orthographic() const { return orthographic_; }

    const Vec3& eye() const { return eye_; }
    const Vec3& right() const { return right_; }      ///< unit
    const Vec3& up() const { return up_; }            ///< unit
    const Vec3& forward() const { return forward_; }  ///< unit
    /// Half the picture's height over the distance; under parallel rays that of `to`.
    double tan_half_fov_y() const { return tan_half_fov_y_; }
    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }

  private:
    Vec3 eye_, right_, up_, forward_;
    bool orthographic_;
    double metre_px_ = 0;  ///< of parallel rays
    double tan_half_fov_y_;
    int width_px_, height_px_;
};

}  // namespace carom
