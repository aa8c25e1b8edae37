#include "cli/interrupt.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "cli/exit_codes.h"
#include "cli/standard_error.h"
#include "core/temporaries.h"

namespace carom {

namespace {

/// What ends a process and comes from outside. SIGQUIT is for those who want the core.
constexpr int kSignals[] = {SIGINT,  SIGTERM, SIGHUP,    SIGXCPU, SIGUSR1,
                            SIGUSR2, SIGALRM, SIGVTALRM, SIGPWR};

/// Work has so long to see the request. The promise is half a second; the rest is for the process
/// to go, which takes a tenth of a second for each gigabyte.
constexpr std::chrono::milliseconds kGrace{150};

/// For a lock that a thread holds which is in the middle of an allocation.
constexpr std::chrono::milliseconds kMostWaiting{20};

/// Ours, to wake the waiting thread: at the end, and when there is a new time limit.
int wake_signal() { return SIGRTMIN; }

extern "C" void carom_end_at_once(int signal) {
    write_standard_error_at_once("carom: interrupted\n");
    temporaries::remove_for_good();
    _exit(kExitSignalBase + signal);
}

extern "C" void carom_end_at_limit(int) {
    write_standard_error_at_once("carom: ended by --time-limit\n");
    temporaries::remove_for_good();
    _exit(kExitFailed);
}

}  // namespace

Interrupt::Interrupt() {
    sigemptyset(&watched_);
    sigaddset(&watched_, wake_signal());
    for (const int signal : kSignals) {
        struct sigaction inherited {};
        sigaction(signal, nullptr, &inherited);
        if (inherited.sa_handler != SIG_IGN) sigaddset(&watched_, signal);
    }
    pthread_sigmask(SIG_BLOCK, &watched_, nullptr);
    try {
        thread_ = std::thread([this] { watch(); });
    } catch (const std::system_error&) {
        for (const int signal : kSignals)
            if (sigismember(&watched_, signal) == 1) std::signal(signal, carom_end_at_once);
        pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
    }
}

Interrupt::~Interrupt() {
    if (!thread_.joinable()) return;
    ending_ = true;
    pthread_kill(thread_.native_handle(), wake_signal());
    thread_.join();
}

void Interrupt::check() const {
    if (requested()) throw Interrupted{};
}

int Interrupt::exit_code() const { return timed_out_ ? kExitFailed : kExitSignalBase + signal_; }

void Interrupt::end_after(double seconds) const {
    constexpr double kMost_s = 1e9;  // 30 years; counts of nanoseconds end at 300
    const double bounded = std::clamp(seconds, 0.0, kMost_s);
    limit_s_ = seconds;
    limit_ = (Clock::now() +
              std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(bounded)))
                 .time_since_epoch()
                 .count();
    if (thread_.joinable()) {
        pthread_kill(const_cast<std::thread&>(thread_).native_handle(), wake_signal());
        return;
    }
    std::signal(SIGALRM, carom_end_at_limit);
    const double whole = std::floor(bounded);
    const itimerval timer{
        {}, {static_cast<time_t>(whole), static_cast<suseconds_t>(1e6 * (bounded - whole)) + 1}};
    ::setitimer(ITIMER_REAL, &timer, nullptr);
}

void Interrupt::reached(std::string words) const {
    const std::lock_guard lock(where_mutex_);
    where_ = std::move(words);
}

std::string Interrupt::text() const noexcept {
    try {
        const std::unique_lock lock(where_mutex_, kMostWaiting);
        const bool known = lock.owns_lock() && !where_.empty();
        // On a terminal there may be a bar of progress, and "^C".
        const std::string why =
            timed_out_ ? fmt::format("ended by --time-limit {}", limit_s_.load()) : "interrupted";
        return fmt::format("{}carom: {}{}{}\n", ::isatty(STDERR_FILENO) != 0 ? "\n" : "", why,
                           known ? " " : "", known ? where_ : "");
    } catch (...) {  // no memory for words
        return "interrupted\n";
    }
}

void Interrupt::say() const {
    if (!said_.exchange(true)) write_standard_error(text());
}

/// 0: the time is up.
int Interrupt::next_signal(Clock::time_point until) const {
    constexpr std::chrono::nanoseconds kSecond = std::chrono::seconds(1);
    if (until == Clock::time_point::max()) {
        int received = 0;
        sigwait(&watched_, &received);
        return received;
    }
    const std::chrono::nanoseconds left =
        std::max<std::chrono::nanoseconds>(std::chrono::nanoseconds(0), until - Clock::now());
    const timespec wait{left / kSecond, (left % kSecond).count()};
    const int received = sigtimedwait(&watched_, nullptr, &wait);
    return received > 0 ? received : 0;
}

void Interrupt::request_stop(int signal) {
    signal_ = signal;
    timed_out_ = signal == 0;
    stop_.request_stop();
}

void Interrupt::watch() {
    Clock::time_point grace = Clock::time_point::max();  // when work is left that does not see it
    while (true) {
        const bool stopping = stop_.stop_requested();
        const int received = next_signal(stopping ? grace : limit());
        if (received == wake_signal()) {
            if (ending_) return;
        } else if (!stopping && (received != 0 || Clock::now() >= limit())) {
            request_stop(received);
            grace = Clock::now() + kGrace;
        } else if (stopping && received != 0) {
            signal_ = received;
            end_now(kExitSignalBase + received);
        } else if (stopping && Clock::now() >= grace) {
            leave_work();
            grace = Clock::time_point::max();
        }
    }
}

void Interrupt::leave_work() {
    const std::lock_guard lock(keep_mutex_);
    if (!keep_ || timed_out_) end_now(exit_code());
    keep_();
}

void Interrupt::end_now(int exit_code) const {
    if (!said_.exchange(true)) write_standard_error_at_once(text());
    temporaries::remove_for_good();
    _exit(exit_code);
}

}  // namespace carom
