#include "render/gl/driver_clock.h"

#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace carom {

namespace {

double seconds(clockid_t clock) {
    timespec now{};
    if (clock_gettime(clock, &now) != 0) return 0;
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Linux: the CPU clock of a thread by its kernel id (bits as in the kernel's posix-timers.h:
/// complement of the id, then "per thread" and "scheduler time").
clockid_t clock_of(int thread) {
    return static_cast<clockid_t>((~static_cast<unsigned>(thread) << 3) | 6u);
}

}  // namespace

double thread_cpu_s() { return seconds(CLOCK_THREAD_CPUTIME_ID); }

DriverClock::DriverClock() {
    std::error_code error;
    for (std::filesystem::directory_iterator task("/proc/self/task", error), end;
         !error && task != end; task.increment(error)) {
        std::ifstream file(task->path() / "comm");
        std::string name;
        if (std::getline(file, name) && name.rfind("llvmpipe-", 0) == 0)
            threads_.push_back(std::stoi(task->path().filename().string()));
    }
}

double DriverClock::now_s() const {
    double sum = thread_cpu_s();
    for (const int thread : threads_) sum += seconds(clock_of(thread));
    return sum;
}

}  // namespace carom
