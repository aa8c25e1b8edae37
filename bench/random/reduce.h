// Smaller scenes that fail alike.
#pragma once

#include "trials.h"

namespace carom::bench {

struct Reduced {
    Trial trial;
    Verdict verdict;
};

/// Leaves out balls and surfaces and ends the motion soon after the failure, as long as the
/// symptom stays; at most `tries` times. Of two scenes (seams) only the end is moved.
Reduced reduce(const Kind& kind, const Trial& trial, const Verdict& verdict, int tries);

}  // namespace carom::bench
