#include "cli/sound_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "cli/distinct_files.h"
#include "cli/standard_error.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/film_format.h"
#include "media/wav.h"

namespace carom {

bool is_sound(const std::string& output) {
    std::string extension = std::filesystem::path(output).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".wav" && !std::filesystem::is_directory(output);
}

std::vector<std::string> take_sounds(std::vector<std::string>& outputs) {
    std::vector<std::string> sounds, others;
    for (const std::string& output : outputs)
        (is_sound(output) ? sounds : others).push_back(output);
    outputs = others;
    return sounds;
}

void check_sounds(const std::vector<std::string>& sounds, const std::vector<std::string>& outputs,
                  const std::string& scene, bool overwrite) {
    std::vector<NamedFile> files;
    for (const std::string& sound : sounds) files.push_back({"-o", sound});
    for (const std::string& output : outputs) files.push_back({"-o", output});
    require_distinct(files, {{"SCENE", scene}});
    for (const std::string& sound : sounds) require_writable(sound, overwrite);
}

void write_sounds(const std::vector<std::string>& sounds, const SoundSamples& sound,
                  Existing existing) {
    for (const std::string& path : sounds) write_wav(path, sound, existing);
}

bool has_sound_track(const Scene& scene, const std::vector<OutputRequest>& outputs) {
    return scene.film.sound &&
           std::any_of(outputs.begin(), outputs.end(),
                       [](const OutputRequest& output) { return output.has_sound(); });
}

void check_sound_tracks(const Scene& scene, const std::vector<OutputRequest>& outputs, bool asked,
                        bool quiet) {
    if (!scene.film.sound) return;
    for (const OutputRequest& output : outputs) {
        if (output.has_sound()) continue;
        const std::string what = output.path == "-" ? "--format " + output.format : output.path;
        if (asked)
            throw Failure(FailureKind::kInput,
                          fmt::format("--sound: '{}' holds no sound; films in {} do, and -o "
                                      "sound.wav goes beside any",
                                      what, sound_film_extensions()));
        if (!quiet)
            say("carom: '{}' holds no sound: film.sound is left out of it\n", readable(what));
    }
}

}  // namespace carom
