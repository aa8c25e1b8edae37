// carom accuracy: speed against error on a scene of the user's own.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>

#include "cli/commands.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "core/failure.h"
#include "core/readable.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "report/accuracy_files.h"

namespace carom {

namespace {

struct AccuracyCommand {
    std::string scene;
    std::string folder;
    AccuracyOptions measure;
    CommonOptions common;
};

/// Makes the folder if need be, and refuses what may not be replaced.
void prepare(const AccuracyCommand& command, const Interrupt& interrupt) {
    require_gnuplot(interrupt.token());
    prepare_folder(command.folder);
    for (const std::string& name : accuracy_file_names()) {
        const std::string path = (std::filesystem::path(command.folder) / name).string();
        require_distinct({{"-o", path}}, {{"SCENE", command.scene}});
        require_writable(path, command.common.overwrite);
    }
}

int accuracy(AccuracyCommand command, const Interrupt& interrupt) {
    prepare(command, interrupt);
    const std::optional<Scene> scene = load_scene(command.scene, command.common);
    if (!scene) return kExitInvalidScene;
    if (scene->balls.empty())
        throw Failure(FailureKind::kInput,
                      fmt::format("{} has no balls: there is no motion to measure", command.scene));
    std::sort(command.measure.steps.begin(), command.measure.steps.end(), std::greater<>());
    const AccuracyReport report =
        measure_accuracy(*scene, command.measure, interrupt.token(), [&](const std::string& what) {
            interrupt.reached("while measuring " + what);
            if (!command.common.quiet) say("carom: {}\n", readable_message(what));
        });
    interrupt.reached("while drawing the plots");
    write_accuracy(report, command.folder, command.common.existing(), interrupt.token());
    write_standard_output(accuracy_summary(report) + "\n");
    return kExitDone;
}

}  // namespace

void add_accuracy_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command =
        app.add_subcommand("accuracy", "Measure speed against error of the methods on a scene");
    auto options = std::make_shared<AccuracyCommand>();
    command->footer("  carom accuracy scene.yaml -o out/accuracy --budget 5\n");
    add_scene_argument(*command, options->scene);
    command
        ->add_option("-o,--output", options->folder,
                     "Folder for table, numbers and plots, made if need be")
        ->required()
        ->type_name("DIR");
    command
        ->add_option("--steps", options->measure.steps,
                     "Steps of the method fixed, s (default: 0.01 ... 0.00001)")
        ->type_name("S,...")
        ->delimiter(',')
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--budget", options->measure.budget_s,
                     "CPU seconds that one method and step may take")
        ->type_name("S")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command
        ->add_option("--repeats", options->measure.repeats,
                     "Timed runs, 1 to 1000, whose median counts")
        ->type_name("N")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    add_scene_options(*command, options->common);
    command->add_flag("-y,--overwrite", options->common.overwrite, "Replace files that exist");
    command->add_flag("-q,--quiet", options->common.quiet, "Errors and the result only");
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return accuracy(*options, interrupt); };
    });
}

}  // namespace carom
