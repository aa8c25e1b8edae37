#include "media/film_join.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "core/failure.h"
#include "media/film_format.h"
#include "media/film_input.h"
#include "media/film_muxer.h"
#include "media/film_part.h"
#include "media/sound_join.h"
#include "media/sound_track.h"

namespace carom {

namespace {

[[noreturn]] void refuse_to_join(const std::string& text) {
    throw Failure(FailureKind::kInput, text);
}

/// A part, as its file describes it.
struct Part {
    std::string path;
    FilmPart said;
    std::string title;
    ParametersPtr parameters;
    bool alpha_beside = false;
    const SoundCodec* sound_codec = nullptr;  ///< null: it is silent
    ParametersPtr sound{};
};

/// Containers of one family, whose time stamps and codec headers are of one kind: FFmpeg names its
/// readers "mov,mp4,..." and "matroska,webm".
const char* family_of(const FilmFormat& format) {
    return format.times == FilmTimes::kExact ? "mov" : "matroska";
}

bool can_join(const FilmFormat& format) {
    return format.container != nullptr &&
           (format.times == FilmTimes::kExact || format.times == FilmTimes::kMilliseconds);
}

void require_container(const FilmInput& input, const FilmFormat& format,
                       const std::string& output) {
    const char* family = family_of(format);
    if (std::strncmp(input.context().iformat->name, family, std::strlen(family)) == 0) return;
    refuse_to_join(
        fmt::format("'{}' is {}, which cannot be put into '{}' as it is: parts are joined into "
                    "the container that they have",
                    input.path(), input.context().iformat->long_name, output));
}

FilmPart part_of(const FilmInput& input) {
    const std::string comment = input.text("comment");
    if (const auto part = read_film_part(comment)) return *part;
    if (comment.starts_with("carom "))
        refuse_to_join(
            fmt::format("'{}' is no part of a film that can be joined: it says '{}'; parts are "
                        "made with --chunk I/N, or with --frames A-B",
                        input.path(), comment));
    refuse_to_join(
        fmt::format("'{}' does not say which frames of which film it holds: parts are made by "
                    "`carom render` with --chunk I/N, or with --frames A-B",
                    input.path()));
}

/// Takes up what the part says of its sound.
void describe_sound(Part& part, const FilmInput& input, const LibavMessages& messages) {
    part.sound_codec = sound_codec_of(part.path, part.said);
    if (part.sound_codec == nullptr) return;
    if (input.sound() == nullptr)
        refuse_to_join(
            fmt::format("'{}' is not what it says it is: its sound is missing", part.path));
    part.sound.reset(allocated(libav().avcodec_parameters_alloc()));
    input.check(libav().avcodec_parameters_copy(part.sound.get(), input.sound()->codecpar),
                messages);
    part.sound->frame_size = part.sound_codec->packet_samples;
    set_skip(*part.sound, part.sound_codec->delay);
}

Part describe(const std::string& path, const FilmFormat& format, const std::string& output) {
    const FilmInput input(path);
    require_container(input, format, output);
    Part part{path, part_of(input), input.text("title"), nullptr,
              !input.stream_text("alpha_mode").empty()};
    const std::string codec = part.said.settings.substr(0, part.said.settings.find(' '));
    const auto codecs = format.codec_names();
    if (std::find(codecs.begin(), codecs.end(), codec) == codecs.end())
        refuse_to_join(
            fmt::format("'{}' is coded as {}, which {} does not hold", path, codec, format.title));
    const LibavMessages messages;
    part.parameters.reset(allocated(libav().avcodec_parameters_alloc()));
    input.check(libav().avcodec_parameters_copy(part.parameters.get(), input.stream().codecpar),
                messages);
    // QuickTime's reader keeps it with the stream alone.
    part.parameters->sample_aspect_ratio = {1, 1};
    // Matroska has names of its own for codecs.
    if (format.times != FilmTimes::kExact) part.parameters->codec_tag = 0;
    describe_sound(part, input, messages);
    return part;
}

bool have_one_header(const AVCodecParameters& a, const AVCodecParameters& b) {
    const auto size = static_cast<std::size_t>(a.extradata_size);
    return a.codec_id == b.codec_id && a.format == b.format &&
           a.extradata_size == b.extradata_size &&
           (size == 0 || std::memcmp(a.extradata, b.extradata, size) == 0);
}

/// Refuses a part that is not of the same film as the first one.
void require_alike(const Part& a, const Part& b) {
    const auto differ = [&](const std::string& what, const auto& of_a, const auto& of_b) {
        refuse_to_join(
            fmt::format("'{}' and '{}' {}: {} and {}", a.path, b.path, what, of_a, of_b));
    };
    const AVCodecParameters &pa = *a.parameters, &pb = *b.parameters;
    if (pa.width != pb.width || pa.height != pb.height)
        differ("have other sizes", fmt::format("{}x{}", pa.width, pa.height),
               fmt::format("{}x{}", pb.width, pb.height));
    const auto version = [](const Part& part) {
        return part.said.origin.substr(0, part.said.origin.find(", "));
    };
    if (version(a) != version(b))
        differ("are of different versions of carom", version(a), version(b));
    if (a.said.origin != b.said.origin)
        differ("are films of different scenes", a.said.origin, b.said.origin);
    if (a.said.settings != b.said.settings)
        differ("are encoded with different settings", a.said.settings, b.said.settings);
    const auto rate = [](const FilmPart& part) {
        return fmt::format("{}/{}", part.fps_numerator, part.fps_denominator);
    };
    if (rate(a.said) != rate(b.said)) differ("have other frame rates", rate(a.said), rate(b.said));
    if (a.said.count != b.said.count)
        differ("are parts of films of other lengths", fmt::format("{} frames", a.said.count),
               fmt::format("{} frames", b.said.count));
    const bool one_sound = !a.sound || have_one_header(*a.sound, *b.sound);
    if (!have_one_header(pa, pb) || a.alpha_beside != b.alpha_beside || !one_sound)
        refuse_to_join(fmt::format(
            "'{}' and '{}' come from different encoders: their headers differ", a.path, b.path));
}

/// Refuses frames that no part holds, or two; `parts` are in order.
void require_every_frame_once(const std::vector<Part>& parts) {
    std::int64_t next = 0;
    const auto missing = [&](std::int64_t end) {
        refuse_to_join(fmt::format("frames {} to {} of the film's {} are in none of the parts",
                                   next, end - 1, parts.front().said.count));
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const FilmPart& part = parts[i].said;
        if (part.first > next) missing(part.first);
        if (part.first < next)
            refuse_to_join(
                fmt::format("'{}' (frames {} to {}) and '{}' (frames {} to {}) hold the same "
                            "frames",
                            parts[i - 1].path, parts[i - 1].said.first, parts[i - 1].said.last,
                            parts[i].path, part.first, part.last));
        next = part.last + 1;
    }
    if (next < parts.front().said.count) missing(parts.front().said.count);
}

/// A part's packets, in the order of decoding, with the places of their frames.
class PartReader {
  public:
    static constexpr std::int64_t kSound = std::numeric_limits<std::int64_t>::min();

