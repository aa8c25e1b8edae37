#include "media/frame_workers.h"

#include <system_error>
#include <utility>

#include "core/check.h"

namespace carom {

FrameWorkers::FrameWorkers(int threads, int capacity, Work work)
    : capacity_(static_cast<std::size_t>(capacity)), work_(std::move(work)) {
    CAROM_CHECK(threads, >, 0);
    CAROM_CHECK(capacity, >, 0);
    try {
        for (int i = 0; i < threads; ++i) threads_.emplace_back([this, i] { run(i); });
    } catch (const std::system_error&) {
        // Those that there are do.
    }
}

FrameWorkers::~FrameWorkers() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        waiting_.clear();
    }
    ready_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void FrameWorkers::push(std::int64_t number, const Image& frame, const ChangedParts& changed) {
    if (threads_.empty()) return work_here(number, frame, changed);
    push_filled(number, changed,
                [&](Image& slot, const ChangedParts& stale) { copy_parts(frame, stale, slot); });
}

void FrameWorkers::push_swapped(std::int64_t number, Image& frame) {
    if (threads_.empty()) return work_here(number, frame, {});
    const int width = frame.width_px, height = frame.height_px;
    push_filled(number, {}, [&](Image& slot, const ChangedParts&) { std::swap(slot, frame); });
    // The first ones get an empty picture in exchange.
    if (frame.width_px != width || frame.height_px != height) frame = Image(width, height);
}

void FrameWorkers::work_here(std::int64_t number, const Image& frame, const ChangedParts& changed) {
    if (failure_) std::rethrow_exception(failure_);
    try {
        work_(0, number, frame, changed);
    } catch (...) {
        failure_ = std::current_exception();
        throw;
    }
}

template <class Fill>
void FrameWorkers::push_filled(std::int64_t number, const ChangedParts& changed, const Fill& fill) {
    Slot slot;
    {
        std::unique_lock lock(mutex_);
        room_.wait(lock, [this] { return failure_ || waiting_.size() < capacity_; });
        if (failure_) std::rethrow_exception(failure_);
        if (!spare_.empty()) {
            slot = std::move(spare_.back());
            spare_.pop_back();
        }
    }
    // Only this thread adds frames, so the place stays free while the pixels are copied unlocked.
    if (slot.place == kNoPlace) {
        slot.place = stale_.size();
        stale_.emplace_back();
    }
    for (ChangedParts& stale : stale_) stale.add(changed);
    slot.number = number;
    slot.changed = changed;
    fill(slot.frame, stale_[slot.place]);
    stale_[slot.place] = ChangedParts::nothing();
    {
        const std::lock_guard lock(mutex_);
        if (!failure_) waiting_.push_back(std::move(slot));
    }
    ready_.notify_one();
}

void FrameWorkers::drain() {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return in_work_ == 0 && (failure_ || waiting_.empty()); });
    if (failure_) std::rethrow_exception(failure_);
}

void FrameWorkers::run(int worker) {
    std::unique_lock lock(mutex_);
    while (true) {
        ready_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        Slot slot = std::move(waiting_.front());
        waiting_.pop_front();
        ++in_work_;
        lock.unlock();
        room_.notify_all();

        std::exception_ptr failure;
        try {
            work_(worker, slot.number, slot.frame, slot.changed);
        } catch (...) {
            failure = std::current_exception();
        }

        lock.lock();
        --in_work_;
        spare_.push_back(std::move(slot));
        if (failure && !failure_) failure_ = failure;
        if (failure_) waiting_.clear();
        room_.notify_all();
    }
}

}  // namespace carom
