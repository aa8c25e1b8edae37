// Signals that end a program, and its time limit, as a stop request that the work can see, so that
// files are closed properly; and an end soon after where the work does not see it.
#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace carom {

/// Leaves the work after a stop request; main ends with Interrupt::exit_code().
struct Interrupted {};

/// SIGINT, SIGTERM, SIGHUP, SIGXCPU and the others that end a program from outside, but those that
/// the parent lets it ignore (as nohup does).
///
/// The first one requests a stop. Work that has not ended kGrace later, be it in a driver, in a
/// library or waiting for a reader, is left where it is: the process says how far it got, removes
/// its temporary files and ends with 128 and the signal's number. So it does at once at the second
/// signal. What is worth more time is for KeptWork.
///
/// A time limit that is over is as a first signal, but that nothing is worth more time.
///
/// Make one at the start of main, before any other thread: it blocks the signals for all threads
/// and waits for them on its own. Where no thread can be made, the first signal is as the second.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    std::stop_token token() const { return stop_.get_token(); }
    bool requested() const { return stop_.stop_requested(); }
    /// Throws Interrupted after a request.
    void check() const;
    /// 128 and the signal's number, kExitFailed after the time limit; for main's return.
    int exit_code() const;

    /// Requests a stop when so many seconds from now have passed; once, or the last one counts.
    void end_after(double seconds) const;
    /// True where the stop was requested because the time is up.
    bool timed_out() const { return timed_out_; }

    /// How far the work is, after the word "interrupted": "after 3 of 20 files". Safe from any
    /// thread, as what follows.
    void reached(std::string words) const;
    /// Says that the work was interrupted, and where; once.
    void say() const;

  private:
    friend class KeptWork;

    using Clock = std::chrono::steady_clock;

    void watch();
    void request_stop(int signal);
    int next_signal(Clock::time_point until) const;
    Clock::time_point limit() const { return Clock::time_point(Clock::duration(limit_.load())); }
    void leave_work();
    [[noreturn]] void end_now(int exit_code) const;
    std::string text() const noexcept;

    sigset_t watched_{};
    std::stop_source stop_;
    std::atomic<int> signal_ = 0;
    std::atomic<bool> timed_out_ = false;
    std::atomic<bool> ending_ = false;
    mutable std::atomic<Clock::rep> limit_ = Clock::time_point::max().time_since_epoch().count();
    mutable std::atomic<double> limit_s_ = 0;  ///< the same as it was asked for
    mutable std::atomic<bool> said_ = false;
    mutable std::timed_mutex where_mutex_;
    mutable std::string where_;
    mutable std::mutex keep_mutex_;
    mutable std::function<void()> keep_;  ///< KeptWork's, in the place of an end
    std::thread thread_;                  ///< last: it uses all of the above
};

}  // namespace carom
