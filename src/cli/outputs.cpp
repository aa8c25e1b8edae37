#include "cli/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "cli/standard_output.h"
#include "core/failure.h"
#include "media/film_format.h"
#include "media/film_part.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "media/threaded_sink.h"
#include "report/provenance.h"
#include "report/scene_film.h"
#include "report/second_scene.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

/// Frames that may wait between drawing and encoding: the encoder has a queue of its own, more
/// would only cost memory.
constexpr int kWaitingFrames = 1;

/// Whose extension says the format.
std::string name_of(const OutputRequest& output) {
    return output.path == "-" ? "-." + output.format : output.path;
}

/// With its dot, in small letters.
std::string extension_of(const OutputRequest& output) {
    std::string extension = std::filesystem::path(name_of(output)).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void check_name(const OutputRequest& output) {
    const std::string extension = extension_of(output);
    if (output.is_film() || output.path == "-") return;
    // A pattern that is none is refused here, with the right spelling.
    if (output.path.find('%') != std::string::npos) {
        sequence_folder(output.path);
        return;
    }
    if (extension.empty()) return;  // a folder
    if (std::filesystem::is_directory(output.path)) return;
    const std::string right =
        extension == ".png"
            ? "frames need a number in their name, e.g. frame_%05d.png, or a folder; "
              "for one picture use `carom still`"
            : fmt::format(
                  "films end in {}; frames go to a name such as frame_%05d.png "
                  "or to a folder (which ends in / if there is a dot in its name: {}/)",
                  film_extensions(), output.path);
    throw Failure(FailureKind::kInput, fmt::format("-o {}: {}", output.path, right));
}

/// True if both would write the same file: two names of one folder, of one pattern in it, or of a
/// frame of the other.
bool are_one_output(const OutputRequest& a, const OutputRequest& b) {
    if (a.path == "-" || b.path == "-") return a.path == b.path;
    if (a.is_film() && b.is_film()) return false;  // files: require_distinct()
    if (a.is_film()) return are_one_output(b, a);
    namespace fs = std::filesystem;
    const std::string file = b.is_film() ? b.path : sequence_path(b.path, 0);
    const std::string folder = fs::path(file).parent_path().string();
    return are_one_file(sequence_folder(a.path), folder.empty() ? "." : folder) &&
           sequence_number(a.path, fs::path(file).filename().string()).has_value();
}

/// Refuses frames that exist, by what stands in the folder: it may have fewer files than the film
/// has frames.
void require_new_frames(const std::string& pattern, const FrameRanges& frames) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(sequence_folder(pattern), error)) {
        const std::string name = entry.path().filename().string();
        const std::optional<std::int64_t> frame = sequence_number(pattern, name);
        if (frame && frames.contains(*frame))
            require_writable(sequence_path(pattern, *frame), false);
    }
}

}  // namespace

bool OutputRequest::is_film() const { return find_film_format(name_of(*this)) != nullptr; }

bool OutputRequest::has_sound() const {
    const FilmFormat* kind = find_film_format(name_of(*this));
    return kind != nullptr && kind->sound != nullptr;
}

void check_output_names(const std::vector<OutputRequest>& outputs,
                        const std::vector<NamedFile>& other_outputs,
                        const std::vector<NamedFile>& inputs) {
    std::vector<NamedFile> files = other_outputs;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        check_name(outputs[i]);
        if (outputs[i].is_film() || outputs[i].path == "-")
            files.push_back({"-o", outputs[i].path});
        for (std::size_t j = 0; j < i; ++j)
            if (are_one_output(outputs[i], outputs[j]))
                throw Failure(FailureKind::kInput,
                              fmt::format("-o {} and -o {} would write the same files",
                                          outputs[j].path, outputs[i].path));
    }
    require_distinct(files, inputs);
}

void check_outputs(const std::vector<OutputRequest>& outputs, const FrameRanges& frames,
                   bool overwrite) {
    for (const OutputRequest& output : outputs) {
        if (output.path == "-") continue;
        if (output.is_film())
            require_writable(output.path, overwrite);
        else if (!overwrite)
            require_new_frames(output.path, frames);
    }
}

void prepare_folders(const std::vector<OutputRequest>& outputs) {
    for (const OutputRequest& output : outputs)
        if (output.path != "-" && !output.is_film())
            prepare_folder(
                std::filesystem::path(sequence_path(output.path, 0)).parent_path().string());
}

