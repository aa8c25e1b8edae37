#include "cli/against.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/shown_simulation.h"
#include "cli/standard_error.h"
#include "core/failure.h"
#include "report/second_scene.h"

namespace carom {

namespace {

/// What the second run is, from the scene's key and, before it, the command line.
std::optional<Against> wanted_against(const Scene& scene, const AgainstOptions& options) {
    std::optional<Against> wanted = against_named_in(scene);
    if (!options.scene.empty() || !options.set.empty()) {
        const AgainstView view = wanted ? wanted->view : AgainstView::kGhost;
        wanted = Against{options.scene, options.set, view};
    }
    if (options.view.empty()) return wanted;
    if (!wanted)
        throw Failure(FailureKind::kInput,
                      "--against-view: there is no other run; name it with --against or "
                      "--against-set");
    wanted->view = options.view == "side" ? AgainstView::kSide : AgainstView::kGhost;
    return wanted;
}

void print(const Diagnostics& diagnostics, bool quiet) {
    for (const Diagnostic& d : diagnostics.items())
        if (!quiet || d.severity == Severity::kError) write_standard_error(d.shown());
}

}  // namespace

void add_against_options(CLI::App& command, AgainstOptions& options) {
    command
        .add_option("--against", options.scene,
                    "Another scene to show with this one: balls of equal names are compared")
        ->type_name("OTHER.yaml");
    command
        .add_option("--against-set", options.set,
                    "The same scene (or OTHER) with a value set, e.g. simulation.method=fixed "
                    "(repeatable)")
        ->type_name("PATH=VALUE")
        ->take_all()
        ->allow_extra_args(false);
    command
        .add_option("--against-view", options.view,
                    "In the same picture, or beside it (default: as the scene says, else ghost)")
        ->check(CLI::IsMember({"ghost", "side"}))
        ->type_name("ghost|side");
}

std::optional<FilmScenes> load_film_scenes(const std::string& path, const CommonOptions& options,
                                           const AgainstOptions& against) {
    const std::string text = read_scene_text(path);
    const std::vector<Override> overrides = options.overrides();
    SceneResult first = read_scene(text, path == "-" ? "<stdin>" : path, overrides);
    print(first.diagnostics, options.quiet);
    if (!first.scene) return std::nullopt;
    FilmScenes scenes{std::move(*first.scene), std::nullopt, AgainstView::kGhost, {}, text};
    const std::optional<Against> wanted = wanted_against(scenes.scene, against);
    if (!wanted) return scenes;

    scenes.view = wanted->view;
    const SceneSource source = second_source({text, scenes.scene.file, overrides}, *wanted);
    SceneResult second = read_scene(source.text, source.file, source.overrides);
    // Of the same file warnings have been printed.
    print(second.diagnostics, options.quiet || wanted->scene.empty());
    if (!second.scene) return std::nullopt;
    scenes.second = std::move(second.scene);
    scenes.differences = scene_differences(text, overrides, source.text, source.overrides);
    if (scenes.differences.empty() && !options.quiet)
        say("carom: warning: both runs are the same\n");
    return scenes;
}

std::string second_scene_file(const Scene& scene) {
    const std::optional<Against> wanted = wanted_against(scene, {});
    return wanted && wanted->scene != "-" ? wanted->scene : "";
}

std::optional<SceneResult> read_second(const Scene& scene, const std::string& text,
                                       const std::vector<Override>& overrides) {
    const std::optional<Against> wanted = wanted_against(scene, {});
    if (!wanted) return std::nullopt;
    const SceneSource source = second_source({text, scene.file, overrides}, *wanted);
    return read_scene(source.text, source.file, source.overrides);
}

std::optional<FilmedSecond> simulate_second(const FilmScenes& scenes, const Motion& first,
                                            const Interrupt& interrupt, ProgressMode mode) {
    if (!scenes.second) return std::nullopt;
    // What cannot be shown together need not be simulated.
    make_second_run(scenes.scene, 0, *scenes.second, {}, scenes.view, scenes.differences);
    SimulationResult result = simulate_shown(*scenes.second, interrupt, mode, kSimulatingOther);
    FilmedSecond second;
    second.motion_hash = result.motion.hash();
    second.report = std::move(result.report);
    second.run = make_second_run(scenes.scene, first.duration, *scenes.second,
                                 std::move(result.motion), scenes.view, scenes.differences);
    return second;
}

}  // namespace carom
