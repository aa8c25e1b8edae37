// carom golden: stills of scenes against pictures kept in a folder.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "cli/against.h"
#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/short_lived.h"
#include "cli/shown_simulation.h"
#include "cli/standard_output.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/file_kind.h"
#include "media/output_folder.h"
#include "media/png.h"
#include "render/gl/offscreen.h"
#include "render/painter.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

struct GoldenOptions {
    std::vector<std::string> scenes;
    std::string folder;
    std::string differences;  ///< folder for pictures of what differs; empty: none
    std::vector<double> times;
    CommonOptions common;
};

std::string golden_path(const GoldenOptions& options, const std::string& scene, double time) {
    return (fs::path(options.folder) / fmt::format("{}-t{:.6f}.png", scene_stem(scene), time))
        .string();
}

/// Refuses two stills under one name, of which the second would replace the first.
class GoldenNames {
  public:
    void add_scene(const std::string& scene) {
        const auto [first, fresh] = scenes_.emplace(scene_stem(scene), scene);
        std::error_code error;
        if (fresh || first->second == scene || fs::equivalent(first->second, scene, error)) return;
        throw Failure(FailureKind::kInput,
                      fmt::format("{} and {} have one name: the goldens of both would be {}-t*.png",
                                  first->second, scene, scene_stem(scene)));
    }
    void add_time(const std::string& golden, double time) {
        const auto [first, fresh] = times_.emplace(golden, time);
        if (fresh || first->second == time) return;
        throw Failure(FailureKind::kInput, fmt::format("the stills at {} s and {} s have one name, "
                                                       "{}: names have 6 decimals",
                                                       first->second, time, golden));
    }

  private:
    std::map<std::string, std::string> scenes_;  ///< stem -> path
    std::map<std::string, double> times_;        ///< path of the golden -> s
};

/// A golden, or why there is none to compare with.
struct Golden {
    std::optional<Image> picture;
    std::string why;
};

Golden read_golden(const std::string& path) {
    try {
        if (file_content(path).kind == FileKind::kLfsPointer) return {std::nullopt, kLfsAdvice};
        return {read_png(path), ""};
    } catch (const Failure& failure) {
        return {std::nullopt, failure.what()};
    }
}

/// How many stills came out how.
struct Tally {
    int same = 0, different = 0, missing = 0, unreadable = 0;
    std::string text() const {
        return fmt::format("{} same, {} different, {} missing, {} unreadable\n", same, different,
                           missing, unreadable);
    }
};

/// One still against its golden; prints what was found, and counts it.
void compare_with_golden(const GoldenOptions& options, const std::string& path, const Image& drawn,
                         const std::string& renderer, Tally& tally) {
    if (!fs::exists(path)) {
        ++tally.missing;
        write_standard_output(fmt::format("missing: {}\n", readable(path)));
        return;
    }
    const Golden kept = read_golden(path);
    if (!kept.picture) {
        ++tally.unreadable;
        write_standard_output(
            fmt::format("unreadable: {}: {}\n", readable(path), readable_message(kept.why)));
        return;
    }
    const Image& golden = *kept.picture;
    const ImageDifference d = compare_images(golden, drawn);
    if (ImageTolerance{}.accepts(d)) {
        ++tally.same;
        if (!options.common.quiet) write_standard_output(fmt::format("same: {}\n", readable(path)));
        return;
    }
    ++tally.different;
    std::string found = fmt::format("sizes differ ({}x{}, drawn {}x{})", golden.width_px,
                                    golden.height_px, drawn.width_px, drawn.height_px);
    if (d.same_size)
        found = fmt::format("largest difference {} of 255, {:.3f} % of pixels differ", d.largest,
                            100 * d.differing_fraction());
    write_standard_output(
        fmt::format("different: {}: {}; drawn by {}\n", readable(path), found, renderer));
    if (!options.differences.empty()) {
        make_folder(options.differences);
        const fs::path base = fs::path(options.differences) / fs::path(path).stem();
        write_png(base.string() + ".drawn.png", drawn);
        if (d.same_size) write_png(base.string() + ".diff.png", difference_image(golden, drawn));
    }
}

/// Draws stills of one scene after the other, with one driver: scenes that want the same programs
/// find them made.
class Stills {
  public:
    Stills(const GoldenOptions& options, const Interrupt& interrupt)
        : options_(options), interrupt_(interrupt) {
        for (const std::string& scene : options.scenes) names_.add_scene(scene);
        if (options.scenes.empty()) return;
        for (const double time : options.times)
            names_.add_time(golden_path(options, options.scenes.front(), time), time);
    }

    /// Runs `use` on every wanted still of one scene. False when the scene is invalid.
    template <class Use>
    bool for_each(const std::string& path, const Use& use);

  private:
    const GoldenOptions& options_;
    const Interrupt& interrupt_;
    GoldenNames names_;
    std::shared_ptr<DrawingContexts> contexts_;
    int done_ = 0;
};

