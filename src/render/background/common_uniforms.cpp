#include "render/background/common_uniforms.h"

#include "render/view/view_space.h"

namespace carom {

std::vector<std::string> view_defines(const View& view) {
    if (view.orthographic()) return {"ORTHOGRAPHIC"};
    return {};
}

void set_common_uniforms(GlProgram& program, const View& view, const Lights& lights) {
    program.set("u_center", Vec2(0.5 * view.width_px(), 0.5 * view.height_px()));
    program.set("u_pixel", pixel_width(view));
    program.set("u_up", view_direction(view, Vec3::UnitZ()));
    program.set("u_light", view_direction(view, lights.to_light));
    program.set("u_light_tan", lights.tan_radius);
}

}  // namespace carom
