// What a sweep draws anew for each run: balls at free places, and a camera.
#pragma once

#include <cstdint>
#include <string>

#include "scene/document.h"
#include "scene/report.h"
#include "scene/scene.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// Sets the camera's place in the document. Mistakes go to `report`.
void draw_camera(const Sweep& sweep, std::int64_t run, Node& root, Report& report);

/// Adds the groups' balls to the document. `scene` is the document's scene without them, which they
/// keep clear of. Each place is uniform in the region among those that are free (rejection), so
/// that earlier balls do not move for later ones. Returns why there is none, "" where all is well;
/// mistakes in keys go to `report`.
std::string draw_balls(const Sweep& sweep, std::int64_t run, const Scene& scene, Node& root,
                       Report& report);

/// Adds one ball of the group to the document: name, place [m], and the values of `each` at u.
/// For the check of a file, and for draw_balls().
void add_ball(const Sweep& sweep, const RandomBalls& group, const std::string& name,
              const Vec3& place, const std::vector<Node>& values, Node& root, Report& report);

}  // namespace carom
