#include "render/picture/picture_setup.h"

#include <algorithm>
#include <variant>

#include "core/check.h"
#include "render/balls/mirrors.h"
#include "render/view/camera_motion.h"

namespace carom {

namespace {

std::optional<BothRuns> runs_of_ghosts(const Scene& scene, const Motion& motion,
                                       const PainterOptions& options) {
    CAROM_CHECK(options.width_px, >, 0);
    CAROM_CHECK(options.height_px, >, 0);
    if (options.second == nullptr) return std::nullopt;
    return both_runs(scene, motion, *options.second);
}

Camera chosen_camera(const Scene& scene, const Motion& motion, const PainterOptions& options,
                     const PictureHalf* half, const std::optional<BothRuns>& both) {
    if (half != nullptr) return half->camera;
    const double aspect = static_cast<double>(options.width_px) / options.height_px;
    return both ? choose_camera(both->scene, both->motion, aspect)
                : choose_camera(scene, motion, aspect);
}

/// For one sharp picture the camera stands where it is then.
bool stands_for_one(const Scene& scene, const PainterOptions& options) {
    return options.only_at && !(scene.film.shutter_deg > 0);
}

Camera place_at(double t, const Camera& camera, const Motion& motion, const PictureHalf* half) {
    return camera_at(camera, half != nullptr ? *half->camera_motion : motion, t);
}

/// A camera that moves may come to see what it does not see at first.
BackgroundKind kind_of(const Scene& scene, const SurfaceTable& surfaces, bool moving) {
    const auto is_plane = [](const Surface& surface) {
        return std::holds_alternative<PlaneShape>(surface.shape);
    };
    BackgroundKind kind;
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

OverlayPainter::Runs overlaid_runs(const PictureSetup& setup, const PainterOptions& options,
                                   const PictureHalf* half) {
    if (half != nullptr) return {half->part, half->second, half->both, half->taken};
    if (options.second == nullptr) return {};
    return {PicturePart::kWhole, options.second, &*setup.both, {}};
}

}  // namespace

PictureSetup::PictureSetup(const Scene& scene, const Motion& motion, const PainterOptions& options,
                           const PictureHalf* half)
    : both(runs_of_ghosts(scene, motion, options)),
      camera(chosen_camera(scene, motion, options, half, both)),
      moving(camera_moves(camera) && !stands_for_one(scene, options)),
      first(place_at(stands_for_one(scene, options) ? *options.only_at : scene.film.start, camera,
                     motion, half)),
      view(first, options.width_px, options.height_px),
      lights(choose_lights(View(place_at(scene.film.start, camera, motion, half), options.width_px,
                                options.height_px))),
      surfaces(make_surface_table(scene, view)),
      kind(kind_of(scene, surfaces, moving)),
      scale(scale_of(scene, first)),
      overlay(scene, motion, view, overlaid_runs(*this, options, half)) {}

}  // namespace carom
