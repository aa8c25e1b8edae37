// SIGINT and SIGTERM as a stop request that the work can see, so that files are closed properly.
#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace carom {

/// Make one at the start of main, before any other thread: it blocks both signals for all threads
/// and waits for them on its own. The first signal requests a stop; a second one ends the program
/// at once.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    std::stop_token token() const { return stop_.get_token(); }
    bool requested() const { return stop_.stop_requested(); }
    /// 130 or 143 after the signal, for main's return.
    int exit_code() const;

  private:
    void wait();

    std::stop_source stop_;
    std::atomic<int> signal_ = 0;
    std::atomic<bool> ending_ = false;
    std::thread thread_;
};

}  // namespace carom