    explicit PartReader(const Part& part)
        : input_(part.path),
          has_sound_(part.sound != nullptr),
          frame_s_{part.said.fps_denominator, part.said.fps_numerator} {}

    /// False at the end. `frame` is counted from the part's first; of a packet of sound negative.
    bool read(AVPacket& packet, std::int64_t& frame) {
        frame = kSound;
        if (!input_.read(packet, has_sound_)) return false;
        if (input_.is_sound(packet)) return true;
        if (packet.pts == AV_NOPTS_VALUE)
            refuse_to_join(fmt::format("'{}' has a frame without a time", input_.path()));
        // The first to be decoded is the first to be seen: nothing stands before it.
        if (!begun_) first_pts_ = packet.pts;
        begun_ = true;
        frame = libav().av_rescale_q(packet.pts - first_pts_, input_.stream().time_base, frame_s_);
        return true;
    }

  private:
    FilmInput input_;
    bool has_sound_;
    AVRational frame_s_;
    bool begun_ = false;
    std::int64_t first_pts_ = 0;
};

std::optional<SoundJoin> sound_join(const Part& part) {
    if (part.sound_codec == nullptr) return std::nullopt;
    return std::make_optional<SoundJoin>(*part.sound_codec);
}

/// Reads a part from end to end: refuses it unless it begins with a keyframe and holds each of its
/// frames once. Returns by how many places at most a packet is decoded later than its frame is
/// seen.
std::int64_t examined_delay(const Part& part, const JoinHooks& hooks) {
    const PacketPtr packet(allocated(libav().av_packet_alloc()));
    PartReader reader(part);
    std::vector<bool> seen(static_cast<std::size_t>(part.said.frames()));
    std::optional<SoundJoin> sound = sound_join(part);
    if (sound) sound->begin(part.said);
    std::int64_t packets = 0, delay = 0, frame = 0;
    const auto damaged = [&](const std::string& why) {
        refuse_to_join(fmt::format("'{}' is not what it says it is, frames {} to {}: {}", part.path,
                                   part.said.first, part.said.last, why));
    };
    while (reader.read(*packet, frame)) {
        if (hooks.check) hooks.check();
        if (frame == PartReader::kSound) {
            sound->take(*packet, nullptr);
            libav().av_packet_unref(packet.get());
            continue;
        }
        const bool is_keyframe = (packet->flags & AV_PKT_FLAG_KEY) != 0;
        libav().av_packet_unref(packet.get());
        if (packets == 0 && !is_keyframe) damaged("it does not begin with a keyframe");
        if (frame < 0 || frame >= part.said.frames())
            damaged(fmt::format("it has a frame {}", part.said.first + frame));
        if (seen[static_cast<std::size_t>(frame)])
            damaged(fmt::format("frame {} is there twice", part.said.first + frame));
        seen[static_cast<std::size_t>(frame)] = true;
        delay = std::max(delay, packets - frame);
        ++packets;
    }
    if (packets < part.said.frames())
        damaged(fmt::format("it holds {} of these {} frames", packets, part.said.frames()));
    if (sound) sound->end(part.path);
    return delay;
}

FilmStream stream_of(const Part& part) {
    FilmStream stream;
    stream.parameters.reset(allocated(libav().avcodec_parameters_alloc()));
    if (libav().avcodec_parameters_copy(stream.parameters.get(), part.parameters.get()) < 0)
        throw std::bad_alloc();
    stream.time_base = {part.said.fps_denominator, part.said.fps_numerator};
    stream.alpha_beside = part.alpha_beside;
    if (!part.sound) return stream;
    stream.sound.reset(allocated(libav().avcodec_parameters_alloc()));
    if (libav().avcodec_parameters_copy(stream.sound.get(), part.sound.get()) < 0)
        throw std::bad_alloc();
    return stream;
}

/// Copies the packets of all parts. Frame k is seen at k; packet j is decoded at j - `delay`, which
/// is never later and is what an encoder says of a film without parts.
void copy_packets(const std::vector<Part>& parts, std::int64_t delay, FilmMuxer& muxer,
                  const JoinHooks& hooks) {
    const PacketPtr packet(allocated(libav().av_packet_alloc()));
    std::optional<SoundJoin> sound = sound_join(parts.front());
    std::int64_t packets = 0, frame = 0;
    for (const Part& part : parts) {
        PartReader reader(part);
        if (sound) sound->begin(part.said);
        while (reader.read(*packet, frame)) {
            if (hooks.check) hooks.check();
            if (frame == PartReader::kSound) {
                sound->take(*packet, &muxer);
                libav().av_packet_unref(packet.get());
                continue;
            }
            packet->pts = part.said.first + frame;
            packet->dts = packets++ - delay;
            packet->duration = 1;
            packet->pos = -1;
            muxer.write(*packet);
            libav().av_packet_unref(packet.get());
            if (hooks.joined) hooks.joined(packets, part.said.count);
        }
    }
}

}  // namespace

void require_joinable(const std::string& output) {
    const FilmFormat& format = film_format(output);
    if (can_join(format)) return;
    std::string names;
    for (const FilmFormat& other : film_formats())
        if (can_join(other))
            names += fmt::format("{}.{}", names.empty() ? "" : ", ", other.extension);
    refuse_to_join(
        fmt::format("'{}': parts of {} cannot be joined without encoding them again; films in "
                    "{} can, and PNG frames need no joining",
                    output, format.title, names));
}

std::int64_t join_films(const std::vector<std::string>& paths, const std::string& output,
                        Existing existing, const JoinHooks& hooks) {
    require_joinable(output);
    const FilmFormat& format = film_format(output);
    std::vector<Part> parts;
    for (const std::string& path : paths) {
        if (hooks.check) hooks.check();
        parts.push_back(describe(path, format, output));
        require_alike(parts.front(), parts.back());
    }
    if (parts.empty()) refuse_to_join("no films to join");
    std::sort(parts.begin(), parts.end(),
              [](const Part& a, const Part& b) { return a.said.first < b.said.first; });
    require_every_frame_once(parts);
    std::int64_t delay = 0;
    for (const Part& part : parts) delay = std::max(delay, examined_delay(part, hooks));

    OutputFile file(output, existing);
    FilmMuxer muxer(libav_url(file.temporary_path()), output, format, stream_of(parts.front()),
                    parts.front().title, parts.front().said.origin);
    copy_packets(parts, delay, muxer, hooks);
    muxer.close();
    file.commit();
    return parts.front().said.count;
}

}  // namespace carom
