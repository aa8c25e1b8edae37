// What of a scene is seen, as JSON: camera, surfaces, looks.
#pragma once

#include <nlohmann/json.hpp>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// {"from", "to", "up", "fov_deg" or "height", "aspect"}; of a camera that moves also "rate" (1/s)
/// and "keys": rows of from, to and fov_deg at k / rate (docs/exports.md).
nlohmann::ordered_json camera_json(const Scene& scene, const Motion& motion);

/// One object a surface: name, look, and the shape's parameters under the name of its key.
nlohmann::ordered_json surfaces_json(const Scene& scene);

nlohmann::ordered_json look_json(const Look& look);

/// Three numbers; -0 is 0.
nlohmann::ordered_json vector_json(const Vec3& v);

}  // namespace carom
