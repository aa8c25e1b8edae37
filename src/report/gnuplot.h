// gnuplot as a program.
#pragma once

#include <string>

namespace carom {

/// Runs one script from start to end, without the user's own settings, in the locale C and in UTC.
/// Throws Failure(kRun): gnuplot is missing, or `attempt` ("drawing figure4.svg") failed, with its
/// text.
void run_gnuplot(const std::string& script, const std::string& attempt);

}  // namespace carom
