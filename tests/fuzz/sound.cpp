// Recordings, and the bounces in them.
#include "core/failure.h"
#include "report/bounce_onsets.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(sound) {
    const std::string path = file_with(input, ".wav");
    try {
        const SoundSamples sound = read_wav(path);
        for (const double time : bounce_onsets(sound))
            if (!(time >= 0)) broken_promise("a bounce before the recording");
    } catch (const Failure&) {
    }
}

}  // namespace carom::fuzz
