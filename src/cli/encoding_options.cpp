#include "cli/encoding_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "media/film_format.h"

namespace carom {

namespace {

std::vector<std::string> codec_names() {
    std::vector<std::string> names;
    for (const FilmCodec& codec : film_codecs()) names.emplace_back(codec.name);
    return names;
}

/// ".mp4 h264, h265 or av1; .mkv ...": of the containers that leave a choice.
std::string choices_of_codec() {
    std::vector<std::string> parts;
    for (const FilmFormat& format : film_formats()) {
        const auto names = format.codec_names();
        if (names.size() > 1)
            parts.push_back(fmt::format(".{} {}", format.extension, fmt::join(names, ", ")));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

/// "H.264 draft 28 ultrafast, medium ...; ...": of the codecs that have such steps and a crf.
std::string steps_of_quality() {
    std::vector<std::string> parts;
    for (const FilmCodec& codec : film_codecs()) {
        if (!codec.has_crf()) continue;
        std::vector<std::string> steps;
        for (std::size_t i = 0; i < codec.qualities.size(); ++i)
            steps.push_back(fmt::format("{} {} {}", quality_names()[i], codec.qualities[i].level,
                                        codec.qualities[i].preset));
        parts.push_back(fmt::format("{} {}", codec.title, fmt::join(steps, ", ")));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

/// "H.264 1-51, ...".
std::string ranges_of_crf() {
    std::vector<std::string> parts;
    for (const FilmCodec& codec : film_codecs())
        if (codec.has_crf())
            parts.push_back(fmt::format("{} {}-{}", codec.title, codec.least_crf, codec.most_crf));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::string> pixel_names() {
    std::vector<std::string> names;
    for (const FilmCodec& codec : film_codecs())
        for (const PixelFormat format : codec.pixels) {
            std::string name(pixel_format_info(format).name);
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(std::move(name));
        }
    return names;
}

}  // namespace

void add_encoding_options(CLI::App& command, EncodingOptions& options) {
    command
        .add_option("--codec", options.codec,
                    fmt::format("How a film is coded: {} (default: the first, with a transparent "
                                "background the first that keeps it)",
                                choices_of_codec()))
        ->check(CLI::IsMember(codec_names()))
        ->type_name("NAME");
    command
        .add_option("--pix-fmt", options.pixels,
                    "A film's pixels, by FFmpeg's names, e.g. yuv444p, yuv420p10le (default: the "
                    "codec's)")
        ->check(CLI::IsMember(pixel_names()))
        ->type_name("NAME");
    command
        .add_option("--quality", options.quality,
                    fmt::format("Sets both of the next two: {}; of ProRes the quantiser, of APNG "
                                "and WebP how hard they compress (default: medium)",
                                steps_of_quality()))
        ->check(
            CLI::IsMember(std::vector<std::string>(quality_names().begin(), quality_names().end())))
        ->type_name(fmt::format("{}", fmt::join(quality_names(), "|")));
    command
        .add_option("--crf", options.crf,
                    fmt::format("Constant rate factor, from best to smallest: {} (default: as "
                                "--quality says)",
                                ranges_of_crf()))
        ->type_name("N");
    command
        .add_option("--preset", options.preset,
                    "The encoder's effort, e.g. medium of H.264, or a number of AV1 and VP9, of "
                    "which lower ones are slower (default: as --quality says)")
        ->type_name("NAME");
    command
        .add_option("--threads", options.threads,
                    "Threads of the encoder, 1 to 128 (default: one per processor)")
        ->check(CLI::Range(1, 128))
        ->type_name("N");
    add_dpi_option(command, options.dpi);
}

void add_dpi_option(CLI::App& command, std::optional<double>& dpi) {
    constexpr double kMost = 100'000;
    command
        .add_option("--dpi", dpi,
                    "Pixels per inch that a PNG says it has on paper (default: it says none)")
        ->check(CLI::Range(1.0, kMost))
        ->type_name("N");
}

std::vector<std::string> stream_formats() {
    std::vector<std::string> names;
    for (const FilmFormat& format : film_formats()) names.emplace_back(format.extension);
    names.emplace_back("png");
    return names;
}

}  // namespace carom
