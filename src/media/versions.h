// Versions of the libraries that this folder names.
#pragma once

#include <map>
#include <string>

namespace carom {

/// Of a library that cannot be loaded, "none: " and why.
std::map<std::string, std::string> media_versions();

}  // namespace carom
