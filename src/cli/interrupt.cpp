#include "cli/interrupt.h"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <chrono>
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
constexpr timespec kGrace{0, 150'000'000};

/// For a lock that a thread holds which is in the middle of an allocation.
constexpr std::chrono::milliseconds kMostWaiting{20};

/// Ours, only to wake the waiting thread at the end.
int wake_signal() { return SIGRTMIN; }

extern "C" void carom_end_at_once(int signal) {
    write_standard_error_at_once("carom: interrupted\n");
    temporaries::remove_for_good();
    _exit(kExitSignalBase + signal);
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

int Interrupt::exit_code() const { return kExitSignalBase + signal_; }

void Interrupt::reached(std::string words) const {
    const std::lock_guard lock(where_mutex_);
    where_ = std::move(words);
}

std::string Interrupt::text() const noexcept {
    try {
        const std::unique_lock lock(where_mutex_, kMostWaiting);
        const bool known = lock.owns_lock() && !where_.empty();
        // On a terminal there may be a bar of progress, and "^C".
        return fmt::format("{}carom: interrupted{}{}\n", ::isatty(STDERR_FILENO) != 0 ? "\n" : "",
                           known ? " " : "", known ? where_ : "");
    } catch (...) {  // no memory for words
        return "interrupted\n";
    }
}

void Interrupt::say() const {
    if (!said_.exchange(true)) write_standard_error(text());
}

/// 0: the time is up.
int Interrupt::next_signal(bool may_end) {
    if (!may_end) {
        int received = 0;
        sigwait(&watched_, &received);
        return received;
    }
    const int received = sigtimedwait(&watched_, nullptr, &kGrace);
    return received > 0 ? received : 0;
}

void Interrupt::watch() {
    bool hurry = false;
    while (true) {
        const int received = next_signal(hurry);
        if (received == wake_signal()) {
            if (ending_) return;
        } else if (received == 0) {
            leave_work();
            hurry = false;
        } else if (stop_.stop_requested()) {
            end_now(received);
        } else {
            signal_ = received;
            stop_.request_stop();
            hurry = true;
        }
    }
}

void Interrupt::leave_work() {
    const std::lock_guard lock(keep_mutex_);
    if (!keep_) end_now(signal_);
    keep_();
}

void Interrupt::end_now(int signal) const {
    if (!said_.exchange(true)) write_standard_error_at_once(text());
    temporaries::remove_for_good();
    _exit(kExitSignalBase + signal);
}

}  // namespace carom
