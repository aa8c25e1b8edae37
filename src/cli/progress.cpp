#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <nlohmann/json.hpp>

#include "cli/interrupt.h"
#include "cli/standard_error.h"
#include "cli/terminal.h"

namespace carom {

namespace {

constexpr double kBarInterval_s = 0.1;
constexpr double kPlainInterval_s = 5.0;
constexpr double kJsonInterval_s = 0.5;
constexpr double kRateWindow_s = 5.0;     ///< the rate is that of the last one or two of these
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
    if (mode == ProgressMode::kNone || mode == ProgressMode::kJson) return mode;
    if (mode == ProgressMode::kPlain || is_dumb_terminal()) return ProgressMode::kPlain;
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

Progress::Progress(ProgressMode mode, const Interrupt& interrupt, const ProgressWork& work,
                   std::int64_t total, double unit_s)
    : mode_(settled(mode)),
      interrupt_(interrupt),
      work_(work),
      total_(static_cast<double>(total)),
      unit_s_(unit_s) {}

Progress::Progress(ProgressMode mode, const Interrupt& interrupt, const ProgressWork& work,
                   std::optional<double> total)
    : mode_(settled(mode)),
      interrupt_(interrupt),
      work_(work),
      total_(total),
      decimals_(total ? decimals_for(*total) : 3) {}

Progress::~Progress() {
    if (bar_on_screen_) write_standard_error("\r\033[K");
    try {
        if (mode_ == ProgressMode::kJson) say("{}\n", json(Clock::now()));
        interrupt_.reached("after " + so_far(done_, " of "));
    } catch (const std::bad_alloc&) {
        // It may be on the way out for want of memory.
    }
}

double Progress::elapsed_s() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

/// Per second, of late: what has taken long before need not go on so.
double Progress::rate(Clock::time_point now) const {
    const double s = std::chrono::duration<double>(now - older_.when).count();
    return s > 0 ? (done_ - older_.done) / s : 0;
}

void Progress::note_sample(Clock::time_point now) {
    if (std::chrono::duration<double>(now - newer_.when).count() < kRateWindow_s) return;
    older_ = newer_;
    newer_ = {now, done_};
}

std::optional<double> Progress::left_s(double rate) const {
    if (!total_ || !(rate > 0)) return std::nullopt;
    return std::max(0.0, *total_ - done_) / rate;
}

std::string Progress::so_far(double done, const char* of) const {
    std::string text = fmt::format("{:.{}f}", done, decimals_);
    if (total_) text += fmt::format("{}{:.{}f}", of, *total_, decimals_);
    return text + " " + work_.words;
}

std::string Progress::line(Clock::time_point now) const {
    const double per_s = rate(now);
    std::string text = so_far(done_, "/");
    if (unit_s_ > 0 && total_)
        text += fmt::format(" ({:.1f}/{:.1f} s)", done_ * unit_s_, *total_ * unit_s_);
    text += fmt::format(", {:.1f}/s", per_s);
    if (const auto left = left_s(per_s)) text += ", " + format_duration(*left) + " left";
    return text;
}

/// Fits the terminal as it is now, so that it can be written over: the last column stays empty.
std::string Progress::bar(Clock::time_point now) const {
    std::string text = line(now);
    const int room = std::max(1, terminal_columns(STDERR_FILENO) - 1);
    const int cells = std::min(kBarCells, room - static_cast<int>(text.size()) - 3);
    if (total_ && cells >= kFewestCells) {
        const double part = *total_ > 0 ? std::clamp(done_ / *total_, 0.0, 1.0) : 1;
        std::string bar(static_cast<std::size_t>(cells), ' ');
        std::fill_n(bar.begin(), static_cast<std::ptrdiff_t>(part * cells), '=');
        text = "[" + bar + "] " + text;
    }
    return text.substr(0, static_cast<std::size_t>(room));
}

/// One object on one line; its keys are a promise (docs/commands.md).
std::string Progress::json(Clock::time_point now) const {
    const auto or_null = [](const std::optional<double>& value) {
        return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
    };
    const double per_s = rate(now);
    nlohmann::ordered_json json = {{"stage", work_.stage},
                                   {"done", done_},
                                   {"total", or_null(total_)},
                                   {"unit", work_.unit},
                                   {"rate", per_s},
                                   {"elapsed_s", elapsed_s()},
                                   {"left_s", or_null(left_s(per_s))}};
    if (unit_s_ > 0 && total_) {
        json["film_s"] = done_ * unit_s_;
        json["film_total_s"] = *total_ * unit_s_;
    }
    return json.dump();
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
    note_sample(now);
    const double interval = mode_ == ProgressMode::kPlain  ? kPlainInterval_s
                            : mode_ == ProgressMode::kJson ? kJsonInterval_s
                                                           : kBarInterval_s;
    if (since(shown_) >= interval) show(now);
}

void Progress::show(Clock::time_point now) {
    shown_ = now;
    if (mode_ == ProgressMode::kBar) {
        say("\r\033[K{}", bar(now));
        bar_on_screen_ = true;
    } else {
        say("{}\n", mode_ == ProgressMode::kJson ? json(now) : line(now));
    }
}

}  // namespace carom
