// The bounces in a recording.
#pragma once

#include <vector>

#include "media/wav.h"

namespace carom {

/// The instants [s] of a bouncing series in a recording, the longest that it holds: sudden rises of
/// the level whose distances shrink steadily, so that a voice before it and echoes after each
/// bounce drop out. An instant is found to a fraction of a sample, by how well a bounce's sound
/// fits over that of the first. Failure(kInput) where there are fewer than three.
std::vector<double> bounce_onsets(const SoundSamples& sound);

}  // namespace carom
