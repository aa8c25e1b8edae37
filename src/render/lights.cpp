#include "render/lights.h"

#include <cmath>

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

std::vector<std::string> view_defines(const View& view) {
    if (view.orthographic()) return {"ORTHOGRAPHIC"};
    return {};
}

Lights choose_lights(const View& view) {
    const Vec3 up = Vec3::UnitZ();
    // The camera's right hand, made level; a camera that is rolled on its side uses its heading.
    Vec3 right = view.right() - up * up.dot(view.right());
    if (right.norm() < 1e-3) right = view.up().cross(up);
    if (right.norm() < 1e-3) right = Vec3::UnitX();
    right.normalize();
    const Vec3 towards_viewer = right.cross(up);

    Lights lights;
    lights.to_light = (-0.50 * right + 0.42 * towards_viewer + 1.0 * up).normalized();
    return lights;
}

void set_common_uniforms(GlProgram& program, const View& view, const Lights& lights) {
    program.set("u_center", Vec2(0.5 * view.width_px(), 0.5 * view.height_px()));
    program.set("u_pixel", pixel_width(view));
    program.set("u_up", view_direction(view, Vec3::UnitZ()));
    program.set("u_light", view_direction(view, lights.to_light));
    program.set("u_light_tan", lights.tan_radius);
}

double linear_from_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace carom
