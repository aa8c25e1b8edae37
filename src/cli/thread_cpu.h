// CPU seconds of the calling thread, for --stats.
#pragma once

#include <ctime>

namespace carom {

inline double thread_cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Adds the time from construction to destruction to `total`.
class CpuTimer {
  public:
    explicit CpuTimer(double& total) : total_(total), start_(thread_cpu_s()) {}
    ~CpuTimer() { total_ += thread_cpu_s() - start_; }
    CpuTimer(const CpuTimer&) = delete;
    CpuTimer& operator=(const CpuTimer&) = delete;

  private:
    double& total_;
    double start_;
};

}  // namespace carom
