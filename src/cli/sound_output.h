// The sounds among the outputs of `render`.
#pragma once

#include <string>
#include <vector>

#include "cli/outputs.h"
#include "media/output_file.h"
#include "motion/motion.h"
#include "scene/scene.h"

namespace carom {

/// Whether this `-o` asks for sound: its name ends in .wav.
bool is_sound(const std::string& output);

/// Takes the sounds out of the outputs.
std::vector<std::string> take_sounds(std::vector<std::string>& outputs);

/// Refuses names that are one, and what cannot be written. Failure(kInput), Failure(kOutput).
void check_sounds(const std::vector<std::string>& sounds, const std::vector<std::string>& outputs,
                  const std::string& scene, bool overwrite);

/// The sound under each name.
void write_sounds(const std::vector<std::string>& sounds, const SoundSamples& sound,
                  Existing existing);

/// Whether some output is a film that gets a sound track, as film.sound says.
bool has_sound_track(const Scene& scene, const std::vector<OutputRequest>& outputs);

/// Of a scene with film.sound, outputs that hold no sound: refused where `asked` for by an option,
/// Failure(kInput), else said on standard error unless `quiet`.
void check_sound_tracks(const Scene& scene, const std::vector<OutputRequest>& outputs, bool asked,
                        bool quiet);

}  // namespace carom
