// What the sound of films is coded with.
#pragma once

#include <string_view>

namespace carom {

/// Packet k of a sound begins at its sample k * packet_samples - delay: what an encoder puts before
/// the first sample is not heard.
struct SoundCodec {
    std::string_view name;   ///< in what a film says of itself
    std::string_view title;  ///< for people
    const char* encoder;     ///< FFmpeg's
    int packet_samples;
    int delay;    ///< samples
    int preroll;  ///< packets that a decoder must have read before one sounds right
    int bits_per_s;
};

/// One block overlaps the next (ISO/IEC 14496-3), and the encoder looks one ahead.
inline constexpr SoundCodec kAac = {"aac", "AAC", "aac", 1024, 1024, 1, 128'000};

/// 80 ms before a decoder is as if it had read all (RFC 7845, 4.6); 312 samples are the look-ahead
/// of the reference encoder.
inline constexpr SoundCodec kOpus = {"opus", "Opus", "libopus", 960, 312, 4, 96'000};

}  // namespace carom
