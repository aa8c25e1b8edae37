// gnuplot as a program.
#pragma once

#include <stop_token>
#include <string>

namespace carom {

/// Runs one script from start to end, without the user's own settings, in the locale C and in UTC.
/// Throws Failure(kRun): gnuplot is missing, or `attempt` ("drawing figure4.svg") failed, with its
/// text; or `stop` was requested, which ends gnuplot and all that it has started. Failure(kOutput)
/// where it may not write so much (ulimit -f).
void run_gnuplot(const std::string& script, const std::string& attempt,
                 const std::stop_token& stop = {});

/// "5.4.4"; throws Failure(kRun) as run_gnuplot() does.
std::string gnuplot_version();

}  // namespace carom
