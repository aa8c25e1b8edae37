#include "render/balls/mirrors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "render/background/surface_table.h"
#include "render/view/view_space.h"

namespace carom {

namespace {

Mirror plane_mirror(const PlaneShape& plane, const View& view) {
    Mirror mirror;
    mirror.normal = view_direction(view, plane.normal);
    mirror.offset = plane.offset_m - plane.normal.dot(view.eye());
    mirror.fades = true;
    return mirror;
}

Mirror box_mirror(const BoxShape& box, const PlaneShape& top, const View& view) {
    Mirror mirror = plane_mirror(top, view);
    mirror.fades = false;
    mirror.middle =
        view_point(view, box.center + top.normal * (top.offset_m - top.normal.dot(box.center)));
    const Mat3 axes = box.orientation.toRotationMatrix();
    Vec3* next = &mirror.axis_a;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(axes.col(i).dot(top.normal)) > 0.5) continue;
        *next = view_direction(view, axes.col(i)) / (0.5 * box.size[i]);
        next = &mirror.axis_b;
    }
    return mirror;
}

/// Planes and the tops of boxes mirror.
std::optional<Mirror> mirror_of(const PlaneShape& plane, const View& view) {
    if (!seen_from_front(plane, view)) return std::nullopt;
    return plane_mirror(plane, view);
}
std::optional<Mirror> mirror_of(const BoxShape& box, const View& view) {
    const PlaneShape top = top_of(box);
    if (!seen_from_front(top, view)) return std::nullopt;
    return box_mirror(box, top, view);
}
std::optional<Mirror> mirror_of(const SphereShape&, const View&) { return std::nullopt; }
std::optional<Mirror> mirror_of(const CapsuleShape&, const View&) { return std::nullopt; }
std::optional<Mirror> mirror_of(const CylinderShape&, const View&) { return std::nullopt; }
std::optional<Mirror> mirror_of(const RingShape&, const View&) { return std::nullopt; }
std::optional<Mirror> mirror_of(const BowlShape&, const View&) { return std::nullopt; }
std::optional<Mirror> mirror_of(const PipeShape&, const View&) { return std::nullopt; }

bool can_mirror(const SurfaceShape& shape) {
    return std::visit(
        PerShape{[](const PlaneShape&) { return true; }, [](const BoxShape&) { return true; },
                 [](const SphereShape&) { return false; },
                 [](const CapsuleShape&) { return false; },
                 [](const CylinderShape&) { return false; }, [](const RingShape&) { return false; },
                 [](const BowlShape&) { return false; }, [](const PipeShape&) { return false; }},
        shape);
}

}  // namespace

bool wants_reflection(const Scene& scene) {
    return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
        return can_mirror(surface.shape) &&
               scene.looks.at(static_cast<std::size_t>(surface.look)).reflection > 0;
    });
}

std::vector<Mirror> find_mirrors(const Scene& scene, const View& view) {
    std::vector<Mirror> mirrors;
    for (const Surface& surface : scene.surfaces) {
        const double strength = scene.looks.at(static_cast<std::size_t>(surface.look)).reflection;
        if (!(strength > 0)) continue;
        std::optional<Mirror> mirror =
            std::visit([&](const auto& shape) { return mirror_of(shape, view); }, surface.shape);
        if (!mirror) continue;
        mirror->strength = strength;
        mirrors.push_back(*mirror);
    }
    return mirrors;
}

std::vector<BallInView> mirror_images(const std::vector<BallInView>& balls, const Mirror& mirror,
                                      const View& view) {
    const Mat3 flip = Mat3::Identity() - 2 * mirror.normal * mirror.normal.transpose();
    std::vector<BallInView> images;
    for (const BallInView& ball : balls) {
        const double height = mirror.normal.dot(ball.center) - mirror.offset;
        if (height < -ball.radius) continue;  // all of it is behind the mirror
        BallInView& image = images.emplace_back(ball);
        image.center -= 2 * height * mirror.normal;
        image.ball_from_view = ball.ball_from_view * flip;
        image.sweep = flip * ball.sweep;
        image.turn = -(flip * ball.turn);  // what turns left turns right in a mirror
    }
    sort_for_drawing(images, view);
    return images;
}

}  // namespace carom
