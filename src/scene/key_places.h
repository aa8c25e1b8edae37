// Where in a scene a key belongs, for those who write it somewhere else.
#pragma once

#include <string>
#include <string_view>

#include "scene/keys.h"

namespace carom {

/// "; did you mean 'film.fps'?" for fps, "" for a key that no section has. A place in a list or
/// under a name is shown with NAME: 'balls.NAME.radius'.
std::string place_suggestion(const KeyTable& table, std::string_view key);

/// For a key that `section` has not: the one of it that was probably meant, the place where it
/// belongs, or the keys that there are.
std::string key_suggestion(const KeyTable& table, Section section, const std::string& key);

}  // namespace carom
