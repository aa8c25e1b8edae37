// carom figures: the paper's figures and tables.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "cli/backend_option.h"
#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/standard_error.h"
#include "core/failure.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "report/paper.h"
#include "report/plot.h"

namespace carom {

namespace {

struct FiguresOptions {
    std::string folder;
    std::vector<std::string> only;
    CommonOptions common;
};

/// Makes the folder if need be, and refuses what may not be replaced.
void prepare(const FiguresOptions& options, const std::vector<PaperItem>& items,
             const Interrupt& interrupt) {
    prepare_folder(options.folder);
    for (const PaperItem& item : items)
        for (const std::string& file : item.files)
            require_writable((std::filesystem::path(options.folder) / file).string(),
                             options.common.overwrite);
    if (std::any_of(items.begin(), items.end(),
                    [](const PaperItem& item) { return item.group == "plots"; }))
        require_gnuplot(interrupt.token());
}

int figures(const FiguresOptions& options, const Interrupt& interrupt) {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<PaperItem> items = choose_paper_items(options.only);
    prepare(options, items, interrupt);
    std::size_t made = 0, files = 0;
    for (const PaperItem& item : items) files += item.files.size();
    make_paper(items, options.folder, options.common.existing(), interrupt.token(),
               [&](const std::string& file) {
                   interrupt.reached(fmt::format("after {} of {} files", ++made, files));
                   if (!options.common.quiet) say("carom: {}\n", file);
               });
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    if (!options.common.quiet) say("carom: {} files in {:.1f} s\n", made, wall.count());
    return kExitDone;
}

}  // namespace

void add_figures_command(CLI::App& app, Run& run, const Interrupt& interrupt) {
    auto* command = app.add_subcommand("figures", "Make the paper's figures and tables again");
    auto options = std::make_shared<FiguresOptions>();
    command->footer(
        "  carom figures -o out/paper\n  carom figures -o out/paper --only figure7,tables\n");
    command->add_option("-o,--output", options->folder, "Folder for the files, made if need be")
        ->required()
        ->type_name("DIR");
    command
        ->add_option("--only", options->only,
                     "Some of them: plots, tables, pictures, films, or names such as figure7, "
                     "table2 (default: all)")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->take_all()
        ->allow_extra_args(false);
    command->add_flag("-y,--overwrite", options->common.overwrite, "Replace files that exist");
    add_backend_option(*command);
    command->add_flag("-q,--quiet", options->common.quiet, "Errors only");
    add_time_limit_option(*command, interrupt);
    command->callback([options, &run, &interrupt] {
        run = [options, &interrupt] { return figures(*options, interrupt); };
    });
}

}  // namespace carom
