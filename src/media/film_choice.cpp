#include "media/film_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/diagnostics.h"
#include "core/failure.h"

namespace carom {

namespace {

[[noreturn]] void refuse_choice(const std::string& text) {
    throw Failure(FailureKind::kInput, text);
}

/// ", did you mean 'x'?", or nothing.
std::string nearest(const std::string& word, std::span<const std::string_view> names) {
    const std::string found =
        nearest_word(word, std::vector<std::string>(names.begin(), names.end()));
    return found.empty() ? "" : fmt::format(", did you mean '{}'?", found);
}

const FilmCodec& choose_codec(const std::string& path, const FilmFormat& format,
                              const FilmOptions& options) {
    const auto names = format.codec_names();
    if (!options.codec.empty()) {
        if (std::find(names.begin(), names.end(), options.codec) != names.end())
            return *find_film_codec(options.codec);
        refuse_choice(fmt::format("'{}': {} is not written with the codec '{}'{}; it has {}", path,
                                  format.title, options.codec, nearest(options.codec, names),
                                  fmt::join(names, ", ")));
    }
    for (const std::string_view name : names)
        if (!options.transparent || find_film_codec(name)->has_alpha())
            return *find_film_codec(name);
    return *find_film_codec(names.front());
}

void require_alpha(const std::string& path, const FilmCodec& codec, std::string_view pixels) {
    std::vector<std::string_view> with_alpha;
    for (const FilmCodec& other : film_codecs())
        if (other.has_alpha()) with_alpha.push_back(other.name);
    refuse_choice(
        fmt::format("'{}': {} has no transparency; with 'background: transparent' films end in "
                    "{} (--codec {}), or frames go to PNGs, such as -o frames/",
                    path, pixels.empty() ? codec.title : pixels, film_extensions(true),
                    fmt::join(with_alpha, ", ")));
}

PixelFormat choose_pixels(const std::string& path, const FilmCodec& codec,
                          const FilmOptions& options) {
    const auto alpha = [](PixelFormat format) { return pixel_format_info(format).alpha; };
    if (options.pixels.empty()) {
        if (options.transparent && !codec.has_alpha()) require_alpha(path, codec, "");
        const auto found = std::find_if(codec.pixels.begin(), codec.pixels.end(), [&](auto format) {
            return alpha(format) == options.transparent;
        });
        return found == codec.pixels.end() ? codec.pixels.front() : *found;
    }
    std::vector<std::string_view> names;
    for (const PixelFormat format : codec.pixels) names.push_back(pixel_format_info(format).name);
    const PixelFormatInfo* wanted = find_pixel_format(options.pixels);
    if (wanted == nullptr ||
        std::find(codec.pixels.begin(), codec.pixels.end(), wanted->format) == codec.pixels.end())
        refuse_choice(fmt::format("'{}': {} has no pixel format '{}'{}; it has {}", path,
                                  codec.title, options.pixels, nearest(options.pixels, names),
                                  fmt::join(names, ", ")));
    if (options.transparent && !wanted->alpha) require_alpha(path, codec, wanted->name);
    return wanted->format;
}

/// Options that mean nothing to the codec.
void require_meaning(const std::string& path, const FilmCodec& codec, const FilmOptions& options) {
    const auto none = [&](const char* option, bool given) {
        if (given)
            refuse_choice(fmt::format("'{}': {} means nothing to {}", path, option, codec.title));
    };
    none("--quality", options.quality && codec.qualities.empty());
    none("--crf", options.crf && !codec.has_crf());
    none("--preset", options.preset && codec.presets.empty());
    none("--threads", options.threads > 0 && !codec.threads);
}

QualityStep quality_step(const FilmCodec& codec, const FilmOptions& options) {
    if (codec.qualities.empty()) return {0, ""};
    const auto names = quality_names();
    const std::string quality = options.quality.value_or("medium");
    const auto found = std::find(names.begin(), names.end(), quality);
    if (found == names.end())
        refuse_choice(fmt::format("unknown quality '{}'{}; there are {}", quality,
                                  nearest(quality, names), fmt::join(names, ", ")));
    return codec.qualities[static_cast<std::size_t>(found - names.begin())];
}

int choose_level(const FilmCodec& codec, const FilmOptions& options, int level) {
    if (!options.crf) return level;
    const int crf = *options.crf;
    if (crf >= codec.least_crf && crf <= codec.most_crf) return crf;
    refuse_choice(
        fmt::format("crf {} is not one of {}'s {} (best) ... {} (smallest){}", crf, codec.title,
                    codec.least_crf, codec.most_crf,
                    crf == 0 ? "; for a lossless film take .mkv with --codec ffv1, or .apng" : ""));
}

std::string choose_preset(const FilmCodec& codec, const FilmOptions& options,
                          std::string_view preset) {
    if (!options.preset) return std::string(preset);
    const auto& names = codec.presets;
    if (std::find(names.begin(), names.end(), *options.preset) != names.end())
        return *options.preset;
    refuse_choice(fmt::format("unknown preset '{}'{}; {} has {}, from fast to slow",
                              *options.preset, nearest(*options.preset, names), codec.title,
                              fmt::join(names, ", ")));
}

void require_size(const FilmChoice& choice, const FilmOptions& options) {
    const PixelFormatInfo& pixels = pixel_format_info(choice.pixels);
    const int width = options.width_px, height = options.height_px;
    if (width < 1 || height < 1)
        refuse_choice(fmt::format("a film cannot have {}x{} pixels", width, height));
    if (pixels.halved_chroma && (width % 2 != 0 || height % 2 != 0))
        refuse_choice(
            fmt::format("a film of {}x{} pixels cannot be encoded as {}: width and height must "
                        "be even",
                        width, height, pixels.name));
    constexpr int kLeastAv1 = 64;  // of SVT-AV1
    if (choice.codec->name == "av1" && (width < kLeastAv1 || height < kLeastAv1))
        refuse_choice(fmt::format("AV1 has at least {0} pixels across and down, not {1}x{2}",
                                  kLeastAv1, width, height));
    // The size fields of the formats themselves (GIF89a, 18; WebP container, VP8X less one).
    constexpr int kMostGif = 65535, kMostWebp = 16383;
    const int most = choice.codec->name == "webp" ? kMostWebp : kMostGif;
    if (width > most || height > most)
        refuse_choice(fmt::format("{} has at most {} pixels across and down, not {}x{}",
                                  choice.codec->title, most, width, height));
}

}  // namespace

FilmChoice choose_film(const std::string& path, const FilmOptions& options) {
    const FilmFormat& format = film_format(path);
    const FilmCodec& codec = choose_codec(path, format, options);
    require_meaning(path, codec, options);
    const QualityStep step = quality_step(codec, options);
    const FilmChoice choice = {&format, &codec, choose_pixels(path, codec, options),
                               choose_level(codec, options, step.level),
                               choose_preset(codec, options, step.preset)};
    require_size(choice, options);
    if (options.fps_numerator <= 0 || options.fps_denominator <= 0)
        refuse_choice(fmt::format("a film cannot have {}/{} frames a second", options.fps_numerator,
                                  options.fps_denominator));
    if (options.threads < 0)
        refuse_choice(fmt::format("the encoder cannot have {} threads", options.threads));
    require_time_stamps(format, path, options.fps_numerator, options.fps_denominator);
    return choice;
}

double film_bytes_per_pixel(const FilmChoice& choice) {
    if (choice.codec->cost.bytes_per_px > 0) return choice.codec->cost.bytes_per_px;
    const PixelFormatInfo& pixels = pixel_format_info(choice.pixels);
    const double sample_bytes = pixels.bits > 8 ? 2 : 1;
    if (!pixels.yuv) return choice.pixels == PixelFormat::kRgb ? 3 : 4;
    return sample_bytes * (1 + (pixels.halved_chroma ? 0.5 : 2) + (pixels.alpha ? 1 : 0));
}

}  // namespace carom
