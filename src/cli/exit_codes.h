// Exit codes of the program, as docs/commands.md lists them.
#pragma once

namespace carom {

enum ExitCode : int {
    kExitDone = 0,
    kExitFailed = 1,  ///< failed while running
    kExitUsage = 2,   ///< wrong usage, or an input file that is missing or unreadable
    kExitInvalidScene = 3,
    kExitOutput = 4,        ///< output could not be written, or exists and -y was not given
    kExitDifferent = 5,     ///< compare or golden found a difference, or no golden
    kExitSignalBase = 128,  ///< + the signal's number
};

}  // namespace carom
