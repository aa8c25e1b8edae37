// Recordings.
#include "media/wav.h"

#include <cmath>

#include "core/failure.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(wav) {
    const std::string path = file_with(input, ".wav");
    try {
        const SoundSamples sound = read_wav(path);
        if (!(sound.rate > 0)) broken_promise("a recording without a rate");
        for (const float sample : sound.samples)
            if (!std::isfinite(sample)) broken_promise("a sample that is not finite");
    } catch (const Failure&) {
    }
}

}  // namespace carom::fuzz
