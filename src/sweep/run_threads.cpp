// Runs in threads; declared in run_many.h.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "sweep/run_maker.h"
#include "sweep/run_many.h"

namespace carom {

namespace {

/// What threads have to tell the one that shows it.
class Outcomes {
  public:
    void add(RunOutcome outcome) {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(outcome));
        news_.notify_one();
    }
    void end_of_thread(std::exception_ptr failure) {
        const std::lock_guard lock(mutex_);
        ++ended_;
        if (failure && !failure_) failure_ = std::move(failure);
        news_.notify_one();
    }
    /// Waits for news, but not for long; false where `threads` have ended and all is told.
    bool next(int threads, std::deque<RunOutcome>& outcomes) {
        constexpr std::chrono::milliseconds kPatience{100};
        std::unique_lock lock(mutex_);
        news_.wait_for(lock, kPatience, [&] { return !waiting_.empty() || ended_ == threads; });
        outcomes.swap(waiting_);
        return !outcomes.empty() || ended_ < threads;
    }
    std::exception_ptr failure() const { return failure_; }

  private:
    std::mutex mutex_;
    std::condition_variable news_;
    std::deque<RunOutcome> waiting_;
    int ended_ = 0;
    std::exception_ptr failure_;
};

}  // namespace

void run_in_threads(const ManyRuns& runs) {
    Outcomes outcomes;
    std::atomic<std::size_t> next = 0;
    std::stop_source stop;
    const std::stop_callback outer(runs.stop, [&stop] { stop.request_stop(); });
    const auto work = [&] {
        std::exception_ptr failure;
        try {
            RunMaker maker = runs.make_maker();
            for (std::size_t i = next++; i < runs.todo.size() && !stop.stop_requested();
                 i = next++) {
                const RunRecord record = maker.make(runs.todo[i], stop.get_token());
                outcomes.add({record.run, record.status == RunStatus::kDone, record.reason});
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
    const int count = std::min(runs.jobs, static_cast<int>(runs.todo.size()));
    for (int i = 0; i < count; ++i) threads.emplace_back(work);
    std::deque<RunOutcome> told;
    while (outcomes.next(count, told)) {
        for (const RunOutcome& outcome : told) {
            if (!outcome.done && runs.fail_fast) next = runs.todo.size();
            runs.tell(&outcome);
        }
        if (told.empty()) runs.tell(nullptr);
        told.clear();
    }
    threads.clear();
    if (outcomes.failure()) std::rethrow_exception(outcomes.failure());
}

}  // namespace carom
