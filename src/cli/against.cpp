#include "cli/against.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/shown_simulation.h"
#include "cli/standard_error.h"
#include "core/failure.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// What the second run is, from the scene's key and, before it, the command line.
std::optional<Against> wanted_against(const Scene& scene, const AgainstOptions& options) {
    std::optional<Against> wanted = scene.against;
    if (wanted && !wanted->scene.empty()) {
        // As seen from the scene's folder; standard input has none.
        const fs::path folder = fs::path(scene.file).parent_path();
        if (scene.file != "<stdin>") wanted->scene = (folder / wanted->scene).string();
    }
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

std::vector<Override> overrides_of(const std::vector<std::string>& set) {
    std::vector<Override> overrides;
    for (const std::string& text : set) overrides.push_back(parse_override(text));
    return overrides;
}

/// Where the second run's scene comes from.
struct SecondSource {
    std::string text, file;
    std::vector<Override> overrides;
    bool same_file = false;
};

SecondSource second_source(const Scene& scene, const std::string& text,
                           const std::vector<Override>& overrides, const Against& wanted) {
    SecondSource second;
    second.same_file = wanted.scene.empty();
    if (scene.file == "<stdin>" && wanted.scene == "-")
        throw Failure(FailureKind::kInput, "--against -: standard input is the scene itself");
    second.text = second.same_file ? text : read_scene_text(wanted.scene);
    second.file = second.same_file ? scene.file : wanted.scene == "-" ? "<stdin>" : wanted.scene;
    if (second.same_file) second.overrides = overrides;
    for (const Override& override : overrides_of(wanted.set)) second.overrides.push_back(override);
    return second;
}

void print(const Diagnostics& diagnostics, bool quiet) {
    for (const Diagnostic& d : diagnostics.items())
        if (!quiet || d.severity == Severity::kError) write_standard_error(d.shown());
}

std::string run_name(const Scene& scene, const Scene& compared) {
    if (!scene.title.empty() && scene.title != compared.title) return scene.title;
    return scene_stem(scene.file == "<stdin>" ? "-" : scene.file);
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
    const SecondSource source = second_source(scenes.scene, text, overrides, *wanted);
    SceneResult second = read_scene(source.text, source.file, source.overrides);
    // Of the same file warnings have been printed.
    print(second.diagnostics, options.quiet || source.same_file);
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
    const SecondSource source = second_source(scene, text, overrides, *wanted);
    return read_scene(source.text, source.file, source.overrides);
}

std::optional<FilmedSecond> simulate_second(const FilmScenes& scenes, const Motion& first,
                                            const Interrupt& interrupt, ProgressMode mode) {
    if (!scenes.second) return std::nullopt;
    FilmedSecond second;
    second.run.scene = *scenes.second;
    second.run.view = scenes.view;
    second.run.differences = scenes.differences;
    second.run.first_name = run_name(scenes.scene, *scenes.second);
    second.run.second_name = run_name(*scenes.second, scenes.scene);
    if (second.run.first_name == second.run.second_name) second.run.second_name += " (other run)";
    check_runs(scenes.scene, second.run);
    SimulationResult result = simulate_shown(*scenes.second, interrupt, mode, kSimulatingOther);
    second.motion_hash = result.motion.hash();
    second.report = std::move(result.report);
    second.run.ended_s = result.motion.duration;
    second.run.motion = held_until(std::move(result.motion), first.duration);
    return second;
}

}  // namespace carom
