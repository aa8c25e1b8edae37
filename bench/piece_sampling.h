// Energies of a motion at equidistant instants, piece by piece: no search for the piece, and the
// loop over the instants of one piece is one that the compiler makes vector instructions of.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/motion.h"
#include "scene/scene.h"

namespace carom::bench {

/// Kinetic and potential energy of all balls [J] at k `sampling`, k = 0 ... samples - 1.
std::vector<double> sample_energies(const Scene& scene, const Motion& motion, double sampling,
                                    std::size_t samples);

}  // namespace carom::bench
