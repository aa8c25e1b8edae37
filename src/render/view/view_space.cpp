#include "render/view/view_space.h"

namespace carom {

Vec3 view_direction(const View& view, const Vec3& world) {
    return {world.dot(view.right()), -world.dot(view.up()), world.dot(view.forward())};
}

Vec3 view_point(const View& view, const Vec3& world) {
    return view_direction(view, world - view.eye());
}

double pixel_width(const View& view) { return 1.0 / view.pixels_per_metre(1); }

Vec2 view_pixel(const View& view, const Vec3& point) {
    return 0.5 * Vec2(view.width_px(), view.height_px()) +
           view.pixels_per_metre(point.z()) * point.head<2>();
}

}  // namespace carom
