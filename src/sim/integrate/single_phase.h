// What the method `exact` keeps of one ball that is integrated on a curved contact.
#pragma once

#include <limits>

#include "sim/integrate/single_motion.h"

namespace carom {

struct IntegratedPhase {
    SingleContact contact;
    ContactMode mode = ContactMode::kSmooth;
    ContactState state;                ///< at the end of the piece at hand
    SingleEnd end = SingleEnd::kNone;  ///< of that piece
    double next_seconds = 0;           ///< a good length for the next one
    // How often something has ended at once at one instant [s].
    double last_begin = -std::numeric_limits<double>::infinity();
    int at_once = 0;
    double begun = -std::numeric_limits<double>::infinity();  ///< s, the last piece
    int short_pieces = 0;                                     ///< of late (held_balls.cpp)
    /// s: it was given up on (SingleEnd::kGivenUp, or pieces short for too long), and is stepped
    /// until then, ...
    double stepped_until = -std::numeric_limits<double>::infinity();
    double stepped_seconds = 0;  ///< ... for so long; twice as long each time
};

}  // namespace carom