template <class Use>
bool Stills::for_each(const std::string& path, const Use& use) {
    const GoldenOptions& options = options_;
    const std::optional<FilmScenes> scenes = load_film_scenes(path, options.common, {});
    if (!scenes) return false;
    const Scene* scene = &scenes->scene;
    const std::vector<double>& times = options.times.empty() ? scene->film.stills : options.times;
    if (times.empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("{}: no stills: name them with film.stills or --time", path));
    for (const double time : times) names_.add_time(golden_path(options, path, time), time);
    const ProgressMode mode = options.common.progress_mode();
    const SimulationResult simulated = simulate_shown(*scene, interrupt_, mode);
    const std::optional<FilmedSecond> second =
        simulate_second(*scenes, simulated.motion, interrupt_, mode);
    interrupt_.reached(fmt::format("after {} stills", done_));
    PainterOptions painting;
    painting.width_px = scene->film.width_px;
    painting.height_px = scene->film.height_px;
    painting.second = second ? &second->run : nullptr;
    painting.few_pictures =
        draws_sooner_than_it_compiles(painting.width_px, painting.height_px, times.size());
    if (!contexts_) {
        if (painting.few_pictures) prefer_quick_compile();
        contexts_ = std::make_shared<DrawingContexts>();
    }
    painting.contexts = contexts_;
    Painter painter(*scene, simulated.motion, painting);
    Image picture;
    for (const double time : times) {
        if (!(time >= 0 && time <= simulated.motion.duration))
            throw Failure(FailureKind::kInput,
                          fmt::format("{}: no instant {} s: the motion ends at {} s", path, time,
                                      simulated.motion.duration));
        painter.paint(time, picture);
        interrupt_.check();
        use(golden_path(options, path, time), picture, painter.renderer());
        interrupt_.reached(fmt::format("after {} stills", ++done_));
    }
    return true;
}

int check(const GoldenOptions& options, const Interrupt& interrupt) {
    if (!options.differences.empty()) require_folder(options.differences);
    bool valid = true;
    Tally tally;
    Stills stills(options, interrupt);
    for (const std::string& scene : options.scenes)
        valid &= stills.for_each(
            scene, [&](const std::string& path, const Image& drawn, const std::string& renderer) {
                compare_with_golden(options, path, drawn, renderer, tally);
            });
    const bool same = tally.different + tally.missing + tally.unreadable == 0;
    if (!same || !options.common.quiet) write_standard_output(tally.text());
    if (!valid) return kExitInvalidScene;
    return same ? kExitDone : kExitDifferent;
}

int update(const GoldenOptions& options, const Interrupt& interrupt) {
    Stills stills(options, interrupt);
    prepare_folder(options.folder);
    bool valid = true;
    for (const std::string& scene : options.scenes)
        valid &= stills.for_each(
            scene, [&](const std::string& path, const Image& drawn, const std::string&) {
                // A golden that still holds stays as it is, so that its history shows real changes.
                const Golden kept = fs::exists(path) ? read_golden(path) : Golden{};
                if (kept.picture && ImageTolerance{}.accepts(compare_images(*kept.picture, drawn)))
                    return;
                write_png(path, drawn, PngEffort::kSmall);
                write_standard_output(fmt::format("written: {}\n", readable(path)));
            });
    return valid ? kExitDone : kExitInvalidScene;
}

}  // namespace

void add_golden_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("golden", "Compare stills with kept pictures, or keep them");
    command->require_subcommand(1);
    auto options = std::make_shared<GoldenOptions>();
    command->footer(
        "  carom golden update scenes/*.yaml --dir goldens\n"
        "  carom golden check scenes/*.yaml --dir goldens --diffs differences\n");
    const auto add = [&](const char* name, const char* what, auto function) {
        auto* action = command->add_subcommand(name, what);
        action->footer(fmt::format("  carom golden {} scenes/*.yaml --dir goldens\n", name));
        action->add_option("scenes", options->scenes, "Scene files, with names that differ")
            ->required()
            ->type_name("SCENE...");
        action->add_option("--dir", options->folder, "Folder of the goldens")
            ->required()
            ->type_name("DIR");
        action
            ->add_option("--time", options->times,
                         "Instant in seconds (repeatable; default: the scene's film.stills)")
            ->type_name("T")
            ->take_all()
            ->allow_extra_args(false);
        add_scene_options(*action, options->common);
        add_picture_options(*action, options->common);
        add_backend_option(*action);
        add_progress_options(*action, options->common);
        action->callback([options, function, &run, &interrupt] {
            run = [options, function, &interrupt] { return function(*options, interrupt); };
        });
        return action;
    };
    add("check", "Fail (exit code 5) where a still differs from its golden", check)
        ->add_option(
            "--diffs", options->differences,
            "Folder for pictures of what differs, replaced where they exist (default: none)")
        ->type_name("DIR");
    add("update", "Write goldens that are missing or differ", update);
}

}  // namespace carom
