// Options that several commands share, and how they reach the scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/progress.h"
#include "media/output_file.h"
#include "scene/reader.h"

namespace CLI {
class App;
}

namespace carom {

class Interrupt;

/// What the user asked for on the command line, besides the command's own options.
struct CommonOptions {
    std::vector<std::string> set;     ///< PATH=VALUE
    std::optional<std::string> size;  ///< WxH
    std::optional<std::string> fps;
    bool overwrite = false;
    std::string stats_path;  ///< empty: none
    ProgressMode progress = ProgressMode::kAuto;
    bool quiet = false;
    bool verbose = false;

    /// --set, --size and --fps as changes of the scene's document.
    std::vector<Override> overrides() const;
    Existing existing() const { return existing_of(overwrite); }
    ProgressMode progress_mode() const { return quiet ? ProgressMode::kNone : progress; }
};

void add_scene_argument(CLI::App& command, std::string& path);         ///< SCENE
void add_scene_options(CLI::App& command, CommonOptions& options);     ///< --set
void add_picture_options(CLI::App& command, CommonOptions& options);   ///< --size
void add_output_options(CLI::App& command, CommonOptions& options);    ///< -y, --stats
void add_progress_options(CLI::App& command, CommonOptions& options);  ///< --progress, -q
void add_talk_options(CLI::App& command, CommonOptions& options);      ///< the same, and -v
/// --time-limit: of every command that simulates or draws.
void add_time_limit_option(CLI::App& command, const Interrupt& interrupt);

/// Reads the scene and prints its diagnostics; empty when it is invalid (exit code 3).
std::optional<Scene> load_scene(const std::string& path, const CommonOptions& options);

/// The scene file's name without folder and extension; "scene" for standard input.
std::string scene_stem(const std::string& path);

}  // namespace carom
