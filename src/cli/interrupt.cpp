#include "cli/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>

#include "cli/exit_codes.h"

namespace carom {

namespace {

sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGUSR1);  // only to wake the waiting thread at the end
    return set;
}

}  // namespace

Interrupt::Interrupt() {
    const sigset_t set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    thread_ = std::thread([this] { wait(); });
}

Interrupt::~Interrupt() {
    ending_ = true;
    pthread_kill(thread_.native_handle(), SIGUSR1);
    thread_.join();
}

int Interrupt::exit_code() const { return kExitSignalBase + signal_; }

void Interrupt::wait() {
    const sigset_t set = watched_signals();
    for (int received = 0; sigwait(&set, &received) == 0;) {
        if (received == SIGUSR1) {
            if (ending_) return;
            continue;
        }
        if (stop_.stop_requested()) _exit(kExitSignalBase + received);
        signal_ = received;
        stop_.request_stop();
    }
}

}  // namespace carom
