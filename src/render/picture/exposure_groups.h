// What blurs together: each part of the picture is drawn as often as what moves there needs.
#pragma once

#include <vector>

#include "render/balls/drawn_balls.h"
#include "render/tile/tile_owners.h"
#include "render/view/exposure.h"

namespace carom {

/// Bodies that are averaged over the same instants.
struct ExposureGroup {
    int count = 1;                      ///< of instants
    std::vector<bool> bodies;           ///< the scene's balls, then those of the second run
    std::vector<TileMask::Part> parts;  ///< of the picture, where they and nothing else is seen
};

/// At most eight or so, from `most` instants down by halves: each group of bodies that share tiles
/// is in the one with the fewest instants that are enough for the longest way in it (`ways_px`, per
/// body). What needs no blur is in none.
std::vector<ExposureGroup> sort_exposure(const TileOwners& owners,
                                         const std::vector<double>& ways_px, int most);

/// Leaves only the bodies of the group to be drawn; `balls` is how many the scene has.
void draw_only(const ExposureGroup& group, std::size_t balls, DrawnBalls& bodies);

}  // namespace carom
