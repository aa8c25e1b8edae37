// A second run in a film: what the parts of a picture have to know of both.
#pragma once

#include <string>
#include <vector>

#include "motion/motion.h"
#include "scene/difference.h"
#include "scene/scene.h"

namespace carom {

/// The run that the first one is shown against. Its pictures are those of the first run's camera,
/// film and overlay; of its own scene only bodies and looks count.
struct SecondRun {
    Scene scene;
    Motion motion;       ///< held_until() the end of the first run's
    double ended_s = 0;  ///< when its own motion ends
    AgainstView view = AgainstView::kGhost;
    std::vector<SceneDifference> differences;  ///< for the text
    std::string first_name, second_name;       ///< where there are too many, or none
};

/// A ball that both runs have: indices into their balls.
struct BallPair {
    std::size_t first = 0, second = 0;
};

/// Balls of equal names, in the first scene's order.
std::vector<BallPair> paired_balls(const Scene& first, const Scene& second);

/// Whether so few values differ that a picture has room for all of them.
bool lists_values(const SecondRun& runs);

/// The path of a value, or with `brief` as much of its end as tells it from the others.
std::string shown_path(const SecondRun& runs, const SceneDifference& difference, bool brief);

/// "simulation.method: fixed" in lines, or the run's name where more differs than a picture has
/// room for: what stands over one half of a picture of two. `brief`: "method: fixed".
std::string run_caption(const SecondRun& runs, bool second, bool brief = false);

/// Throws Failure(kInput) where the runs cannot be shown together: no ball has the name of one of
/// the other, or a ghost would bounce off surfaces that the picture does not show.
void check_runs(const Scene& first, const SecondRun& second);

/// Whether ghosts of the second run touch what the first one shows.
bool same_surfaces(const Scene& first, const Scene& second);

/// The greatest distance of two balls of equal names at `t`.
struct Apart {
    double metres = 0;
    std::size_t pair = 0;
};
Apart farthest_apart(const Motion& first, const Motion& second, const std::vector<BallPair>& pairs,
                     double t);

/// "3.2 mm", "12 cm", "1.25 m": with the unit that suits; "0 mm" only where it is 0.
std::string distance_text(double metres);

/// Both runs as one, for what has to hold or to show both: the camera, the ruler, trails and plots.
/// The first run's balls come first. What belongs to the second has the ghosts' colour, and one
/// name.
struct BothRuns {
    Scene scene;
    Motion motion;
};
BothRuns both_runs(const Scene& scene, const Motion& motion, const SecondRun& second);

/// The motion from 0 to `duration`, which may lie after its end: then the balls stay where they
/// are.
Motion held_until(Motion motion, double duration);

}  // namespace carom
