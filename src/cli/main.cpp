// The program: parses the command line, runs one command, and turns what went wrong into exit
// codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/process_start.h"
#include "cli/standard_error.h"
#include "cli/standard_output.h"
#include "core/check.h"
#include "core/failure.h"
#include "core/readable.h"

namespace carom {

namespace {

constexpr const char* kExamples =
    "  carom new ball\n"
    "  carom render scenes/figure9.yaml -o out/figure9.mp4\n"
    "  carom still scenes/figure8.yaml --time 1.2 -o out/figure8.png\n"
    "  carom simulate scenes/figure8.yaml -o motion.csv --events events.csv\n"
    "  carom check scenes/*.yaml\n"
    "  carom help render\n";

/// What `carom` alone says.
constexpr const char* kFirstSteps =
    "carom films bouncing balls from a text file. Three commands to begin with:\n\n"
    "  carom new ball                      writes ball.yaml, a scene with comments\n"
    "  carom render ball.yaml -o ball.mp4  films it\n"
    "  carom help                          names all commands; carom help render, all options of "
    "one\n";

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

/// `carom help COMMAND` and `carom version` are `carom COMMAND --help` and `carom --version`.
std::vector<std::string> arguments_of(int argc, char** argv) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (words.empty()) return words;
    const bool has_options = words.size() > 1 && words[1].starts_with("-");
    if (words.front() == "help" && !has_options) {
        words.erase(words.begin());
        words.emplace_back("--help");
    } else if (words.front() == "version") {
        words.front() = "--version";
    }
    return words;
}

/// Text that was asked for.
int print(const std::string& text) {
    try {
        write_standard_output(text);
    } catch (const ReaderGone&) {
        return kExitDone;
    } catch (const Failure& failure) {
        say("carom: {}\n", readable_message(failure.what()));
        return exit_code_of(failure);
    }
    return kExitDone;
}

/// Of the exception in flight; says what went wrong.
int exit_code_of_exception() {
    try {
        throw;
    } catch (const Failure& failure) {
        say("carom: {}\n", readable_message(failure.what()));
        return exit_code_of(failure);
    } catch (const Bug& bug) {
        say("carom: {}\nThis is a bug in carom.\n", readable_message(bug.what()));
    } catch (const std::bad_alloc&) {
        write_standard_error("carom: out of memory\n");
    } catch (const std::exception& error) {
        say("carom: {}\n", readable_message(error.what()));
    }
    return kExitFailed;
}

int run_program(int argc, char** argv) {
    let_writing_fail();
    share_the_heap_where_it_is_limited();
    quiet_libraries();
    const Interrupt interrupt;

    CLI::App app("Physically exact films of bouncing balls, from a text file, with no display.",
                 "carom");
    set_up_help(app);
    app.set_version_flag("--version", "carom " CAROM_VERSION, "Print the version");
    app.require_subcommand(1);
    Run run;
    add_new_command(app, run);
    add_render_command(app, run, interrupt);
    add_still_command(app, run, interrupt);
    add_simulate_command(app, run, interrupt);
    add_check_command(app, run, interrupt);
    add_report_command(app, run, interrupt);
    add_view_command(app, run, interrupt);
    add_sweep_command(app, run, interrupt);
    add_join_command(app, run, interrupt);
    add_compare_command(app, run, interrupt);
    add_golden_command(app, run, interrupt);
    add_accuracy_command(app, run, interrupt);
    add_figures_command(app, run, interrupt);
    add_fit_command(app, run, interrupt);
    add_schema_command(app, run);
    add_info_command(app, run);
    add_completion_command(app, run);
    add_help_command(app, run);

    app.footer(kExamples);

    std::vector<std::string> words = arguments_of(argc, argv);
    if (words.empty()) {
        write_standard_error(kFirstSteps);
        return kExitUsage;
    }
    const std::string first = words.front();
    try {
        std::reverse(words.begin(), words.end());  // as CLI11 takes them
        app.parse(words);
    } catch (const CLI::CallForHelp&) {
        return print(help_text(app));
    } catch (const CLI::CallForVersion& version) {
        return print(fmt::format("{}\n", version.what()));
    } catch (const CLI::ParseError& error) {
        say("carom: {}\nRun with --help for more information.\n",
            readable_message(usage_error(app, error.what(), first)));
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
