#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace carom {

namespace {

constexpr double kBarInterval_s = 0.1;
constexpr double kPlainInterval_s = 5.0;
constexpr int kBarCells = 30;

}  // namespace

std::string format_duration(double seconds) {
    const auto whole = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
    const std::int64_t h = whole / 3600, m = whole / 60 % 60, s = whole % 60;
    return h > 0 ? fmt::format("{}:{:02}:{:02}", h, m, s) : fmt::format("{}:{:02}", m, s);
}

Progress::Progress(ProgressMode mode, std::string what, std::int64_t total)
    : mode_(mode), what_(std::move(what)), total_(total) {
    if (mode_ == ProgressMode::kAuto)
        mode_ = isatty(STDERR_FILENO) != 0 ? ProgressMode::kBar : ProgressMode::kPlain;
}

Progress::~Progress() {
    if (bar_on_screen_) fmt::print(stderr, "\r\033[K");
}

double Progress::elapsed_s() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::update(std::int64_t done) {
    if (mode_ == ProgressMode::kNone) return;
    const bool bar = mode_ == ProgressMode::kBar;
    const double since_shown = std::chrono::duration<double>(Clock::now() - shown_).count();
    if (since_shown < (bar ? kBarInterval_s : kPlainInterval_s)) return;
    shown_ = Clock::now();

    const double elapsed = elapsed_s();
    const double rate = static_cast<double>(done) / elapsed;
    const double left = rate > 0 ? static_cast<double>(total_ - done) / rate : 0;
    const std::string numbers = fmt::format("{}/{} {}, {:.1f}/s, {} left", done, total_, what_,
                                            rate, format_duration(left));
    if (!bar) {
        fmt::print(stderr, "{}\n", numbers);
        return;
    }
    const auto filled = static_cast<int>(done * kBarCells / std::max<std::int64_t>(1, total_));
    fmt::print(stderr, "\r\033[K[{}{}] {}", std::string(static_cast<std::size_t>(filled), '='),
               std::string(static_cast<std::size_t>(kBarCells - filled), ' '), numbers);
    std::fflush(stderr);
    bar_on_screen_ = true;
}

}  // namespace carom
