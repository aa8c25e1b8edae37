// View space and the light: what all shaders are told about the camera.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "render/camera.h"
#include "render/gl_program.h"

namespace carom {

/// View space: the eye is the origin, x right, y down, z forward; metres. Computed in double from
/// world coordinates, so that a scene far from the origin loses nothing at the float border.
Vec3 view_direction(const View& view, const Vec3& world);
Vec3 view_point(const View& view, const Vec3& world);

/// Width of a pixel on the plane one metre before the eye, or everywhere under parallel rays, m.
double pixel_width(const View& view);

/// Where a point of view space, before the eye, is seen: pixels.
Vec2 view_pixel(const View& view, const Vec3& point);

/// What common.glsl must be told before it is compiled for this view.
std::vector<std::string> view_defines(const View& view);

/// One directional key light with the size of a studio lamp, plus the sky (common.glsl).
struct Lights {
    Vec3 to_light = Vec3::UnitZ();  ///< world, unit, towards the lamp
    /// Tangent of the lamp's angular radius: the half-width of a penumbra per metre of distance.
    double tan_radius = 0.045;
};

/// From the upper left, before the scene: relative to the camera's heading, so that the lit side of
/// a ball is seen from everywhere, and always from above the floor (world z is up).
Lights choose_lights(const View& view);

/// Sets the uniforms of common.glsl in the program, which becomes current.
void set_common_uniforms(GlProgram& program, const View& view, const Lights& lights);

/// sRGB in 0 ... 1 to linear (IEC 61966-2-1).
double linear_from_srgb(double encoded);

}  // namespace carom
