// Sound as samples, in WAV files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "media/output_file.h"

namespace carom {

struct SoundSamples {
    double rate = 48'000;        ///< samples a second
    std::vector<float> samples;  ///< one channel, -1 ... 1
};

/// Writes 16-bit samples; louder ones are cut off. Failure(kOutput) as OutputFile has it, and for
/// more than a WAV file can hold (4 GiB).
void write_wav(const std::string& path, const SoundSamples& sound, Existing existing);

/// Reads whole numbers of 8, 16, 24 or 32 bits, or floats of 32; of several channels the mean.
/// Failure(kInput) with what is wrong for anything else.
SoundSamples read_wav(const std::string& path);

}  // namespace carom
