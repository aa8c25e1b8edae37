#include "render/picture_setup.h"

#include <algorithm>
#include <variant>

#include "core/check.h"
#include "render/camera_motion.h"
#include "render/mirrors.h"
#include "render/side_by_side.h"

namespace carom {

namespace {

std::optional<JoinedRuns> joined_runs(const Scene& scene, const Motion& motion,
                                      const PainterOptions& options) {
    CAROM_CHECK(options.width_px, >, 0);
    CAROM_CHECK(options.height_px, >, 0);
    if (options.against == nullptr) return std::nullopt;
    return join_runs(scene, motion, *options.against);
}

Camera chosen_camera(const Scene& scene, const Motion& motion, const PainterOptions& options,
                     const std::optional<JoinedRuns>& joined) {
    if (options.part != nullptr) return options.part->camera;
    const double aspect = static_cast<double>(options.width_px) / options.height_px;
    return joined ? choose_camera(joined->scene, joined->motion, aspect)
                  : choose_camera(scene, motion, aspect);
}

/// For one sharp picture the camera stands where it is then.
bool stands_for_one(const Scene& scene, const PainterOptions& options) {
    return options.only_at && !(scene.film.shutter_deg > 0);
}

Camera place_at(double t, const Camera& camera, const Motion& motion,
                const PainterOptions& options) {
    return camera_at(camera, options.part != nullptr ? *options.part->camera_motion : motion, t);
}

/// A camera that moves may come to see what it does not see at first.
StaticKind kind_of(const Scene& scene, const SurfaceTable& surfaces, bool moving) {
    const auto is_plane = [](const Surface& surface) {
        return std::holds_alternative<PlaneShape>(surface.shape);
    };
    StaticKind kind;
    kind.transparent = scene.background == Background::kTransparent;
    kind.occludes = surfaces.can_occlude();
    kind.mirrors = surfaces.reflection;
    if (moving) {
        kind.occludes = scene.surfaces.size() > 1 ||
                        !std::all_of(scene.surfaces.begin(), scene.surfaces.end(), is_plane);
        kind.mirrors = wants_reflection(scene);
    }
    return kind;
}

OverlayPainter make_overlay(const Scene& scene, const Motion& motion, const PictureSetup& setup,
                            const PainterOptions& options) {
    OverlayPainter::Runs runs;
    if (options.against != nullptr) runs = {options.against, &*setup.joined, true, nullptr};
    if (options.part != nullptr)
        runs = {nullptr, options.part->joined, false, &options.part->taken};
    return OverlayPainter(scene, motion, setup.view, runs);
}

}  // namespace

PictureSetup::PictureSetup(const Scene& scene, const Motion& motion, const PainterOptions& options)
    : joined(joined_runs(scene, motion, options)),
      camera(chosen_camera(scene, motion, options, joined)),
      moving(camera_moves(camera) && !stands_for_one(scene, options)),
      first(place_at(stands_for_one(scene, options) ? *options.only_at : scene.film.start, camera,
                     motion, options)),
      view(first, options.width_px, options.height_px),
      lights(choose_lights(View(place_at(scene.film.start, camera, motion, options),
                                options.width_px, options.height_px))),
      surfaces(make_surface_table(scene, view)),
      kind(kind_of(scene, surfaces, moving)),
      scale(scale_of(scene, first)),
      overlay(make_overlay(scene, motion, *this, options)) {}

}  // namespace carom
