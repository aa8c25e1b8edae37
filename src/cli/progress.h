// Progress on standard error: a bar on a terminal, a plain line every few seconds otherwise; and
// how far the work was, for an interrupt.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace carom {

class Interrupt;

enum class ProgressMode { kAuto, kBar, kPlain, kNone };

class Progress {
  public:
    /// `what` follows the numbers, such as "frames" or "s simulated"; `total` is their end, if it
    /// is known. Whole numbers are shown as such when `total` is an integer.
    Progress(ProgressMode mode, const Interrupt& interrupt, std::string what, std::int64_t total);
    Progress(ProgressMode mode, const Interrupt& interrupt, std::string what,
             std::optional<double> total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(double done);
    double elapsed_s() const;

  private:
    using Clock = std::chrono::steady_clock;

    std::string so_far(double done, const char* of) const;
    std::string line(double done) const;
    std::string bar(double done) const;

    ProgressMode mode_;
    const Interrupt& interrupt_;
    std::string what_;
    std::optional<double> total_;
    int decimals_ = 0;
    Clock::time_point start_ = Clock::now();
    Clock::time_point shown_ = start_;
    Clock::time_point noted_ = start_;
    double done_ = 0;
    bool bar_on_screen_ = false;
};

/// "1:05" for 65 s, "2:00:00" for two hours.
std::string format_duration(double seconds);

}  // namespace carom
