#include "media/threaded_sink.h"

#include <mutex>
#include <utility>

#include "media/frame_workers.h"

namespace carom {

namespace {

class ThreadedSink final : public FrameSink {
  public:
    ThreadedSink(std::unique_ptr<FrameSink> sink, int capacity)
        : sink_(std::move(sink)),
          workers_(
              1, capacity,
              [this](int, std::int64_t number, const Image& frame, const ChangedParts& changed) {
                  const std::lock_guard lock(sink_mutex_);
                  sink_->write_changed(number, frame, changed);
              }) {}

    void write(std::int64_t number, const Image& frame) override {
        workers_.push(number, frame, {});
    }
    void write_changed(std::int64_t number, const Image& frame,
                       const ChangedParts& changed) override {
        workers_.push(number, frame, changed);
    }
    void write_swapped(std::int64_t number, Image& frame) override {
        workers_.push_swapped(number, frame);
    }

    void finish() override {
        workers_.drain();
        const std::lock_guard lock(sink_mutex_);
        sink_->finish();
    }

    std::string keep_partial() override {
        workers_.drain();
        const std::lock_guard lock(sink_mutex_);
        return sink_->keep_partial();
    }

    SinkTimes times() const override {
        const std::lock_guard lock(sink_mutex_);
        return sink_->times();
    }

  private:
    mutable std::mutex sink_mutex_;
    std::unique_ptr<FrameSink> sink_;
    FrameWorkers workers_;  ///< last: its thread uses the sink
};

}  // namespace

std::unique_ptr<FrameSink> make_threaded_sink(std::unique_ptr<FrameSink> sink, int capacity) {
    return std::make_unique<ThreadedSink>(std::move(sink), capacity);
}

}  // namespace carom
