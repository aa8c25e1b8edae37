// One function per command: adds itself to the program and says how to run.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace carom {

class Interrupt;

/// Returns the exit code.
using Run = std::function<int()>;

/// Each adds its command to `app` and sets `run` when the command line names it.
void add_render_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_still_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_simulate_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_check_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_compare_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_golden_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_accuracy_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_report_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_view_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_sweep_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_join_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_figures_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_fit_command(CLI::App& app, Run& run, const Interrupt& interrupt);
void add_new_command(CLI::App& app, Run& run);
void add_help_command(CLI::App& app, Run& run);
void add_completion_command(CLI::App& app, Run& run);
void add_schema_command(CLI::App& app, Run& run);
void add_info_command(CLI::App& app, Run& run);

}  // namespace carom
