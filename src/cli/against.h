// Two runs in one film: `--against`, and the scene's own key.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/interrupt.h"
#include "cli/options.h"
#include "render/runs/second_run.h"
#include "sim/simulate.h"

namespace carom {

/// What the command line says of a second run.
struct AgainstOptions {
    std::string scene;             ///< --against; "" where it is not named
    std::vector<std::string> set;  ///< --against-set
    std::string view;              ///< --against-view: ghost, side, or "" where it is not named
};

void add_against_options(CLI::App& command, AgainstOptions& options);

/// The scene of a film, and the one that it is shown against. The latter has the first one's frames
/// and picture, its own bodies and simulation.
struct FilmScenes {
    Scene scene;
    std::optional<Scene> second;  ///< empty where there is none
    AgainstView view = AgainstView::kGhost;
    std::vector<SceneDifference> differences;
    std::string text;  ///< of SCENE, as the file has it
};

/// Reads both and prints their diagnostics; empty when one is invalid (exit code 3). --set changes
/// SCENE, and with it the second run where that is the same scene with values set.
std::optional<FilmScenes> load_film_scenes(const std::string& path, const CommonOptions& options,
                                           const AgainstOptions& against);

/// The file of the second run that a scene names itself; "" where there is none or it is the same
/// file.
std::string second_scene_file(const Scene& scene);

/// The second run of a scene that names one itself, without the command line's; empty where it does
/// not. `text` and `overrides` are those that `scene` was read from.
std::optional<SceneResult> read_second(const Scene& scene, const std::string& text,
                                       const std::vector<Override>& overrides);

/// The simulated second run, ready for the painter, with what --stats says of it.
struct FilmedSecond {
    SecondRun run;
    std::uint64_t motion_hash = 0;
    SimulationReport report;
};

/// Simulates the second run, if there is one, and checks that it can be shown with the first.
std::optional<FilmedSecond> simulate_second(const FilmScenes& scenes, const Motion& first,
                                            const Interrupt& interrupt, ProgressMode mode);

}  // namespace carom
