// Threads that work on frames behind the back of the one that draws them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "core/image.h"

namespace carom {

/// A bounded queue of frames and the threads that empty it.
///
/// Memory: capacity + threads pictures, allocated by the first frames and used again. With one
/// thread the frames are worked on in order; with several they begin in order. The first exception
/// of `work` ends the work: what waits is dropped, and every later push() and drain() throws it.
/// push() and drain() belong to one thread. Where the system gives fewer threads there are fewer;
/// where it gives none, push() works itself.
class FrameWorkers {
  public:
    /// Called on the threads, `worker` 0 ... threads - 1; `changed` since the frame that was pushed
    /// before, which another worker may have got.
    using Work = std::function<void(int worker, std::int64_t number, const Image& frame,
                                    const ChangedParts& changed)>;

    FrameWorkers(int threads, int capacity, Work work);
    ~FrameWorkers();  ///< drops what waits; no exception
    FrameWorkers(const FrameWorkers&) = delete;
    FrameWorkers& operator=(const FrameWorkers&) = delete;

    /// Copies the frame, of one that is known in part what `changed` since the place in the queue
    /// was last used; waits while the queue is full.
    void push(std::int64_t number, const Image& frame, const ChangedParts& changed);
    /// The same without a copy: swaps `frame` for a used one, whose pixels mean nothing.
    void push_swapped(std::int64_t number, Image& frame);
    /// Waits until all frames are done.
    void drain();

  private:
    struct Slot {
        std::int64_t number = 0;
        Image frame;
        ChangedParts changed;  ///< since the frame before
        std::size_t place = kNoPlace;
    };
    static constexpr std::size_t kNoPlace = static_cast<std::size_t>(-1);
    void work_here(std::int64_t number, const Image& frame, const ChangedParts& changed);
    template <class Fill>
    void push_filled(std::int64_t number, const ChangedParts& changed, const Fill& fill);
    void run(int worker);

    const std::size_t capacity_;
    const Work work_;
    std::mutex mutex_;
    std::condition_variable room_;   ///< a place in the queue, all done, or a failure
    std::condition_variable ready_;  ///< a frame, or the end
    std::deque<Slot> waiting_;
    std::vector<Slot> spare_;
    std::vector<ChangedParts> stale_;  ///< of each slot's frame, by its place; push()'s alone
    std::size_t in_work_ = 0;
    bool closed_ = false;
    std::exception_ptr failure_;
    std::vector<std::thread> threads_;  ///< last: they use all of the above
};

}  // namespace carom
