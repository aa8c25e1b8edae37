// CPU time.
#pragma once

#include <ctime>

namespace carom::bench {

/// CPU seconds of this thread; every engine here works in the thread that calls it. (The clock of
/// the process goes by the kernel's ticks while a timer of the process is set.)
inline double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace carom::bench
