// Names of goldens: DIR/<scene>-t<seconds, 6 decimals>.png.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace carom {

/// "figure8-t1.000000", of which the golden is DIR/figure8-t1.000000.png.
std::string still_name(const std::string& scene_stem, double time_s);

std::string golden_path(const std::string& folder, const std::string& name);

/// The scene's part of a still's name; empty where it is none.
std::optional<std::string> scene_of_still(const std::string& name);

/// What stands in the folder and belongs to none of the stills: paths of goldens, and of the side
/// files of what is ignored (ignore_file.h), sorted.
std::vector<std::string> orphans(const std::string& folder, const std::vector<std::string>& stills);

}  // namespace carom
