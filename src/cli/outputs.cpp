#include "cli/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "cli/standard_output.h"
#include "core/failure.h"
#include "media/film_format.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "media/threaded_sink.h"

namespace carom {

namespace {

/// Frames that may wait between drawing and encoding: the encoder has a queue of its own, more
/// would only cost memory.
constexpr int kWaitingFrames = 1;

struct Quality {
    int crf;
    const char* preset;
};

Quality quality_named(const std::string& name) {
    static const std::map<std::string, Quality> kQualities = {
        {"draft", {28, "ultrafast"}}, {"medium", {18, "veryfast"}}, {"high", {12, "medium"}}};
    return kQualities.at(name);
}

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

void check_transparency(const std::vector<OutputRequest>& outputs, const Scene& scene) {
    if (scene.background != Background::kTransparent) return;
    for (const OutputRequest& output : outputs)
        if (output.is_film() && !film_format(name_of(output)).alpha)
            throw Failure(FailureKind::kInput,
                          fmt::format("-o {}: H.264 has no transparency; with 'background: "
                                      "transparent' frames go to PNGs, such as -o frames/ or "
                                      "-o frame_%05d.png",
                                      output.path));
}

namespace {

FilmOptions film_options(const Scene& scene, const EncodingOptions& encoding) {
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
    film.existing = encoding.existing;
    return film;
}

}  // namespace

void check_films(const std::vector<OutputRequest>& outputs, const Scene& scene,
                 const EncodingOptions& encoding) {
    for (const OutputRequest& output : outputs)
        if (output.is_film()) require_film(name_of(output), film_options(scene, encoding));
}

std::unique_ptr<FrameSink> open_output(const OutputRequest& output, const Scene& scene,
                                       const EncodingOptions& encoding) {
    if (!output.is_film()) {
        if (output.path == "-") return make_png_stream();
        return make_png_sequence(output.path, 0, encoding.existing);  // has threads of its own
    }
    const FilmOptions film = film_options(scene, encoding);
    if (output.path == "-") return make_film_stream(output.format, film, kWaitingFrames);
    return make_threaded_sink(make_film_writer(output.path, film), kWaitingFrames);
}

}  // namespace carom
