// Pipes as two halves: a ball that is too large for a pipe's opening rests on both of its edges,
// and what the methods know of a surface is one contact with each ball.
#pragma once

#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// The scene with each pipe whose edges one of the balls can touch both at once split along its
/// middle, and per surface of it the one of `scene` that it is (of) [index]. Empty where there is
/// no such pipe. Halves are flush: to all other balls they are one surface (world/seams.h).
struct HalvedScene {
    Scene scene;
    std::vector<int> whole;
};
HalvedScene with_pipe_halves(const Scene& scene);

/// Gives the surfaces of a motion the numbers and names that they have in `scene`.
void make_whole(Motion& motion, const Scene& scene, const std::vector<int>& whole);

}  // namespace carom
