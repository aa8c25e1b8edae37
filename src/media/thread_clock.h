// Processor time of threads, for --stats.
#pragma once

#include <ctime>
#include <string>
#include <vector>

namespace carom {

/// CPU seconds of the calling thread since it started.
double calling_thread_cpu_s();

/// CPU seconds of threads that a library starts inside itself.
///
/// Linux gives a new thread the name of its parent. So: name the calling thread, let the library
/// start its threads, take back the name, and find in /proc/self/task the threads that carry it.
/// Without /proc it finds none and total_s() is 0.
class ForeignThreads {
  public:
    ForeignThreads() = default;

    /// Calls `start` and remembers the threads that came into being in it. `name` has at most 15
    /// characters and also tells the threads apart in top and in debuggers.
    template <class Start>
    void watch(const std::string& name, const Start& start) {
        const Naming naming(name);
        start();
        find(name);
    }

    /// The sum over the threads. One that has ended counts 0, so ask before the library ends them.
    double total_s() const;
    std::size_t count() const { return clocks_.size(); }

  private:
    /// Gives the calling thread a name for as long as it lives.
    class Naming {
      public:
        explicit Naming(const std::string& name);
        ~Naming();
        Naming(const Naming&) = delete;
        Naming& operator=(const Naming&) = delete;

      private:
        std::string before_;
    };
    void find(const std::string& name);

    std::vector<clockid_t> clocks_;
};

}  // namespace carom
