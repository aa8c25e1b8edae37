#include "report/second_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "core/failure.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

std::string run_name(const Scene& scene, const Scene& compared) {
    if (!scene.title.empty() && scene.title != compared.title) return scene.title;
    return scene.file == "<stdin>" ? "scene" : fs::path(scene.file).stem().string();
}

}  // namespace

std::optional<Against> against_named_in(const Scene& scene) {
    std::optional<Against> wanted = scene.against;
    if (wanted && !wanted->scene.empty() && !scene.file.starts_with('<'))
        wanted->scene = (fs::path(scene.file).parent_path() / wanted->scene).string();
    return wanted;
}

SceneSource second_source(const SceneSource& first, const Against& wanted) {
    SceneSource second = first;
    if (!wanted.scene.empty()) {
        if (first.file == "<stdin>" && wanted.scene == "-")
            throw Failure(FailureKind::kInput, "--against -: standard input is the scene itself");
        second = {
            read_scene_text(wanted.scene), wanted.scene == "-" ? "<stdin>" : wanted.scene, {}};
    }
    for (const std::string& text : wanted.set) second.overrides.push_back(parse_override(text));
    return second;
}

SecondRun make_second_run(const Scene& first, double first_ends_s, const Scene& second,
                          Motion motion, AgainstView view,
                          std::vector<SceneDifference> differences) {
    SecondRun run;
    run.scene = second;
    run.view = view;
    run.differences = std::move(differences);
    run.first_name = run_name(first, second);
    run.second_name = run_name(second, first);
    if (run.first_name == run.second_name) run.second_name += " (other run)";
    check_runs(first, run);
    run.ended_s = motion.duration;
    run.motion = held_until(std::move(motion), first_ends_s);
    return run;
}

std::string second_text(const Scene& second, AgainstView view) {
    return fmt::format("{:016x} {}", second.fingerprint,
                       view == AgainstView::kSide ? "side" : "ghost");
}

}  // namespace carom
