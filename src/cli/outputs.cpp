#include "cli/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "cli/standard_output.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "media/threaded_sink.h"

namespace carom {

namespace {

/// Frames that may wait between drawing and encoding: the encoder has a queue of its own, more
/// would only cost memory.
constexpr int kWaitingFrames = 1;

constexpr std::array kFilmExtensions = {".mp4", ".mkv"};

struct Quality {
    int crf;
    const char* preset;
};

Quality quality_named(const std::string& name) {
    static const std::map<std::string, Quality> kQualities = {
        {"draft", {28, "ultrafast"}}, {"medium", {18, "veryfast"}}, {"high", {12, "medium"}}};
    return kQualities.at(name);
}

bool ends_as_film(const std::string& extension) {
    return std::find(kFilmExtensions.begin(), kFilmExtensions.end(), extension) !=
           kFilmExtensions.end();
}

std::string extension_of(const OutputRequest& output) {
    return output.path == "-" ? "." + output.format
                              : std::filesystem::path(output.path).extension().string();
}

void check_name(const OutputRequest& output) {
    const std::string extension = extension_of(output);
    if (ends_as_film(extension)) return;
    const bool pattern = output.path.find('%') != std::string::npos;
    if (extension == ".png" && (pattern || output.path == "-")) return;
    if (extension.empty()) return;  // a folder
    if (std::filesystem::is_directory(output.path)) return;
    const std::string right =
        extension == ".png"
            ? "frames need a number in their name, e.g. frame_%05d.png, or a folder; "
              "for one picture use `carom still`"
            : "films end in .mp4 or .mkv; frames go to a name such as "
              "frame_%05d.png or to a folder";
    throw Failure(FailureKind::kInput, fmt::format("-o {}: {}", output.path, right));
}

}  // namespace

bool OutputRequest::is_film() const { return ends_as_film(extension_of(*this)); }

void check_outputs(const std::vector<OutputRequest>& outputs,
                   const std::vector<std::int64_t>& frames, bool overwrite) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        check_name(outputs[i]);
        for (std::size_t j = 0; j < i; ++j)
            if (outputs[i].path == outputs[j].path)
                throw Failure(FailureKind::kInput,
                              fmt::format("-o {} is named twice", outputs[i].path));
    }
    for (const OutputRequest& output : outputs) {
        if (output.path == "-") continue;
        if (output.is_film()) {
            require_writable(output.path, overwrite);
            continue;
        }
        if (overwrite) continue;
        for (const std::int64_t frame : frames) {
            const std::string path = sequence_path(output.path, frame);
            if (std::filesystem::exists(path)) require_writable(path, overwrite);
        }
    }
}

void prepare_folders(const std::vector<OutputRequest>& outputs) {
    for (const OutputRequest& output : outputs)
        if (output.path != "-" && !output.is_film())
            prepare_folder(
                std::filesystem::path(sequence_path(output.path, 0)).parent_path().string());
}

void check_transparency(const std::vector<OutputRequest>& outputs, const Scene& scene) {
    if (scene.background != Background::kTransparent) return;
    for (const OutputRequest& output : outputs)
        if (output.is_film())
            throw Failure(FailureKind::kInput,
                          fmt::format("-o {}: H.264 has no transparency; with 'background: "
                                      "transparent' frames go to PNGs, such as -o frames/ or "
                                      "-o frame_%05d.png",
                                      output.path));
}

std::unique_ptr<FrameSink> open_output(const OutputRequest& output, const Scene& scene,
                                       const EncodingOptions& encoding) {
    if (!output.is_film()) {
        if (output.path == "-") return make_png_stream();
        return make_png_sequence(output.path);  // has threads of its own
    }
    const Quality quality = quality_named(encoding.quality);
    FilmOptions film;
    film.width_px = scene.film.width_px;
    film.height_px = scene.film.height_px;
    film.fps_numerator = scene.film.fps.numerator;
    film.fps_denominator = scene.film.fps.denominator;
    film.crf = encoding.crf >= 0 ? encoding.crf : quality.crf;
    film.preset = encoding.preset.empty() ? quality.preset : encoding.preset;
    film.threads = encoding.threads;
    film.title = scene.title;
    if (output.path == "-") return make_film_stream(output.format, film, kWaitingFrames);
    return make_threaded_sink(make_film_writer(output.path, film), kWaitingFrames);
}

}  // namespace carom
