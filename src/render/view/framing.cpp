#include "render/view/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace carom {

using Box = Eigen::AlignedBox3d;

// ---- The ruler's place -------------------------------------------------------------------------

namespace {

/// The top of the ruler: the next mark above `height`, whole or half metres for what is seen from a
/// few steps away, 1-2-5 steps for what is much smaller or larger.
double rounded_up(double height) {
    double step = 0.5;
    if (height < 0.6 || height > 10) {
        const double power = std::pow(10, std::floor(std::log10(height / 2)));
        const double digit = height / 2 / power;
        step = power * (digit < 2 ? 1 : digit < 5 ? 2 : 5);
    } else if (height > 3) {
        step = 1;
    }
    constexpr double kRounding = 1e-6;  // of a step: a height on a mark needs no further mark
    return step * std::ceil(height / step - kRounding);
}

}  // namespace

std::optional<RulerStaff> place_ruler(const Scene& scene, const Motion& motion,
                                      const MotionExtent& extent, const Vec3& right,
                                      bool right_of_motion) {
    if (!scene.overlay.ruler) return std::nullopt;
    const RulerOptions& options = *scene.overlay.ruler;
    const Box& balls = extent.ball_box();
    RulerStaff staff;
    staff.from_m = options.from;
    staff.band = options.band;
    double height = extent.highest_bottom() - options.from;
    if (staff.band) height = std::max(height, (*staff.band)[1] - options.from);
    staff.to_m = options.from + rounded_up(height > 0 ? height : balls.sizes().z());
    if (options.to) staff.to_m = *options.to;
    if (options.at) {
        staff.foot = *options.at;
        return staff;
    }

    // Beside all balls, and beside what stands upright there, but not beside the slab below them.
    staff.right_of_motion = right_of_motion;
    const Vec3 outward = right_of_motion ? right : Vec3(-right);
    const double low = options.from + 0.15 * (staff.to_m - options.from);
    const double gap = 0.06 * balls.sizes().maxCoeff() + 0.3 * extent.largest_radius();
    const double lateral = extent.upright_support(outward, low) + gap;
    const int ball = extent.outermost_ball(outward);
    if (ball < 0) return staff;
    const double begin = std::clamp(scene.film.start, 0.0, motion.duration);
    const Vec3 beside = motion.balls[static_cast<std::size_t>(ball)].at(begin).position;
    staff.foot = (beside + (lateral - outward.dot(beside)) * outward).head<2>();
    return staff;
}

// ---- The camera --------------------------------------------------------------------------------

