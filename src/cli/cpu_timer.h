// CPU seconds of the calling thread, for --stats.
#pragma once

#include "media/thread_clock.h"

namespace carom {

/// Adds the time from construction to destruction to `total`.
class CpuTimer {
  public:
    explicit CpuTimer(double& total) : total_(total), start_(calling_thread_cpu_s()) {}
    ~CpuTimer() { total_ += calling_thread_cpu_s() - start_; }
    CpuTimer(const CpuTimer&) = delete;
    CpuTimer& operator=(const CpuTimer&) = delete;

  private:
    double& total_;
    double start_;
};

}  // namespace carom
