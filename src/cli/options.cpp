#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>

#include "cli/interrupt.h"
#include "cli/standard_error.h"
#include "core/failure.h"

namespace carom {

std::vector<Override> CommonOptions::overrides() const {
    std::vector<Override> result;
    for (const std::string& text : set) result.push_back(parse_override(text));
    if (size) {
        const std::size_t cross = size->find_first_of("xX");
        if (cross == std::string::npos)
            throw Failure(FailureKind::kInput,
                          fmt::format("--size {}: expected WIDTHxHEIGHT, e.g. 1280x720", *size));
        result.push_back({"film.size", fmt::format("[{}, {}]", size->substr(0, cross),
                                                   size->substr(cross + 1))});
    }
    if (fps) result.push_back({"film.fps", *fps});
    return result;
}

void add_scene_argument(CLI::App& command, std::string& path) {
    command.add_option("scene", path, "Scene file, - for standard input")
        ->required()
        ->type_name("SCENE");
}

void add_scene_options(CLI::App& command, CommonOptions& options) {
    command
        .add_option("--set", options.set,
                    "Change the scene before it is read, e.g. balls.a.mass=1, film.size[0]=640 "
                    "(repeatable)")
        ->type_name("PATH=VALUE")
        ->take_all()
        ->allow_extra_args(false);
}

void add_picture_options(CLI::App& command, CommonOptions& options) {
    command
        .add_option("--size", options.size,
                    "Width and height of the picture in pixels, e.g. 640x360 (default: the scene's "
                    "film.size)")
        ->type_name("WxH");
}

void add_output_options(CLI::App& command, CommonOptions& options) {
    command.add_flag("-y,--overwrite", options.overwrite,
                     "Replace files that exist (default: they are kept, exit code 4)");
    command
        .add_option(
            "--stats", options.stats_path,
            "Write times, counts and effects as JSON, - for standard output (default: none)")
        ->type_name("FILE");
}

void add_progress_options(CLI::App& command, CommonOptions& options) {
    static const std::map<std::string, ProgressMode> kModes = {{"auto", ProgressMode::kAuto},
                                                               {"bar", ProgressMode::kBar},
                                                               {"plain", ProgressMode::kPlain},
                                                               {"none", ProgressMode::kNone},
                                                               {"json", ProgressMode::kJson}};
    command
        .add_option(
            "--progress", options.progress,
            "How progress is shown on standard error: a bar, plain lines every 5 s, or a line of "
            "JSON every 0.5 s; auto is a bar on a terminal, plain elsewhere")
        ->transform(CLI::CheckedTransformer(kModes))
        ->type_name("auto|bar|plain|none|json")
        ->default_str("auto");
    command.add_flag("-q,--quiet", options.quiet, "Errors only");
}

void add_talk_options(CLI::App& command, CommonOptions& options) {
    add_progress_options(command, options);
    command.add_flag("-v,--verbose", options.verbose, "Say more on standard error");
}

void add_time_limit_option(CLI::App& command, const Interrupt& interrupt) {
    command
        .add_option_function<double>(
            "--time-limit", [&interrupt](double seconds) { interrupt.end_after(seconds); },
            "End after so many seconds of the clock, with exit code 1 and no file that is not "
            "whole "
            "(default: none)")
        ->type_name("S")
        ->check([](const std::string& text) {
            double seconds = 0;  // not a number is not above 0 either
            const bool right = CLI::detail::lexical_cast(text, seconds) && seconds > 0;
            return right ? std::string()
                         : fmt::format("'{}' is no number of seconds above 0", text);
        });
}

std::optional<Scene> load_scene(const std::string& path, const CommonOptions& options) {
    SceneResult result = read_scene_file(path, options.overrides());
    for (const Diagnostic& d : result.diagnostics.items()) {
        if (options.quiet && d.severity == Severity::kWarning) continue;
        write_standard_error(d.shown());
    }
    return std::move(result.scene);
}

std::string scene_stem(const std::string& path) {
    return path == "-" ? "scene" : std::filesystem::path(path).stem().string();
}

}  // namespace carom
