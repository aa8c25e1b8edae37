// Samples into packets, through one of FFmpeg's encoders. Only .cpp files of this folder include
// it.
#pragma once

#include <string>
#include <vector>

#include "media/libav.h"
#include "media/sound_codec.h"
#include "media/wav.h"

namespace carom {

/// A whole sound; its packets are numbered as SoundCodec has it. The same samples give the same
/// packets.
struct EncodedSound {
    ParametersPtr parameters;
    std::vector<PacketPtr> packets;
};

/// The codec's encoder; Failure(kRun) that names it where this FFmpeg lacks it.
const AVCodec& find_encoder(const std::string& path, const SoundCodec& codec);

/// `path` is for messages. Throws Failure(kRun).
EncodedSound encode_sound(const std::string& path, const SoundCodec& codec,
                          const SoundSamples& sound);

}  // namespace carom
