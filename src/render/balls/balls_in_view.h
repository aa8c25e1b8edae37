// The balls of one instant as the passes of a frame need them: view space, farthest first.
#pragma once

#include <optional>
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
    int instant = 0;  ///< balls of different instants cast no shadow on one another
    /// While a part of an open shutter's time passes, of which all else is the middle: the way of
    /// the centre, and the turn (axis times angle, of the ball in view space).
    Vec3 sweep = Vec3::Zero(), turn = Vec3::Zero();
    bool swept = false;  ///< false: both are 0
    bool drawn = true;   ///< false: it is there for the shadows that it casts on other balls
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

/// A part of the time in which a shutter is open, s of the motion.
struct OpenTime {
    double begin = 0, middle = 0, end = 0;
};

/// The balls of a part of an open shutter's time, each with its way and its turn: lines that follow
/// the motion as long as bends_px() is small.
std::vector<BallInView> balls_during(const OpenTime& open, const Scene& scene, const Motion& motion,
                                     const View& view);

/// How far the balls' ways are from straight lines at most, px; of those that `counts` has.
double bends_px(const OpenTime& open, const Motion& motion, const View& view,
                const std::vector<bool>& counts, std::size_t first);

/// Where a ball begins and ends its way; both the same where it is not swept.
Vec3 swept_from(const BallInView& ball);
Vec3 swept_to(const BallInView& ball);

/// Puts them in that order.
void sort_for_drawing(std::vector<BallInView>& balls, const View& view);

/// Around all that is seen of a ball, with its soft edge and all along its way, px; also beside the
/// picture. None where there is no ellipse.
struct PictureBound {
    double left, top, right, bottom;
};
std::optional<PictureBound> bound_of(const BallInView& ball, const View& view);

/// Around every pixel that shows something of it, with its soft edge, within the picture.
PixelRect bounds_in_picture(const BallInView& ball, const View& view);

/// False where no pixel shows it: not drawn, behind the eye, beside the picture, or around the eye.
bool may_be_seen(const BallInView& ball, const View& view);

}  // namespace carom
