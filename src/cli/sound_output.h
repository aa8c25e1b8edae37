// The sounds among the outputs of `render`.
#pragma once

#include <string>
#include <vector>

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

/// impact_sound() under each name.
void write_sounds(const std::vector<std::string>& sounds, const Scene& scene, const Motion& motion,
                  Existing existing);

}  // namespace carom