namespace {

constexpr double kFovDeg = 26;  // vertical; a long lens, so that heights compare well

// Free borders, in fractions of the picture's width and height.
constexpr double kSideMargin = 0.06;
constexpr double kTopMargin = 0.12;  // clock and labels
constexpr double kBottomMargin = 0.10;
// Room for the ruler's numbers beside it, in fractions of the picture's height.
constexpr double kRulerNumbers = 0.13;

struct Axes {
    Vec3 right, up, forward;
};

/// azimuth 0 looks along +y, 90 degrees along -x; elevation looks down.
Axes axes_of(double azimuth_deg, double elevation_deg) {
    const double az = azimuth_deg * std::numbers::pi / 180;
    const double el = elevation_deg * std::numbers::pi / 180;
    const Vec3 right(std::cos(az), std::sin(az), 0);
    const Vec3 level(-std::sin(az), std::cos(az), 0);
    const Vec3 forward = std::cos(el) * level - std::sin(el) * Vec3::UnitZ();
    return {right, right.cross(forward), forward};
}

/// What one side of the frame asks of the eye, see nearest_depth().
struct SideBound {
    double tangent;
    double bound;
};

/// The eye's depth and lateral place that hold both sides, as near as they allow:
///   e_r + t e_f <= bound on the low side, e_r - t e_f >= -bound on the high side.
double nearest_depth(const std::vector<SideBound>& low, const std::vector<SideBound>& high) {
    double depth = std::numeric_limits<double>::infinity();
    for (const SideBound& a : low)
        for (const SideBound& b : high)
            depth = std::min(depth, (a.bound + b.bound) / (a.tangent + b.tangent));
    return depth;
}

/// The middle of what is left at a depth.
double lateral_place(const std::vector<SideBound>& low, const std::vector<SideBound>& high,
                     double depth) {
    double most = std::numeric_limits<double>::infinity(), least = -most;
    for (const SideBound& a : low) most = std::min(most, a.bound - a.tangent * depth);
    for (const SideBound& b : high) least = std::max(least, b.tangent * depth - b.bound);
    return 0.5 * (most + least);
}

/// The largest n . p over the ends of the staff, as far as they lie near the motion.
double staff_support(const RulerStaff& staff, const Box& balls, const Vec3& n) {
    const double reach = 0.5 * balls.sizes().maxCoeff();
    const double low = std::clamp(staff.from_m, balls.min().z() - reach, balls.max().z() + reach);
    const double high = std::clamp(staff.to_m, balls.min().z() - reach, balls.max().z() + reach);
    return std::max(n.dot(Vec3(staff.foot.x(), staff.foot.y(), low)),
                    n.dot(Vec3(staff.foot.x(), staff.foot.y(), high)));
}

Camera solve_camera(const MotionExtent& extent, const std::optional<RulerStaff>& staff,
                    const Axes& axes, double aspect) {
    const double tan_y = std::tan(kFovDeg * std::numbers::pi / 360);
    const double tan_x = tan_y * aspect;
    // Inside of a side: outward . (p - eye) <= tangent * forward . (p - eye).
    const auto side = [&](const Vec3& outward, double tangent) {
        return SideBound{tangent, -extent.support(outward - tangent * axes.forward)};
    };
    std::vector<SideBound> left{side(-axes.right, tan_x * (1 - 2 * kSideMargin))};
    std::vector<SideBound> right{side(axes.right, tan_x * (1 - 2 * kSideMargin))};
    std::vector<SideBound> bottom{side(-axes.up, tan_y * (1 - 2 * kBottomMargin))};
    std::vector<SideBound> top{side(axes.up, tan_y * (1 - 2 * kTopMargin))};
    if (staff) {
        const auto add = [&](std::vector<SideBound>& sides, const Vec3& outward, double tangent) {
            const Vec3 n = outward - tangent * axes.forward;
            sides.push_back({tangent, -staff_support(*staff, extent.ball_box(), n)});
        };
        const double numbers = tan_x * (1 - kSideMargin) - 2 * tan_y * kRulerNumbers;
        const double free = std::max(numbers, 0.3 * tan_x);
        add(left, -axes.right, staff->right_of_motion ? tan_x * (1 - 2 * kSideMargin) : free);
        add(right, axes.right, staff->right_of_motion ? free : tan_x * (1 - 2 * kSideMargin));
        add(bottom, -axes.up, tan_y * (1 - kBottomMargin));
        add(top, axes.up, tan_y * (1 - kTopMargin));
    }

    // Near enough to fill the frame, but no ball looks more than three times as large as another.
    const double front = -extent.support(-axes.forward), back = extent.support(axes.forward);
    const double depth = std::min(
        {nearest_depth(left, right), nearest_depth(bottom, top), front - 0.5 * (back - front)});
    const Vec3 eye = lateral_place(left, right, depth) * axes.right +
                     lateral_place(bottom, top, depth) * axes.up + depth * axes.forward;
    Camera camera;
    camera.from = eye;
    camera.to = eye + (0.5 * (front + back) - depth) * axes.forward;
    camera.up = Vec3::UnitZ();
    camera.fov_deg = kFovDeg;
    return camera;
}

/// Balls live on the side that a plane's normal points to; from the other one nothing is seen.
bool sees_balls(const Scene& scene, const Camera& camera) {
    return std::all_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
        const auto* plane = std::get_if<PlaneShape>(&surface.shape);
        return !plane || plane->normal.dot(camera.from) > plane->offset_m;
    });
}

}  // namespace

Camera frame_motion(const Scene& scene, const Motion& motion, double aspect) {
    const MotionExtent extent(scene, motion);
    const Vec3 size = extent.ball_box().sizes();
    // From the front, or from the right where the motion runs towards the front.
    const bool deep = size.y() > 2 * size.x() && size.y() > 0.5 * size.z();
    const double first = deep ? 90 : 0;
    // Nearly level for an upright motion, so that verticals stay upright; for one that lies flat
    // 34 degrees.
    const double depth_ratio = (deep ? size.x() : size.y()) / std::max(size.z(), 1e-300);
    const double elevation = 3.5 + 30.5 * std::clamp((depth_ratio - 0.5) / 2, 0.0, 1.0);

    std::optional<Camera> choice;
    for (const double turn : {0.0, 90.0, -90.0, 180.0}) {
        for (const double lift : {0.0, 12.0, 24.0, 40.0}) {
            const Axes axes = axes_of(first + turn, elevation + lift);
            const auto staff = place_ruler(scene, motion, extent, axes.right);
            const Camera camera = solve_camera(extent, staff, axes, aspect);
            if (!choice) choice = camera;
            if (sees_balls(scene, camera)) return camera;
        }
    }
    return *choice;
}

}  // namespace carom