namespace {

FilmOptions film_options(const Scene& scene, const EncodingOptions& encoding) {
    FilmOptions film = film_options_of(scene);
    film.codec = encoding.codec.value_or("");
    film.pixels = encoding.pixels.value_or("");
    film.quality = encoding.quality;
    film.crf = encoding.crf;
    film.preset = encoding.preset;
    film.threads = encoding.threads;
    film.existing = encoding.existing;
    film.sound.wanted = scene.film.sound;
    return film;
}

/// PNGs have pixels as they are drawn, and nothing to choose.
void require_some_film(const std::vector<OutputRequest>& outputs, const EncodingOptions& encoding) {
    if (std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return o.is_film(); }))
        return;
    const std::pair<const char*, bool> given[] = {{"--codec", encoding.codec.has_value()},
                                                  {"--pix-fmt", encoding.pixels.has_value()},
                                                  {"--quality", encoding.quality.has_value()},
                                                  {"--crf", encoding.crf.has_value()},
                                                  {"--preset", encoding.preset.has_value()}};
    for (const auto& [option, is_given] : given)
        if (is_given)
            throw Failure(
                FailureKind::kInput,
                fmt::format("{} means nothing to PNG frames, and no output is a film", option));
}

void require_some_png(const std::vector<OutputRequest>& outputs, const EncodingOptions& encoding) {
    if (!encoding.dpi) return;
    if (std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return !o.is_film(); }))
        return;
    throw Failure(FailureKind::kInput, "--dpi is for PNG frames, and all outputs are films");
}

}  // namespace

void check_films(const std::vector<OutputRequest>& outputs, const Scene& scene,
                 const EncodingOptions& encoding) {
    require_some_film(outputs, encoding);
    require_some_png(outputs, encoding);
    for (const OutputRequest& output : outputs)
        if (output.is_film()) require_film(name_of(output), film_options(scene, encoding));
}

FilmChoice chosen_film(const OutputRequest& output, const Scene& scene,
                       const EncodingOptions& encoding) {
    return choose_film(name_of(output), film_options(scene, encoding));
}

namespace {

/// "" where there is no second run.
std::string against_of(const FilmSource& source) {
    if (source.second == nullptr) return "";
    return second_text(*source.second, source.view);
}

}  // namespace

std::string origin_text(const FilmSource& source, const FilmChoice& choice) {
    const std::string origin = made_from(source.scene);
    const FrameRanges& frames = source.frames;
    if (frames.empty() || frames.size() == source.count) return origin;
    if (frames.size() != frames.back() - frames.front() + 1)
        return fmt::format("{}, {} frames of {}", origin, frames.size(), source.count);
    const FrameRate& fps = source.scene.film.fps;
    FilmPart part{
        origin, frames.front(), frames.back(), source.count, fps.numerator, fps.denominator, ""};
    part.settings = fmt::format("{} {} {} {}", choice.codec->name, choice.level, choice.preset,
                                pixel_format_info(choice.pixels).name);
    if (source.scene.film.sound && choice.format->sound != nullptr)
        part.settings += fmt::format(", sound {}", choice.format->sound->name);
    if (source.second != nullptr) part.settings += ", against " + against_of(source);
    return part.text();
}

PngNotes png_notes(const Scene& scene, double time_s, const std::optional<double>& dpi) {
    constexpr double kInch_m = 0.0254;
    PngNotes notes = picture_notes(scene, time_s);
    if (dpi) notes.pixels_per_m = *dpi / kInch_m;
    return notes;
}

PngNotes frame_notes(const FilmSource& source, std::int64_t frame,
                     const std::optional<double>& dpi) {
    PngNotes notes = png_notes(source.scene, frame_time(source.scene.film, frame), dpi);
    if (source.second != nullptr) notes.texts.emplace_back("Against", against_of(source));
    return notes;
}

std::unique_ptr<FrameSink> open_output(const OutputRequest& output, const FilmSource& source,
                                       const EncodingOptions& encoding) {
    if (!output.is_film()) {
        const FrameNotes notes = [source, dpi = encoding.dpi](std::int64_t number) {
            return frame_notes(source, number, dpi);
        };
        if (output.path == "-") return make_png_stream(notes);
        // It has threads of its own.
        return make_png_sequence(output.path, encoding.threads, encoding.existing, notes);
    }
    FilmOptions film = film_options(source.scene, encoding);
    film.comment = origin_text(source, choose_film(name_of(output), film));
    if (source.sound != nullptr)
        film.sound = {true, &source.sound->samples, source.sound->first_frame};
    if (output.path == "-") return make_film_stream(output.format, film, kWaitingFrames);
    return make_threaded_sink(make_film_writer(output.path, film), kWaitingFrames);
}

}  // namespace carom
