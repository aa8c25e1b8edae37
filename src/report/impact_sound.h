// What a motion sounds like: a click at each impact.
#pragma once

#include "media/wav.h"
#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// One channel at 48 kHz, as long as the film. Each impact begins at its exact instant on the
/// film's clock: a cosine that decays, of the first sample at or after it. Its level goes with the
/// impulse; its pitch [64 m/s over the radius of the smaller ball, 120 Hz to 9 kHz] and its length
/// (8 periods to 1/e) with the ball. The loudest instant of all is at 0.8. Impacts below 1e-4 of
/// the largest impulse are not heard.
SoundSamples impact_sound(const Scene& scene, const Motion& motion);

}  // namespace carom
