#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "cli/interrupt.h"
#include "cli/standard_error.h"
#include "cli/terminal.h"

namespace carom {

namespace {

constexpr double kBarInterval_s = 0.1;
constexpr double kPlainInterval_s = 5.0;
constexpr double kNoteInterval_s = 0.02;  ///< nothing against half a second; updates are many
constexpr int kBarCells = 30;
constexpr int kFewestCells = 5;  ///< a shorter bar says nothing

/// A thousandth of the whole is shown.
int decimals_for(double total) {
    constexpr double kFinest = 9;
    if (!(total > 0)) return 0;
    return static_cast<int>(std::clamp(3 - std::ceil(std::log10(total)), 0.0, kFinest));
}

ProgressMode settled(ProgressMode mode) {
    if (mode == ProgressMode::kNone || mode == ProgressMode::kPlain || is_dumb_terminal())
        return mode == ProgressMode::kNone ? mode : ProgressMode::kPlain;
    if (mode == ProgressMode::kBar || ::isatty(STDERR_FILENO) != 0) return ProgressMode::kBar;
    return ProgressMode::kPlain;
}

}  // namespace

std::string format_duration(double seconds) {
    constexpr double kMost = 1e15;  // so that it can be rounded
    const auto whole = static_cast<std::int64_t>(std::llround(std::clamp(seconds, 0.0, kMost)));
    const std::int64_t h = whole / 3600, m = whole / 60 % 60, s = whole % 60;
    return h > 0 ? fmt::format("{}:{:02}:{:02}", h, m, s) : fmt::format("{}:{:02}", m, s);
}

Progress::Progress(ProgressMode mode, const Interrupt& interrupt, std::string what,
                   std::int64_t total)
    : mode_(settled(mode)),
      interrupt_(interrupt),
      what_(std::move(what)),
      total_(static_cast<double>(total)) {}

Progress::Progress(ProgressMode mode, const Interrupt& interrupt, std::string what,
                   std::optional<double> total)
    : mode_(settled(mode)),
      interrupt_(interrupt),
      what_(std::move(what)),
      total_(total),
      decimals_(total ? decimals_for(*total) : 3) {}

Progress::~Progress() {
    if (bar_on_screen_) write_standard_error("\r\033[K");
    try {
        interrupt_.reached("after " + so_far(done_, " of "));
    } catch (const std::bad_alloc&) {
        // It may be on the way out for want of memory.
    }
}

double Progress::elapsed_s() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string Progress::so_far(double done, const char* of) const {
    std::string text = fmt::format("{:.{}f}", done, decimals_);
    if (total_) text += fmt::format("{}{:.{}f}", of, *total_, decimals_);
    return text + " " + what_;
}

std::string Progress::line(double done) const {
    const double rate = done / elapsed_s();
    std::string text = so_far(done, "/") + fmt::format(", {:.1f}/s", rate);
    if (total_ && rate > 0) text += ", " + format_duration((*total_ - done) / rate) + " left";
    return text;
}

/// Fits the terminal as it is now, so that it can be written over: the last column stays empty.
std::string Progress::bar(double done) const {
    std::string text = line(done);
    const int room = std::max(1, terminal_columns(STDERR_FILENO) - 1);
    const int cells = std::min(kBarCells, room - static_cast<int>(text.size()) - 3);
    if (total_ && cells >= kFewestCells) {
        const double part = *total_ > 0 ? std::clamp(done / *total_, 0.0, 1.0) : 1;
        std::string bar(static_cast<std::size_t>(cells), ' ');
        std::fill_n(bar.begin(), static_cast<std::ptrdiff_t>(part * cells), '=');
        text = "[" + bar + "] " + text;
    }
    return text.substr(0, static_cast<std::size_t>(room));
}

void Progress::update(double done) {
    done_ = done;
    const Clock::time_point now = Clock::now();
    const auto since = [now](Clock::time_point then) {
        return std::chrono::duration<double>(now - then).count();
    };
    if (since(noted_) >= kNoteInterval_s) {
        noted_ = now;
        interrupt_.reached("after " + so_far(done, " of "));
    }
    if (mode_ == ProgressMode::kNone) return;
    const bool on_a_line = mode_ == ProgressMode::kPlain;
    if (since(shown_) < (on_a_line ? kPlainInterval_s : kBarInterval_s)) return;
    shown_ = now;
    if (on_a_line) {
        say("{}\n", line(done));
        return;
    }
    say("\r\033[K{}", bar(done));
    bar_on_screen_ = true;
}

}  // namespace carom
