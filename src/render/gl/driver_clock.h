// Processor time of drawing, for --stats.
#pragma once

#include <vector>

namespace carom {

/// CPU seconds of the calling thread.
double thread_cpu_s();

/// CPU seconds of the calling thread plus those of the rasteriser threads that the software driver
/// keeps inside this process (llvmpipe names them "llvmpipe-0", "llvmpipe-1", ...). They are shared
/// by all contexts of a process, so two painters that draw at once count each other's time.
/// Work that was handed to the driver is only counted when it is done: call glFinish first.
class DriverClock {
  public:
    /// Looks for the threads once: make it after the context. Without /proc it finds none.
    DriverClock();
    double now_s() const;

  private:
    std::vector<int> threads_;  ///< kernel ids
};

}  // namespace carom
