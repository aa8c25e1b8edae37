// Runs in threads; declared in run_many.h.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "sweep/runs/run_maker.h"
#include "sweep/runs/run_many.h"

namespace carom {

namespace {

/// What threads have to tell the one that shows it, which looks now and then: a word for each run
/// would cost as much as a short run does.
class Outcomes {
  public:
    void add(RunOutcome outcome) {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(outcome));
    }
    void end_of_thread(std::exception_ptr failure) {
        const std::lock_guard lock(mutex_);
        ++ended_;
        if (failure && !failure_) failure_ = std::move(failure);
        end_.notify_one();
    }
    /// After a while, or when all `threads` have ended; false where all is told then.
    bool next(int threads, std::deque<RunOutcome>& outcomes) {
        constexpr std::chrono::milliseconds kWhile{50};
        std::unique_lock lock(mutex_);
        end_.wait_for(lock, kWhile, [&] { return ended_ == threads; });
        outcomes.swap(waiting_);
        return !outcomes.empty() || ended_ < threads;
    }
    std::exception_ptr failure() const { return failure_; }

  private:
    std::mutex mutex_;
    std::condition_variable end_;
    std::deque<RunOutcome> waiting_;
    int ended_ = 0;
    std::exception_ptr failure_;
};

/// Each thread has a part of its own, and takes from the others' when that is done: runs that stand
/// beside one another share a folder, in which the system lets one make a name at a time.
class Shares {
  public:
    Shares(std::size_t count, int threads) : parts_(static_cast<std::size_t>(threads)) {
        const std::size_t parts = parts_.size();
        for (std::size_t i = 0; i < parts; ++i) {
            parts_[i].next = count * i / parts;
            parts_[i].end = count * (i + 1) / parts;
        }
    }
    /// The place of the next run; none where there are no more.
    std::optional<std::size_t> take(int thread) {
        const std::size_t parts = parts_.size();
        for (std::size_t i = 0; i < parts && !closed_; ++i) {
            Part& part = parts_[(static_cast<std::size_t>(thread) + i) % parts];
            if (const std::size_t place = part.next++; place < part.end) return place;
        }
        return std::nullopt;
    }
    void close() { closed_ = true; }

  private:
    struct alignas(64) Part {  // not in one line of the cache with another
        std::atomic<std::size_t> next = 0;
        std::size_t end = 0;
    };
    std::vector<Part> parts_;
    std::atomic<bool> closed_ = false;
};

}  // namespace

void run_in_threads(const ManyRuns& runs) {
    Outcomes outcomes;
    const int count = std::min(runs.jobs, static_cast<int>(runs.todo.size()));
    Shares shares(runs.todo.size(), count);
    std::stop_source stop;
    const std::stop_callback outer(runs.stop, [&stop] { stop.request_stop(); });
    const auto work = [&](int thread) {
        std::exception_ptr failure;
        try {
            RunMaker maker = runs.make_maker();
            while (!stop.stop_requested()) {
                const std::optional<std::size_t> place = shares.take(thread);
                if (!place) break;
                const RunRecord record = maker.make(runs.todo[*place], stop.get_token());
                const bool done = record.status == RunStatus::kDone;
                if (!done && runs.fail_fast) shares.close();
                outcomes.add({record.run, done, record.reason});
            }
        } catch (const RunMaker::Stopped&) {
            // As asked.
        } catch (...) {
            failure = std::current_exception();
            stop.request_stop();
        }
        outcomes.end_of_thread(std::move(failure));
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back(work, i);
    std::deque<RunOutcome> told;
    while (outcomes.next(count, told)) {
        for (const RunOutcome& outcome : told) runs.tell(&outcome);
        if (told.empty()) runs.tell(nullptr);
        told.clear();
    }
    threads.clear();
    if (outcomes.failure()) std::rethrow_exception(outcomes.failure());
}

}  // namespace carom
