// carom help, carom completion: what is made from the parser's own tables.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command_table.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/exit_codes.h"
#include "cli/man_page.h"
#include "cli/standard_output.h"

namespace carom {

void add_help_command(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("help", "Print the help of a command, or all of it");
    command->footer(
        "  carom help render\n"
        "  carom help --man > carom.1\n");
    struct Options {
        bool man = false, json = false;
    };
    auto options = std::make_shared<Options>();
    command->add_flag("--man", options->man, "Print the manual page, for man");
    command
        ->add_flag("--json", options->json, "Print all commands and options as JSON, for programs")
        ->excludes("--man");
    command->callback([options, &app, &run] {
        run = [options, &app] {
            const std::vector<CommandRow> table = command_table(app);
            write_standard_output(options->json
                                      ? command_table_json(table)
                                      : man_page(table, CAROM_VERSION, CAROM_RELEASE_DATE));
            return int{kExitDone};
        };
    });
}

void add_completion_command(CLI::App& app, Run& run) {
    auto* command =
        app.add_subcommand("completion", "Print what makes a shell complete commands and options");
    command->footer(
        "  source <(carom completion bash)\n"
        "  carom completion zsh > ~/.zfunc/_carom\n"
        "  carom completion fish > ~/.config/fish/completions/carom.fish\n");
    auto shell = std::make_shared<std::string>();
    command->add_option("shell", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}))
        ->type_name("bash|zsh|fish");
    command->callback([shell, &app, &run] {
        run = [shell, &app] {
            const std::vector<CommandRow> table = command_table(app);
            write_standard_output(*shell == "bash"  ? bash_completion(table)
                                  : *shell == "zsh" ? zsh_completion(table)
                                                    : fish_completion(table));
            return int{kExitDone};
        };
    });
}

}  // namespace carom
