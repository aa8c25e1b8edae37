// carom report: one page that shows a run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/options.h"
#include "cli/report_run.h"
#include "cli/standard_output.h"
#include "core/failure.h"
#include "media/output_file.h"

namespace carom {

namespace {

struct ReportOptions {
    std::string scene;
    std::string output;
    ReportWishes wishes;
    CommonOptions common;
};

int report(const ReportOptions& options, const Interrupt& interrupt) {
    require_distinct({{"-o", options.output}}, {{"SCENE", options.scene}});
    if (options.output != "-") {
        const std::string extension = std::filesystem::path(options.output).extension().string();
        if (extension != ".html" && extension != ".htm")
            throw Failure(FailureKind::kInput,
                          fmt::format("-o {}: a report is a .html file", options.output));
        require_writable(options.output, options.common.overwrite);
    }
    const std::optional<ReportedRun> run =
        run_for_report(options.scene, options.common, options.wishes, interrupt);
    if (!run) return kExitInvalidScene;
    const std::string page = report_page(run->scene, run->result, run->parts);
    interrupt.check();
    if (options.output == "-")
        write_standard_output(page);
    else
        write_text_file(options.output, page, Durability::kSynced, options.common.existing());
    return kExitDone;
}

}  // namespace

void add_report_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand(
        "report", "Show a run in one page: viewer, film, plots, tables, all in one file");
    auto options = std::make_shared<ReportOptions>();
    command->footer(
        "  carom report scene.yaml -o report.html\n"
        "  carom report scene.yaml -o report.html --accuracy --size 640x360\n");
    command->add_option("scene", options->scene, "Scene file, - for standard input")
        ->required()
        ->type_name("SCENE");
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
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return report(*options, interrupt); };
    });
}

}  // namespace carom
