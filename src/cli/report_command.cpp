// carom report: one page that shows a run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/options.h"
#include "cli/report_run.h"
#include "cli/standard_output.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/output_file.h"
#include "page/overview_page.h"
#include "page/sweep_page.h"

namespace carom {

namespace {

struct ReportOptions {
    std::vector<std::string> scenes;
    std::string output;
    ReportWishes wishes;
    CommonOptions common;
};

/// Pictures of an overview are small: at most this wide, in the proportions of the film.
constexpr int kOverviewWidth = 480;

bool has_folder(const ReportOptions& options) {
    std::error_code unreadable;
    return std::any_of(options.scenes.begin(), options.scenes.end(), [&](const std::string& path) {
        return std::filesystem::is_directory(path, unreadable);
    });
}

/// A folder is shown as it is: what a scene's simulation takes does not go with it.
void require_alone(const ReportOptions& options) {
    if (options.scenes.size() > 1)
        throw Failure(FailureKind::kInput,
                      "the folder of a sweep has a page of its own: name it "
                      "alone");
    if (options.wishes.accuracy || !options.common.overrides().empty())
        throw Failure(FailureKind::kInput,
                      "--set, --size and --accuracy are for scenes; the runs of a sweep are made");
    if (!is_sweep_folder(options.scenes.front()))
        throw Failure(
            FailureKind::kInput,
            fmt::format("{} is a folder without index.csv and dataset.json: `carom sweep "
                        "SWEEP.yaml -o {} --index` writes them",
                        readable(options.scenes.front()), readable(options.scenes.front())));
}

/// The page of one scene, of several, or of a sweep's folder; empty where a scene is invalid, which
/// has been said.
std::optional<std::string> page(const ReportOptions& options, const Interrupt& interrupt) {
    if (has_folder(options)) {
        require_alone(options);
        return sweep_page(read_run_table(options.scenes.front()), CAROM_VERSION);
    }
    if (options.scenes.size() == 1) {
        const std::optional<ReportedRun> run =
            run_for_report(options.scenes.front(), options.common, options.wishes, interrupt);
        if (!run) return std::nullopt;
        return report_page(run->scene, run->result, run->parts,
                           run->ghosts ? &*run->ghosts : nullptr);
    }
    std::vector<OverviewEntry> entries;
    bool valid = true;
    for (const std::string& scene : options.scenes) {
        interrupt.check();
        interrupt.reached(
            fmt::format("after {} of {} scenes", entries.size(), options.scenes.size()));
        ReportWishes wishes;
        wishes.film = false;
        wishes.width_px = kOverviewWidth;
        const std::optional<ReportedRun> run =
            run_for_report(scene, options.common, wishes, interrupt);
        valid = valid && run;
        if (run) entries.emplace_back(run->scene, run->result, run->parts.strobe_png);
    }
    if (!valid) return std::nullopt;
    return overview_page(entries, CAROM_VERSION);
}

int report(const ReportOptions& options, const Interrupt& interrupt) {
    std::vector<NamedFile> inputs;
    for (const std::string& scene : options.scenes) inputs.push_back({"SCENE", scene});
    require_distinct({{"-o", options.output}}, inputs);
    if (options.scenes.size() > 1 && options.wishes.accuracy)
        throw Failure(FailureKind::kInput, "--accuracy is for the report of one scene");
    if (options.output != "-") {
        const std::string extension = std::filesystem::path(options.output).extension().string();
        if (extension != ".html" && extension != ".htm")
            throw Failure(FailureKind::kInput,
                          fmt::format("-o {}: a report is a .html file", options.output));
        require_writable(options.output, options.common.overwrite);
    }
    const std::optional<std::string> made = page(options, interrupt);
    if (!made) return kExitInvalidScene;
    interrupt.check();
    if (options.output == "-")
        write_standard_output(*made);
    else
        write_text_file(options.output, *made, Durability::kSynced, options.common.existing());
    return kExitDone;
}

}  // namespace

void add_report_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand(
        "report", "Show a run in one page: viewer, film, plots, tables, all in one file");
    auto options = std::make_shared<ReportOptions>();
    command->footer(
        "  carom report scene.yaml -o report.html\n"
        "  carom report scene.yaml -o report.html --accuracy --size 640x360\n"
        "  carom report scenes/official/*.yaml -o overview.html\n"
        "  carom report out/sweep -o sweep.html\n");
    command
        ->add_option("scene", options->scenes,
                     "Scene file, - for standard input; several make one page with a picture "
                     "and a row each; or the folder of a sweep")
        ->required()
        ->type_name("SCENE")
        ->expected(1, CLI::detail::expected_max_vector_size)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("-o,--output", options->output, "The page, - for standard output")
        ->required()
        ->type_name("PAGE.html");
    command->add_flag("--accuracy", options->wishes.accuracy,
                      "Measure speed beside error of the methods on the scene (default: not; times "
                      "differ from run to run)");
    add_scene_options(*command, options->common);
    add_picture_options(*command, options->common);
    add_backend_option(*command);
    command->add_flag("-y,--overwrite", options->common.overwrite,
                      "Replace a file that exists (default: it is kept, exit code 4)");
    add_progress_options(*command, options->common);
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return report(*options, interrupt); };
    });
}

}  // namespace carom
