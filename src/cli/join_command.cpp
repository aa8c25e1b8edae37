// carom join: the parts of a film, as --chunk makes them, into the film.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/distinct_files.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/standard_error.h"
#include "core/readable.h"
#include "media/film_join.h"

namespace carom {

namespace {

struct JoinOptions {
    std::vector<std::string> parts;
    std::string output;
    CommonOptions common;
};

int join(const JoinOptions& options, const Interrupt& interrupt) {
    std::vector<NamedFile> inputs;
    for (const std::string& part : options.parts) inputs.push_back({"FILM", part});
    require_joinable(options.output);
    require_distinct({{"-o", options.output}}, inputs);
    require_writable(options.output, options.common.overwrite);

    std::optional<Progress> progress;  // its total is known when the parts are
    JoinHooks hooks;
    hooks.check = [&] { interrupt.check(); };
    hooks.joined = [&](std::int64_t done, std::int64_t total) {
        if (!progress) progress.emplace(options.common.progress_mode(), interrupt, kJoining, total);
        progress->update(static_cast<double>(done));
    };
    const std::int64_t frames =
        join_films(options.parts, options.output, options.common.existing(), hooks);
    progress.reset();
    if (!options.common.quiet)
        say("carom: {} films joined into '{}', {} frames\n", options.parts.size(),
            readable(options.output), frames);
    return kExitDone;
}

}  // namespace

void add_join_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command =
        app.add_subcommand("join", "Put chunks of a film together, without encoding again");
    auto options = std::make_shared<JoinOptions>();
    command->footer(
        "  carom render scene.yaml -o part1.mp4 --chunk 1/2\n"
        "  carom render scene.yaml -o part2.mp4 --chunk 2/2\n"
        "  carom join part1.mp4 part2.mp4 -o film.mp4\n");
    command
        ->add_option("films", options->parts,
                     "All parts of one film, in any order, made with --chunk or --frames")
        ->required()
        ->type_name("FILM...");
    command
        ->add_option("-o,--output", options->output,
                     "The whole film: .mp4, .mkv, .mov or .webm, as the parts are")
        ->required()
        ->type_name("OUT");
    command->add_flag("-y,--overwrite", options->common.overwrite,
                      "Replace the file if it exists (default: it is kept, exit code 4)");
    add_progress_options(*command, options->common);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return join(*options, interrupt); };
    });
}

}  // namespace carom
