// The balls of one picture: those of the scene, and those of the second run as ghosts.
#pragma once

#include <vector>

#include "render/balls/balls_in_view.h"
#include "render/runs/second_run.h"
#include "render/tile/tile_owners.h"

namespace carom {

/// Each sorted as balls_at() gives them. Where both runs agree, only the solid ball is there.
struct DrawnBalls {
    std::vector<BallInView> balls, ghosts;
};

/// `second` may be null: then there are no ghosts.
DrawnBalls drawn_balls_at(const std::vector<double>& instants, const Scene& scene,
                          const Motion& motion, const SecondRun* second, const View& view);

/// The same while a part of an open shutter's time passes.
DrawnBalls drawn_balls_during(const OpenTime& open, const Scene& scene, const Motion& motion,
                              const SecondRun* second, const View& view);

/// Adds the tiles in which the balls are seen, with their soft edges. Ball i of a scene is the body
/// first + i.
void mark_balls(const std::vector<BallInView>& balls, std::size_t first, const View& view,
                TileOwners& owners);

}  // namespace carom
