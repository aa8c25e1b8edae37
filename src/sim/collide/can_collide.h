// Whether the balls of a scene can meet at all.
#pragma once

#include <string>

#include "scene/scene.h"
#include "sim/contact/restitution.h"

namespace carom {

struct CanCollide {
    bool possible = true;
    std::string why;
};

/// Looks for a reason why no two balls can ever touch; without one they can. The reason is sought
/// where it is cheap and certain: all surfaces are planes, and nothing pushes balls across the
/// planes' normals, so that the balls keep their relative velocity across them. (Without friction
/// that is so on any planes; with friction, on parallel planes across gravity, for balls that start
/// without any motion along them and without spin.)
CanCollide can_collide(const Scene& scene, const PairTable& pairs, double duration);

}  // namespace carom
