// The balls of one instant as the passes of a frame need them: view space, farthest first.
#pragma once

#include <vector>

#include "core/pixel_rect.h"
#include "motion/motion.h"
#include "render/view/camera.h"
#include "scene/scene.h"

namespace carom {

/// One ball at one instant, view space (render/view/view_space.h), metres.
struct BallInView {
    Vec3 center = Vec3::Zero();
    double radius = 0;
    Mat3 ball_from_view = Mat3::Identity();  ///< rotation into the ball's own axes
    int index = 0;                           ///< into Scene::balls
    int look = 0;                            ///< into Scene::looks
    int instant = 0;    ///< balls of different instants cast no shadow on one another
    bool drawn = true;  ///< false: it is there for the shadows that it casts on other balls
};

/// A sphere's outline on the picture: an ellipse, pixels. There is none if the sphere reaches
/// behind the eye's plane (the outline may be a hyperbola); then the whole picture is its bound.
struct Outline {
    bool is_ellipse = false;
    Vec2 center = Vec2::Zero();
    Vec2 major = Vec2::Zero();  ///< semi-axes
    Vec2 minor = Vec2::Zero();
};
Outline project_sphere(const Vec3& center, double radius, const View& view);

/// All balls at `t`, in the order in which they must be drawn: |c|^2 - r^2 descending orders
/// disjoint spheres exactly (of two, the one with the smaller power of the eye is never behind);
/// under parallel rays the depth of the centre does.
std::vector<BallInView> balls_at(double t, const Scene& scene, const Motion& motion,
                                 const View& view);

/// The balls of several instants (increasing), in the same order; of two as near as each other the
/// later one is in front. A ball that has not moved since is there once.
std::vector<BallInView> balls_at(const std::vector<double>& instants, const Scene& scene,
                                 const Motion& motion, const View& view);

/// Puts them in that order.
void sort_for_drawing(std::vector<BallInView>& balls, const View& view);

/// Around every pixel that shows something of it, with its soft edge, within the picture.
PixelRect bounds_in_picture(const BallInView& ball, const View& view);

/// False where no pixel shows it: not drawn, behind the eye, beside the picture, or around the eye.
bool may_be_seen(const BallInView& ball, const View& view);

}  // namespace carom
