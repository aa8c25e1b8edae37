#include "render/layers/optical_flow.h"

#include <limits>

#include "core/infinity.h"
#include "render/layers/pixel_rays.h"

namespace carom {

namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

bool within(const View& view, double x_px, double y_px) {
    return x_px >= 0 && y_px >= 0 && x_px < view.width_px() && y_px < view.height_px();
}

/// Of what lies on the ray beyond all bodies.
bool sky_hidden(const SeenScene& to, const Ray& ray, double x_px, double y_px) {
    const int x = static_cast<int>(x_px), y = static_cast<int>(y_px);
    return to.balls->hides(ray, kInfinity, Seen::kNothing, x, y) ||
           to.surfaces->hides(ray, kInfinity, false, x, y);
}

Flow flow_of_sky(const SeenScene& from, const SeenScene& to, const Ray& ray, const Vec2& pixel) {
    const View& view = *to.view;
    Flow flow{Vec2(kNowhere, kNowhere), true};
    if (from.view == to.view) {
        flow.way = Vec2::Zero();
    } else if (view.orthographic()) {
        constexpr double kSame = 1e-12;
        if ((view.forward() - ray.direction).norm() > kSame) return flow;
        flow.way = Vec2::Zero();
    } else {
        const View::Projected seen = view.project(view.eye() + ray.direction);
        if (!(seen.depth_m > 0)) return flow;
        flow.way = Vec2(seen.x_px, seen.y_px) - pixel;
    }
    const Vec2 there = pixel + flow.way;
    flow.hidden = !within(view, there.x(), there.y()) ||
                  sky_hidden(to, pixel_ray(view, there.x(), there.y()), there.x(), there.y());
    return flow;
}

}  // namespace

Flow optical_flow(const SeenScene& from, const SeenScene& to, const Ray& ray, const Seen& seen,
                  const Vec2& pixel) {
    if (seen.body == Seen::kNothing) return flow_of_sky(from, to, ray, pixel);
    const bool is_ball = seen.body < to.balls->count();
    const bool stands = !is_ball && from.view == to.view;
    const View& view = *to.view;
    Vec3 point = ray.at(seen.distance);
    Vec3 from_center = Vec3::Zero();  // of a ball, as it has turned
    if (is_ball) {
        from_center = to.balls->world_from_ball(seen.body) *
                      (from.balls->world_from_ball(seen.body).transpose() *
                       (point - from.balls->sphere(seen.body).center));
        point = to.balls->sphere(seen.body).center + from_center;
    }
    const View::Projected there = view.project(point);
    if (!view.orthographic() && !(there.depth_m > 0)) return {Vec2(kNowhere, kNowhere), true};
    // A point that stands before a camera that stands: nothing but rounding.
    const Vec2 way = stands ? Vec2(Vec2::Zero()) : Vec2(Vec2(there.x_px, there.y_px) - pixel);
    const Vec2 place = pixel + way;
    if (!within(view, place.x(), place.y())) return {way, true};
    const Ray back = stands ? ray : ray_to(view, point);
    const double distance = stands ? seen.distance : (point - back.origin).norm();
    const int x = static_cast<int>(place.x()), y = static_cast<int>(place.y());
    const bool turned_away = is_ball && from_center.dot(back.direction) >= 0;
    const int own = is_ball ? seen.body : Seen::kNothing;
    return {way, turned_away || to.balls->hides(back, distance, own, x, y) ||
                     (!stands && to.surfaces->hides(back, distance, !is_ball, x, y))};
}

}  // namespace carom
