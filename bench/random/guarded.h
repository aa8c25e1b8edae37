// Work that may hang or crash, done in a child process.
#pragma once

#include <functional>
#include <string>

namespace carom::bench {

/// What became of a trial. `symptom` is the same for failures of a kind ("" where all holds);
/// `detail` has names and numbers.
struct Verdict {
    std::string symptom, detail;
    double value = 0;  ///< what the symptom is about: rise, depth, difference, CPU seconds
    double time = 0;   ///< s of the motion
    // What was measured where nothing failed.
    double cpu_per_s = 0, energy_rise = 0, depth = 0, momentum_error = 0, difference = 0;
    bool stepped = false, integrated = false;
    bool skipped = false;  ///< the scene is refused by the reader, or says nothing
};

/// The child's side: what it is at, and how long it may.
class Watch {
  public:
    /// A phase that may take `cpu_s` of CPU from now on; beyond that the child is ended.
    void begin(const char* phase, double cpu_s);
    void reached(double time);  ///< s of the motion

    struct Page;
    explicit Watch(Page& page) : page_(page) {}

  private:
    Page& page_;
};

/// Runs `work` in a child. A crash, a hang and an exception become symptoms.
Verdict run_guarded(const std::function<Verdict(Watch&)>& work);

}  // namespace carom::bench
