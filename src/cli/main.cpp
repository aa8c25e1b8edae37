// The program: parses the command line, runs one command, and turns what went wrong into exit
// codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/process_start.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "core/check.h"
#include "core/diagnostics.h"
#include "core/failure.h"

namespace carom {

namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  carom render scenes/figure9.yaml -o out/figure9.mp4\n"
    "  carom still scenes/figure8.yaml --time 1.2 -o out/figure8.png\n"
    "  carom simulate scenes/figure8.yaml -o motion.csv --events events.csv\n"
    "  carom check scenes/*.yaml\n";

int exit_code_of(const Failure& failure) {
    switch (failure.kind()) {
        case FailureKind::kRun:
            return kExitFailed;
        case FailureKind::kInput:
            return kExitUsage;
        case FailureKind::kOutput:
            return kExitOutput;
    }
    return kExitFailed;
}

/// For a word that is no command, the command that was probably meant.
std::string suggestion(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    if (argc < 2) return {};
    for (const std::string& name : names)
        if (name == argv[1]) return {};
    const std::string nearest = nearest_word(argv[1], names);
    return nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest);
}

/// Of the exception in flight; says what went wrong.
int exit_code_of_exception() {
    try {
        throw;
    } catch (const Failure& failure) {
        say("carom: {}\n", failure.what());
        return exit_code_of(failure);
    } catch (const Bug& bug) {
        say("carom: {}\nThis is a bug in carom.\n", bug.what());
    } catch (const std::bad_alloc&) {
        write_standard_error("carom: out of memory\n");
    } catch (const std::exception& error) {
        say("carom: {}\n", error.what());
    }
    return kExitFailed;
}

int run_program(int argc, char** argv) {
    let_writing_fail();
    share_the_heap_where_it_is_limited();
    const Interrupt interrupt;

    CLI::App app(
        "Physically exact films of bouncing balls, from a text file, with no display.\n\n" +
            std::string(kExamples),
        "carom");
    app.set_version_flag("--version", "carom " CAROM_VERSION);
    app.require_subcommand(1);
    Run run;
    add_render_command(app, run, interrupt);
    add_still_command(app, run, interrupt);
    add_simulate_command(app, run, interrupt);
    add_check_command(app, run, interrupt);
    add_compare_command(app, run, interrupt);
    add_golden_command(app, run, interrupt);
    add_accuracy_command(app, run, interrupt);
    add_figures_command(app, run, interrupt);
    add_fit_command(app, run, interrupt);
    add_schema_command(app, run);
    add_info_command(app, run);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        say("carom: {}{}\nRun with --help for more information.\n", error.what(),
            suggestion(app, argc, argv));
        return kExitUsage;
    }

    try {
        return run();
    } catch (const ReaderGone&) {
        return kExitDone;
    } catch (...) {
        if (!interrupt.requested()) return exit_code_of_exception();
        interrupt.say();
        return interrupt.exit_code();
    }
}

}  // namespace

}  // namespace carom

int main(int argc, char** argv) {
    carom::open_standard_descriptors();
    return carom::run_program(argc, argv);
}
