#include "render/view/exposure.h"

#include <algorithm>
#include <cmath>

#include "render/view/camera_motion.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

/// Places along the exposure at which ways are measured: a bounce between two is hardly shortened.
constexpr int kParts = 16;

Film from_zero(Film film) {
    film.start = 0;
    return film;
}

}  // namespace

Exposure::Exposure(const Film& film, double duration, double t)
    : film_(from_zero(film)), longest_(duration) {
    const double half = film.shutter_deg / 720 / film.fps.per_second();
    const double middle = film_time(film_, t);
    open_ = std::max(middle - half, 0.0);
    shut_ = std::min(middle + half, film_time(film_, duration));
}

double Exposure::at(double part) const {
    const double t = motion_time(film_, open_ + part * (shut_ - open_));
    return std::clamp(t, 0.0, longest_);
}

int exposure_count(double way_px) {
    if (!(way_px > kLeastBlurPx)) return 1;
    const double fine = std::min(std::ceil(way_px / kFineStepPx), kFineInstants);
    const double wanted = std::max(std::ceil(way_px / kExposureStepPx), fine);
    return static_cast<int>(std::clamp(wanted, kFewestInstants, double{kMostInstants}));
}

int sweep_count(int count) {
    // What a part leaves of its error in the mean is a twelfth: codes of 255, as of instants.
    constexpr int kFewest = 12;
    return count <= kFewest ? count : std::max(kFewest, (count + 3) / 4);
}

std::vector<double> exposure_instants(const Exposure& exposure, int count) {
    std::vector<double> instants;
    for (int i = 0; i < count; ++i) instants.push_back(exposure.at((i + 0.5) / count));
    return instants;
}

std::vector<BallWay> ball_ways_px(const Scene& scene, const Motion& motion,
                                  const Exposure& exposure, const View& view) {
    std::vector<BallWay> ways;
    for (std::size_t b = 0; b < motion.balls.size(); ++b) {
        const double radius = scene.balls[b].radius;
        // Of a ball of one colour no turn is seen.
        const LookStyle style = scene.looks[static_cast<std::size_t>(scene.balls[b].look)].style;
        const bool marked = style != LookStyle::kPlain;
        BallWay way;
        double last_t = exposure.at(0);
        View::Projected last = view.project(motion.balls[b].at(last_t).position);
        for (int i = 1; i <= kParts; ++i) {
            const double t = exposure.at(static_cast<double>(i) / kParts);
            const BallState state = motion.balls[b].at(t);
            const View::Projected now = view.project(state.position);
            const bool ahead = std::min(last.depth_m, now.depth_m) > radius;
            // The ball, grown by its way, must reach into the picture to count.
            const double reach = ahead ? radius * view.pixels_per_metre(now.depth_m) : 0;
            const double part = std::hypot(now.x_px - last.x_px, now.y_px - last.y_px) +
                                (marked ? state.spin.norm() * (t - last_t) * reach : 0);
            const auto beside = [&](double a, double b2, int size) {
                return std::max(a, b2) < -reach || std::min(a, b2) > size + reach;
            };
            if (ahead) way.all += part;
            if (ahead && !beside(last.x_px, now.x_px, view.width_px()) &&
                !beside(last.y_px, now.y_px, view.height_px()))
                way.seen += part;
            last = now;
            last_t = t;
        }
        ways.push_back(way);
    }
    return ways;
}

double camera_way_px(const Camera& camera, const Motion& motion, const Exposure& exposure,
                     int width_px, int height_px) {
    double ways[5] = {};
    View last(camera_at(camera, motion, exposure.at(0)), width_px, height_px);
    double depth = (camera_at(camera, motion, exposure.at(0)).to - last.eye()).norm();
    for (int i = 1; i <= kParts; ++i) {
        const Camera now_camera =
            camera_at(camera, motion, exposure.at(static_cast<double>(i) / kParts));
        const View now(now_camera, width_px, height_px);
        // The middle and the corners of the picture at the distance that the camera looks at.
        const double half_y = 0.5 * height_px / last.pixels_per_metre(depth);
        const double half_x = half_y * width_px / height_px;
        const double at[5][2] = {{0, 0}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
        for (int k = 0; k < 5; ++k) {
            const Vec3 world = last.eye() + depth * last.forward() +
                               at[k][0] * half_x * last.right() + at[k][1] * half_y * last.up();
            const View::Projected a = last.project(world), b = now.project(world);
            if (b.depth_m > 0) ways[k] += std::hypot(b.x_px - a.x_px, b.y_px - a.y_px);
        }
        depth = (now_camera.to - now.eye()).norm();
        last = now;
    }
    return *std::max_element(std::begin(ways), std::end(ways));
}

}  // namespace carom
