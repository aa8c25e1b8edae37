// The one loop of all films: which frames, in which order, and to whom.
#include "report/filming.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "scene/film_clock.h"

namespace carom {
namespace {

/// Keeps what it is given, and how.
class Kept : public FrameSink {
  public:
    struct Frame {
        std::int64_t number;
        Image picture;
        bool swapped;
        bool operator==(const Frame&) const = default;
    };
    explicit Kept(std::vector<Frame>& frames) : frames_(frames) {}
    void write(std::int64_t number, const Image& frame) override {
        frames_.push_back({number, frame, false});
    }
    void write_swapped(std::int64_t number, Image& frame) override {
        frames_.push_back({number, frame, true});
        frame.bgra.assign(frame.bgra.size(), 7);  // they mean nothing any more
    }
    void finish() override { ADD_FAILURE() << "not the loop's"; }
    std::string keep_partial() override {
        ADD_FAILURE() << "not the loop's";
        return {};
    }
    SinkTimes times() const override { return {}; }

  private:
    std::vector<Frame>& frames_;
};

class FilmingTest : public ::testing::Test {
  protected:
    FilmingTest() {
        scene_.looks.emplace_back();
        Ball ball;
        ball.name = "ball";
        ball.radius = 0.3;
        scene_.balls.push_back(ball);
        Piece piece;
        piece.position = {-1, 0, 1};
        piece.velocity = {1, 0, 0};
        Trajectory path;
        path.append(piece);
        motion_.balls.push_back(path);
        motion_.ball_names.push_back(ball.name);
        motion_.peaks.emplace_back();
        motion_.duration = 2;
        scene_.film.fps = {10, 1};
    }

    std::int64_t film(const FrameRanges& frames, std::size_t outputs, const FilmingHooks& hooks) {
        kept_.resize(outputs);
        std::vector<std::unique_ptr<FrameSink>> sinks;
        for (auto& frames_of_one : kept_) sinks.push_back(std::make_unique<Kept>(frames_of_one));
        Painter painter(scene_, motion_, {64, 36});
        return film_frames(painter, scene_.film, frames, sinks, hooks);
    }

    Scene scene_;
    Motion motion_;
    std::vector<std::vector<Kept::Frame>> kept_;
};

TEST_F(FilmingTest, EveryOutputGetsEveryFrameOfItsInstant) {
    const FrameRanges frames({{0, 2, 1}, {7, 9, 2}});
    std::vector<std::int64_t> written;
    FilmingHooks hooks;
    hooks.written = [&](std::int64_t done) { written.push_back(done); };
    EXPECT_EQ(5, film(frames, 2, hooks));
    EXPECT_EQ((std::vector<std::int64_t>{1, 2, 3, 4, 5}), written);
    ASSERT_EQ(5u, kept_[0].size());
    ASSERT_EQ(5u, kept_[1].size());
    Painter painter(scene_, motion_, {64, 36});
    Image expected;
    const std::int64_t numbers[] = {0, 1, 2, 7, 9};
    for (std::size_t i = 0; i < 5; ++i) {
        painter.paint(frame_time(scene_.film, numbers[i]), expected);
        EXPECT_EQ((Kept::Frame{numbers[i], expected, false}), kept_[0][i]);
        EXPECT_EQ((Kept::Frame{numbers[i], expected, false}), kept_[1][i]);
    }
}

TEST_F(FilmingTest, UnderACameraThatMovesTheLastOutputGetsThePictureItself) {
    scene_.camera = Camera{};
    scene_.camera->orbit_deg_per_s = 20;
    EXPECT_EQ(3, film(FrameRanges::all(3), 2, {}));
    Painter painter(scene_, motion_, {64, 36});
    Image expected;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = static_cast<std::int64_t>(i);
        painter.paint(frame_time(scene_.film, number), expected);
        EXPECT_EQ((Kept::Frame{number, expected, false}), kept_[0][i]);
        EXPECT_EQ((Kept::Frame{number, expected, true}), kept_[1][i]);
    }
}

TEST_F(FilmingTest, StopsBeforeAFrameAndSaysHowFarItGot) {
    FilmingHooks hooks;
    int asked = 0, drawn = 0;
    hooks.stops = [&] { return ++asked > 3; };
    hooks.run_drawing = [&](const std::function<void()>& draw) {
        draw();
        ++drawn;
    };
    EXPECT_EQ(3, film(FrameRanges::all(20), 1, hooks));
    EXPECT_EQ(3, drawn);
    EXPECT_EQ(3u, kept_[0].size());
}

}  // namespace
}  // namespace carom
