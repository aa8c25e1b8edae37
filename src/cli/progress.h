// Progress on standard error: a bar on a terminal, a plain line every few seconds otherwise.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace carom {

enum class ProgressMode { kAuto, kBar, kPlain, kNone };

class Progress {
  public:
    /// `what` is a word such as "frames"; `total` their number.
    Progress(ProgressMode mode, std::string what, std::int64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(std::int64_t done);
    double elapsed_s() const;

  private:
    using Clock = std::chrono::steady_clock;

    ProgressMode mode_;
    std::string what_;
    std::int64_t total_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point shown_ = start_;
    bool bar_on_screen_ = false;
};

/// "1:05" for 65 s, "2:00:00" for two hours.
std::string format_duration(double seconds);

}  // namespace carom
