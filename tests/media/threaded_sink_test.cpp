#include "media/threaded_sink.h"

#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>

#include "media/frame_workers.h"
#include "media_fixture.h"

namespace carom {
namespace {

/// What a sink was given, readable after its end.
struct Record {
    std::vector<std::int64_t> numbers;
    std::vector<Image> frames;
    std::set<const std::uint8_t*> buffers;
    std::atomic<int> finished = 0;
    std::atomic<int> kept = 0;
    std::atomic<int> destroyed = 0;
};

class RecordingSink : public FrameSink {
  public:
    explicit RecordingSink(Record& record, std::int64_t bad_frame = -1)
        : record_(record), bad_frame_(bad_frame) {}
    ~RecordingSink() override { ++record_.destroyed; }
    void write(std::int64_t number, const Image& frame) override {
        if (number == bad_frame_) throw Failure(FailureKind::kOutput, "the disk is full");
        record_.numbers.push_back(number);
        record_.frames.push_back(frame);
        record_.buffers.insert(frame.bgra.data());
    }
    void finish() override { ++record_.finished; }
    std::string keep_partial() override {
        ++record_.kept;
        return "kept";
    }
    SinkTimes times() const override { return {0, static_cast<double>(record_.numbers.size()), 0}; }

  private:
    Record& record_;
    std::int64_t bad_frame_;
};

std::unique_ptr<FrameSink> threaded(Record& record, int capacity, std::int64_t bad_frame = -1) {
    return make_threaded_sink(std::make_unique<RecordingSink>(record, bad_frame), capacity);
}

TEST(ThreadedSink, KeepsOrderNumbersAndPixels) {
    Record record;
    auto sink = threaded(record, 3);
    for (int k = 0; k < 200; ++k) sink->write(5 * k, noise_image(8, 4, static_cast<unsigned>(k)));
    sink->finish();
    EXPECT_EQ(record.finished, 1);
    ASSERT_EQ(record.numbers.size(), 200U);
    for (int k = 0; k < 200; ++k) {
        const auto i = static_cast<std::size_t>(k);
        EXPECT_EQ(record.numbers[i], 5 * k);
        EXPECT_TRUE(record.frames[i] == noise_image(8, 4, static_cast<unsigned>(k)));
    }
    EXPECT_DOUBLE_EQ(sink->times().encode_cpu_s, 200);
    sink.reset();
    EXPECT_EQ(record.destroyed, 1);
}

TEST(ThreadedSink, SwapsInsteadOfCopying) {
    Record record;
    auto sink = threaded(record, 2);
    Image frame(16, 8);
    for (int k = 0; k < 100; ++k) {
        ASSERT_EQ(frame.width_px, 16);
        ASSERT_EQ(frame.bgra.size(), 16U * 8 * 4);
        frame.bgra.assign(frame.bgra.size(), static_cast<std::uint8_t>(k));
        sink->write_swapped(k, frame);
    }
    sink->finish();
    ASSERT_EQ(record.frames.size(), 100U);
    for (std::size_t k = 0; k < 100; ++k) EXPECT_EQ(record.frames[k].bgra[17], k);
}

// The k-th call of the sink cannot have more than `capacity` frames behind it.
TEST(ThreadedSink, IsBoundedAndFillsUp) {
    constexpr int kCapacity = 3, kFrames = 50;
    std::atomic<int> pushed = 0;
    int most = 0, done = 0;
    std::set<const std::uint8_t*> buffers;
    FrameWorkers workers(1, kCapacity,
                         [&](int, std::int64_t, const Image& frame, const ChangedParts&) {
                             // Slower than the writer: wait until it has filled the queue.
                             const int full = std::min(kFrames, done + 1 + kCapacity);
                             while (pushed < full) std::this_thread::yield();
                             for (int i = 0; i < 100; ++i) std::this_thread::yield();
                             most = std::max(most, pushed - done - 1);
                             ++done;
                             buffers.insert(frame.bgra.data());
                         });
    const Image frame(64, 64);
    for (int k = 0; k < kFrames; ++k) {
        workers.push(k, frame, {});
        ++pushed;
    }
    workers.drain();
    EXPECT_EQ(done, kFrames);
    EXPECT_EQ(most, kCapacity);
    EXPECT_LE(buffers.size(), 1U + kCapacity);  // used again and again
}

TEST(ThreadedSink, AnErrorComesOutOfTheNextCallAndOfEveryOneAfter) {
    Record record;
    auto sink = threaded(record, 2, 10);
    const Image frame(8, 8);
    const std::string text = failure_text(FailureKind::kOutput, [&] {
        for (int k = 0; k < 1000; ++k) sink->write(k, frame);
    });
    EXPECT_EQ(text, "the disk is full");
    EXPECT_THROW(sink->write(1000, frame), Failure);
    EXPECT_THROW(sink->finish(), Failure);
    EXPECT_THROW(sink->keep_partial(), Failure);
    EXPECT_EQ(record.finished, 0);
    EXPECT_EQ(record.kept, 0);
    sink.reset();
    EXPECT_EQ(record.numbers.size(), 10U);  // none behind the bad one
}

TEST(ThreadedSink, AnErrorOfTheLastFrameComesOutOfFinish) {
    Record record;
    auto sink = threaded(record, 4, 2);
    for (int k = 0; k < 3; ++k) sink->write(k, Image(8, 8));
    EXPECT_THROW(sink->finish(), Failure);
    EXPECT_EQ(record.finished, 0);
}

TEST(ThreadedSink, KeepsWhatWasWritten) {
    Record record;
    auto sink = threaded(record, 8);
    for (int k = 0; k < 5; ++k) sink->write(k, Image(8, 8));
    EXPECT_EQ(sink->keep_partial(), "kept");
    EXPECT_EQ(record.numbers.size(), 5U);
    EXPECT_EQ(record.finished, 0);
}

TEST(ThreadedSink, CanBeGivenUpAtAnyTime) {
    for (int frames = 0; frames < 20; ++frames) {
        Record record;
        auto sink = threaded(record, 3);
        for (int k = 0; k < frames; ++k) sink->write(k, Image(8, 8));
        sink.reset();
        EXPECT_EQ(record.destroyed, 1);
        EXPECT_EQ(record.finished, 0);
        EXPECT_LE(record.numbers.size(), static_cast<std::size_t>(frames));
    }
}

TEST(FrameWorkers, SeveralThreadsDoEveryFrameOnce) {
    std::vector<std::atomic<int>> done(300);
    std::atomic<int> workers_seen = 0;
    FrameWorkers workers(4, 3,
                         [&](int worker, std::int64_t number, const Image&, const ChangedParts&) {
                             workers_seen |= 1 << worker;
                             ++done[static_cast<std::size_t>(number)];
                             std::this_thread::yield();
                         });
    for (int k = 0; k < 300; ++k) workers.push(k, Image(4, 4), {});
    workers.drain();
    for (const auto& count : done) EXPECT_EQ(count, 1);
    EXPECT_GT(workers_seen, 0);
}

TEST(FrameWorkers, CanGoOnAfterADrain) {
    int done = 0;
    FrameWorkers workers(1, 2,
                         [&](int, std::int64_t, const Image&, const ChangedParts&) { ++done; });
    workers.drain();
    EXPECT_EQ(done, 0);
    workers.push(0, Image(2, 2), {});
    workers.drain();
    EXPECT_EQ(done, 1);
    workers.push(1, Image(2, 2), {});
    workers.drain();
    EXPECT_EQ(done, 2);
}

class ThreadedFilmTest : public FolderTest {};

TEST_F(ThreadedFilmTest, GivesTheSameBytesAsWithoutAThread) {
    FilmOptions options;
    options.width_px = 160;
    options.height_px = 90;
    options.threads = 2;
    const auto film = [&](const std::string& name, bool with_thread) {
        auto sink = make_film_writer(in_folder(name), options);
        if (with_thread) sink = make_threaded_sink(std::move(sink));
        for (int k = 0; k < 40; ++k) sink->write(k, moving_picture(160, 90, k));
        sink->finish();
        return bytes_of(in_folder(name));
    };
    const std::string plain = film("plain.mp4", false);
    EXPECT_GT(plain.size(), 1000U);
    EXPECT_TRUE(plain == film("threaded.mp4", true));
}

TEST_F(ThreadedFilmTest, AFullDiskComesThrough) {
    FilmOptions options;
    options.width_px = 160;
    options.height_px = 90;
    const FullDisk full(20000);
    const std::string text = failure_text(FailureKind::kOutput, [&] {
        auto sink = make_threaded_sink(make_film_writer(in_folder("a.mkv"), options));
        for (unsigned k = 0; k < 60; ++k) sink->write(k, noise_image(160, 90, k));
        sink->finish();
    });
    EXPECT_TRUE(contains(text, "File too large")) << text;
    EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace carom
