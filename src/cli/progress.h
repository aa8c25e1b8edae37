// Progress on standard error: a bar on a terminal, a plain line every few seconds otherwise, or
// JSON for programs; and how far the work was, for an interrupt.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace carom {

class Interrupt;

enum class ProgressMode { kAuto, kBar, kPlain, kNone, kJson };

/// What is being done.
struct ProgressWork {
    const char* stage;  ///< for programs
    const char* unit;   ///< of its numbers, for programs
    const char* words;  ///< for people, behind the numbers
};
inline constexpr ProgressWork kSimulating = {"simulate", "s", "s simulated"};
inline constexpr ProgressWork kSimulatingOther = {"simulate_other", "s",
                                                  "s of the other run simulated"};
inline constexpr ProgressWork kFilming = {"film", "frames", "frames"};
inline constexpr ProgressWork kWritingRows = {"write", "s", "s written"};
inline constexpr ProgressWork kSweeping = {"sweep", "runs", "runs"};
inline constexpr ProgressWork kJoining = {"join", "frames", "frames joined"};

class Progress {
  public:
    /// `total` is where the numbers end, if that is known. Whole numbers are shown as such when it
    /// is an integer; `unit_s` are then the seconds of film that one is worth, 0 for none.
    Progress(ProgressMode mode, const Interrupt& interrupt, const ProgressWork& work,
             std::int64_t total, double unit_s = 0);
    Progress(ProgressMode mode, const Interrupt& interrupt, const ProgressWork& work,
             std::optional<double> total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(double done);
    double elapsed_s() const;

  private:
    using Clock = std::chrono::steady_clock;
    struct Sample {
        Clock::time_point when;
        double done;
    };

    void show(Clock::time_point now);
    void note_sample(Clock::time_point now);
    double rate(Clock::time_point now) const;
    std::optional<double> left_s(double rate) const;
    std::string so_far(double done, const char* of) const;
    std::string line(Clock::time_point now) const;
    std::string bar(Clock::time_point now) const;
    std::string json(Clock::time_point now) const;

    ProgressMode mode_;
    const Interrupt& interrupt_;
    ProgressWork work_;
    std::optional<double> total_;
    double unit_s_ = 0;
    int decimals_ = 0;
    Clock::time_point start_ = Clock::now();
    Clock::time_point shown_ = start_;
    Clock::time_point noted_ = start_;
    Sample older_{start_, 0}, newer_{start_, 0};  ///< what the rate is measured from, and next
    double done_ = 0;
    bool bar_on_screen_ = false;
};

/// "1:05" for 65 s, "2:00:00" for two hours.
std::string format_duration(double seconds);

}  // namespace carom
