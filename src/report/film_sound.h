// The sound of a film of some of the frames.
#pragma once

#include <cstdint>

#include "media/wav.h"
#include "scene/frame_ranges.h"
#include "scene/scene.h"

namespace carom {

/// The samples of a film, and of its frames the one at which it begins.
struct FramesSound {
    SoundSamples samples;
    std::int64_t first_frame = 0;
};

/// Of frames that follow one another, `whole` with the place of the first, so that parts of a film
/// have one sound. Where some are left out, each frame's own 1/fps of sound one behind the other:
/// the film is as long as its frames, and what falls between them is not heard.
FramesSound sound_of_frames(SoundSamples whole, const Film& film, const FrameRanges& frames);

}  // namespace carom
