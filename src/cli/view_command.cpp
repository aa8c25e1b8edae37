// carom view: the viewer of reports beside an editor.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "cli/against.h"
#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/standard_output.h"
#include "cli/view_server.h"
#include "core/failure.h"
#include "page/view_page.h"
#include "sim/simulate.h"

namespace carom {

namespace {

struct ViewOptions {
    std::string scene;
    int port = 0;
    CommonOptions common;
};

constexpr std::chrono::milliseconds kLook{200};  ///< between two looks at the file

/// When a file was written, and how long it is; nothing where it is not there, as for a moment
/// while an editor replaces it.
struct FileState {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool operator==(const FileState&) const = default;
};
std::optional<FileState> file_state(const std::string& path) {
    std::error_code failed;
    FileState state{std::filesystem::last_write_time(path, failed), 0};
    if (failed) return std::nullopt;
    state.size = std::filesystem::file_size(path, failed);
    return failed ? std::nullopt : std::optional(state);
}

/// Of the scene and, where it names one, of the scene that it is shown against.
struct Watched {
    std::string scene, other;

    /// The scene's own state comes first; empty where it is not there.
    std::vector<std::optional<FileState>> states() const {
        std::vector<std::optional<FileState>> states{file_state(scene)};
        if (!states.front()) return {};
        if (!other.empty()) states.push_back(file_state(other));
        return states;
    }
};

/// Makes a page of the scene whenever it has been saved.
class SceneWatch {
  public:
    SceneWatch(const ViewOptions& options, ViewServer& server)
        : options_(options), server_(server), thread_([this](const std::stop_token& stop) {
              while (!stop.stop_requested()) look(stop);
          }) {}

  private:
    void look(const std::stop_token& stop) {
        std::vector<std::optional<FileState>> now = watched_.states();
        if (!now.empty() && now != shown_) {
            shown_ = std::move(now);
            const int revision = ++revision_;
            if (std::optional<std::string> made = page(revision, stop))
                server_.show(std::move(*made), revision);
        }
        std::this_thread::sleep_for(kLook);
    }

    /// Empty where the scene was saved meanwhile, which ends the simulation: its page comes next.
    std::optional<std::string> page(int revision, const std::stop_token& stop) {
        std::stop_source saved;
        const std::stop_callback ended(stop, [&] { saved.request_stop(); });
        try {
            const std::string text = read_scene_text(options_.scene);
            const std::vector<Override> overrides = options_.common.overrides();
            const SceneResult read = read_scene(text, options_.scene, overrides);
            if (!read.scene) return wrong_page(read.diagnostics, revision);
            watch(second_scene_file(*read.scene));
            const std::optional<SceneResult> other = read_second(*read.scene, text, overrides);
            if (other && !other->scene) return wrong_page(other->diagnostics, revision);
            const SimulationResult result = simulated(*read.scene, saved);
            std::optional<SecondRun> ghosts;
            if (other && same_surfaces(*read.scene, *other->scene)) {
                ghosts.emplace();
                ghosts->scene = *other->scene;
                check_runs(*read.scene, *ghosts);
                ghosts->motion =
                    held_until(simulated(*other->scene, saved).motion, result.motion.duration);
            }
            return view_page(*read.scene, result, ghosts ? &*ghosts : nullptr, CAROM_VERSION,
                             revision, textures_);
        } catch (const std::exception& failure) {
            if (saved.stop_requested()) return std::nullopt;
            return wrong_scene_page(options_.scene, failure.what(), revision);
        }
    }

    /// The same states of the scene's file, and those of the other one as it is now.
    void watch(const std::string& other) {
        if (watched_.other == other) return;
        watched_.other = other;
        shown_.resize(1);
        if (!other.empty()) shown_.push_back(file_state(other));
    }

    std::string wrong_page(const Diagnostics& diagnostics, int revision) const {
        std::string messages;
        for (const Diagnostic& d : diagnostics.items()) messages += d.shown();
        return wrong_scene_page(options_.scene, messages, revision);
    }

    /// Broken off where a file is saved meanwhile.
    SimulationResult simulated(const Scene& scene, std::stop_source& saved) const {
        return simulate(scene, saved.get_token(), [&](double) {
            if (const auto now = watched_.states(); !now.empty() && now != shown_)
                saved.request_stop();
        });
    }

    const ViewOptions& options_;
    ViewServer& server_;
    Watched watched_{options_.scene, ""};
    std::vector<std::optional<FileState>> shown_;
    int revision_ = 0;
    KnownTextures textures_;
    std::jthread thread_;  ///< last: it uses all of the above
};

int view(const ViewOptions& options, const Interrupt& interrupt) {
    if (options.scene == "-")
        throw Failure(FailureKind::kInput, "view: standard input cannot be saved anew; a file can");
    if (!file_state(options.scene))
        throw Failure(FailureKind::kInput, fmt::format("cannot read '{}'", options.scene));
    options.common.overrides();  // a wrong --set ends the command, not a page
    ViewServer server(options.port);
    server.show(waiting_page(options.scene, 0), 0);
    const SceneWatch watch(options, server);
    write_standard_output(fmt::format("http://127.0.0.1:{}/\n", server.port()));
    server.serve([&] { return interrupt.requested(); });
    throw Interrupted{};
}

}  // namespace

void add_view_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand(
        "view", "Serve the viewer of a scene to a browser of this machine while it is edited");
    auto options = std::make_shared<ViewOptions>();
    command->footer("  carom view scene.yaml\n  carom view scene.yaml --port 8017\n");
    command->add_option("scene", options->scene, "Scene file, read again when it is saved")
        ->required()
        ->type_name("SCENE");
    command
        ->add_option(
            "--port", options->port,
            "Port on 127.0.0.1, which no other machine reaches (default: one that is free; "
            "the address is printed)")
        ->check(CLI::Range(0, 65535))
        ->type_name("N");
    add_scene_options(*command, options->common);
    add_backend_option(*command);
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return view(*options, interrupt); };
    });
}

}  // namespace carom
