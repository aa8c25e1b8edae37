#include "cli/kept_work.h"

#include <unistd.h>

#include <system_error>
#include <thread>
#include <utility>

#include "core/failure.h"

namespace carom {

KeptWork::KeptWork(const Interrupt& interrupt, std::function<void()> keep)
    : interrupt_(interrupt), keep_(std::move(keep)) {
    const std::lock_guard lock(interrupt_.keep_mutex_);
    interrupt_.keep_ = [this] { leave(); };
}

KeptWork::~KeptWork() {
    const std::lock_guard lock(interrupt_.keep_mutex_);
    interrupt_.keep_ = {};
}

void KeptWork::go(Place from, Place to) noexcept {
    if (place_.compare_exchange_strong(from, to)) return;
    while (true) ::pause();  // left: the process ends soon
}

/// On a thread of its own, because this one waits for the second signal.
void KeptWork::leave() {
    Place inside = Place::kInside;
    if (!place_.compare_exchange_strong(inside, Place::kLeft)) return;
    const auto end = [this] {
        try {
            keep_();
        } catch (const Failure&) {
            // What cannot be kept is lost: the interrupt is what is said.
        }
        interrupt_.end_now(interrupt_.exit_code());
    };
    try {
        std::thread(end).detach();
    } catch (const std::system_error&) {
        end();
    }
}

}  // namespace carom
