#include "cli/sound_output.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "cli/distinct_files.h"
#include "media/wav.h"
#include "report/impact_sound.h"

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

void write_sounds(const std::vector<std::string>& sounds, const Scene& scene, const Motion& motion,
                  Existing existing) {
    if (sounds.empty()) return;
    const SoundSamples sound = impact_sound(scene, motion);
    for (const std::string& path : sounds) write_wav(path, sound, existing);
}

}  // namespace carom
