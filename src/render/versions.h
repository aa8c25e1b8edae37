// Versions of the libraries that this folder names.
#pragma once

#include <map>
#include <string>

namespace carom {

std::map<std::string, std::string> render_versions();

/// Of the font inside the program, by its own name table.
std::string font_name();

}  // namespace carom
