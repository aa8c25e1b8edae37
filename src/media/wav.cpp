#include "media/wav.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include "core/failure.h"
#include "core/readable.h"
#include "media/text_file.h"

namespace carom {

namespace {

constexpr std::size_t kHeader = 44;
constexpr std::uint16_t kWholeNumbers = 1, kFloats = 3, kExtensible = 0xFFFE;
constexpr std::size_t kMostBytes = std::size_t{1} << 30;  ///< that are read: three hours

void append_bytes(std::string& text, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// Little-endian numbers of a file in memory.
class Bytes {
  public:
    explicit Bytes(std::string_view data) : data_(data) {}

    bool has(std::size_t at, std::size_t count) const {
        return at <= data_.size() && count <= data_.size() - at;
    }
    std::string_view text(std::size_t at, std::size_t count) const {
        return has(at, count) ? data_.substr(at, count) : std::string_view{};
    }
    std::uint32_t number(std::size_t at, std::size_t bytes) const {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < bytes && at + i < data_.size(); ++i)
            value |= static_cast<std::uint32_t>(static_cast<unsigned char>(data_[at + i]))
                     << (8 * i);
        return value;
    }
    std::size_t size() const { return data_.size(); }

  private:
    std::string_view data_;
};

struct Format {
    std::uint32_t code = 0, channels = 0, rate = 0, bits = 0;
};

/// One sample of one channel, -1 ... 1.
float sample_at(const Bytes& bytes, std::size_t at, const Format& format) {
    const std::uint32_t raw = bytes.number(at, format.bits / 8);
    if (format.code == kFloats) {
        const float value = std::bit_cast<float>(raw);
        return std::isfinite(value) ? value : 0;
    }
    if (format.bits == 8) return (static_cast<float>(raw) - 128) / 128;
    const auto up = static_cast<std::int32_t>(raw << (32 - format.bits));  // keeps the sign
    return static_cast<float>(up) / 2147483648.0F;
}

std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        throw Failure(FailureKind::kInput,
                      fmt::format("{}: {}", readable(path), std::strerror(errno)));
    const auto size = static_cast<std::size_t>(std::max<std::streamoff>(file.tellg(), 0));
    if (size > kMostBytes)
        throw Failure(FailureKind::kInput, fmt::format("{}: {} bytes; a recording may have {}",
                                                       readable(path), size, kMostBytes));
    std::string data(size, '\0');
    file.seekg(0);
    file.read(data.data(), static_cast<std::streamsize>(size));
    data.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    return data;
}

[[noreturn]] void refuse_wav(const std::string& path, const std::string& what) {
    throw Failure(FailureKind::kInput, fmt::format("{}: {}", readable(path), what));
}

void require_known(const std::string& path, const Format& format) {
    const bool whole = format.code == kWholeNumbers && (format.bits == 8 || format.bits == 16 ||
                                                        format.bits == 24 || format.bits == 32);
    const bool floats = format.code == kFloats && format.bits == 32;
    if (!whole && !floats)
        refuse_wav(path,
                   fmt::format("a WAV file of format {} with {} bits; whole numbers of 8, 16, 24 "
                               "or 32 bits and floats of 32 are read",
                               format.code, format.bits));
    if (format.channels == 0 || format.channels > 64 || format.rate < 1000 ||
        format.rate > 1'000'000)
        refuse_wav(path, fmt::format("{} channels at {} samples a second: no sound has that",
                                     format.channels, format.rate));
}

}  // namespace

void write_wav(const std::string& path, const SoundSamples& sound, Existing existing) {
    const std::size_t bytes = 2 * sound.samples.size();
    if (bytes > std::numeric_limits<std::uint32_t>::max() - kHeader)
        throw Failure(
            FailureKind::kOutput,
            fmt::format("{}: {:.0f} s of sound are more than a WAV file holds", readable(path),
                        static_cast<double>(sound.samples.size()) / sound.rate));
    const auto rate = static_cast<std::uint32_t>(std::lround(sound.rate));
    std::string text = "RIFF";
    append_bytes(text, static_cast<std::uint32_t>(bytes + kHeader - 8), 4);
    text += "WAVEfmt ";
    append_bytes(text, 16, 4);
    append_bytes(text, kWholeNumbers, 2);
    append_bytes(text, 1, 2);
    append_bytes(text, rate, 4);
    append_bytes(text, 2 * rate, 4);
    append_bytes(text, 2, 2);
    append_bytes(text, 16, 2);
    text += "data";
    append_bytes(text, static_cast<std::uint32_t>(bytes), 4);
    TextFile file(path, existing);
    for (const float sample : sound.samples) {
        const long level = std::clamp(std::lround(32768 * sample), -32768L, 32767L);
        append_bytes(text, static_cast<std::uint16_t>(level), 2);
        if (text.size() < (std::size_t{1} << 16)) continue;
        file.write(text);
        text.clear();
    }
    file.write(text);
    file.commit();
}

SoundSamples read_wav(const std::string& path) {
    const std::string data = contents(path);
    const Bytes bytes(data);
    if (bytes.text(0, 4) != "RIFF" || bytes.text(8, 4) != "WAVE")
        refuse_wav(path,
                   "this is no WAV file; `ffmpeg -i FILE sound.wav` makes one of other sound");
    Format format;
    for (std::size_t at = 12; bytes.has(at, 8);) {
        const std::string_view name = bytes.text(at, 4);
        const std::size_t size = bytes.number(at + 4, 4), body = at + 8;
        if (name == "fmt " && bytes.has(body, 16)) {
            format = {bytes.number(body, 2), bytes.number(body + 2, 2), bytes.number(body + 4, 4),
                      bytes.number(body + 14, 2)};
            if (format.code == kExtensible && size >= 26) format.code = bytes.number(body + 24, 2);
            require_known(path, format);
        } else if (name == "data") {
            if (format.rate == 0)
                refuse_wav(path, "a WAV file whose samples come before their format");
            // A recording that was cut off has fewer than it says.
            const std::size_t there = std::min(size, bytes.size() - body);
            const std::size_t width = format.bits / 8, frame = width * format.channels;
            SoundSamples sound{static_cast<double>(format.rate), {}};
            sound.samples.reserve(there / frame);
            for (std::size_t i = body; i + frame <= body + there; i += frame) {
                float sum = 0;
                for (std::size_t c = 0; c < format.channels; ++c)
                    sum += sample_at(bytes, i + c * width, format);
                sound.samples.push_back(sum / static_cast<float>(format.channels));
            }
            return sound;
        }
        at = body + size + size % 2;
    }
    refuse_wav(path, "a WAV file without samples");
}

}  // namespace carom
