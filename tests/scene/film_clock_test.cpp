// Film time and motion time against closed forms and against a ten-line integration.
#include "scene/film_clock.h"

#include <fmt/core.h>

#include <cmath>

#include "core/failure.h"
#include "scene_testing.h"

namespace carom {
namespace {

Film ramp_film() {
    Film film;
    film.start = 0.2;
    film.ramp = {{0.5, 1.0}, {1.0, 0.1}, {1.5, 0.1}, {1.7, 2.0}};
    film.speed = 2.0;
    return film;
}

TEST(FilmClock, ConstantSpeedIsTheStraightLine) {
    Film film;
    film.start = 0.3;
    film.speed = 0.25;
    EXPECT_EQ(motion_time(film, 2.0), 0.3 + 0.25 * 2.0);
    EXPECT_EQ(film_time(film, 1.3), (1.3 - 0.3) / 0.25);
}

TEST(FilmClock, AFilmHasNoFrameThatRoundingAdds) {
    Film film;
    film.fps = {10, 1};
    EXPECT_EQ(20, frame_count(film, 2.0)) << "the end itself is not shown once more";
    EXPECT_EQ(20, frame_count(film, 2.0 + 1e-12));
    EXPECT_EQ(21, frame_count(film, 2.001));
    EXPECT_EQ(1, frame_count(film, 1e-3));
    film.start = 0.5;
    film.speed = 0.25;
    EXPECT_EQ(60, frame_count(film, 2.0));
    EXPECT_EQ(0.5 + 0.25 * 0.7, frame_time(film, 7));
    film.fps = {30000, 1001};
    EXPECT_EQ(0.5 + 0.25 * (30000.0 * 1001 / 30000), frame_time(film, 30000));
    EXPECT_THROW(frame_count(film, 0.5), Failure);
    EXPECT_THROW(frame_count(film, 1e9), Failure);
}

TEST(FilmClock, ARampTakesTheLogarithmOfTheSpeeds) {
    const Film film = ramp_film();
    // 0.3 s at speed 1, then speed 1 to 0.1 over 0.5 s of motion: 0.5 ln(10) / 0.9 s of film.
    const double slowed = 0.3 + 0.5 * std::log(10) / 0.9;
    EXPECT_NEAR(film_time(film, 1.0), slowed, 1e-14);
    EXPECT_NEAR(film_time(film, 1.5), slowed + 5, 1e-14);
    EXPECT_NEAR(film_time(film, 1.7), slowed + 5 + 0.2 * std::log(20) / 1.9, 1e-14);
    EXPECT_NEAR(film_time(film, 3.7), slowed + 5 + 0.2 * std::log(20) / 1.9 + 1, 1e-14);
    EXPECT_NEAR(film_speed(film, 0.75), 0.55, 1e-15);
}

TEST(FilmClock, BothWaysAreInverse) {
    const Film film = ramp_film();
    double worst = 0;
    for (int k = 0; k <= 1000; ++k) {
        const double s = 0.009 * k;
        const double back = film_time(film, motion_time(film, s));
        ASSERT_TRUE(std::isfinite(back)) << s;
        worst = std::max(worst, std::abs(back - s));
    }
    fmt::print("film time and back: off by {:.1e} s (at most 1e-13)\n", worst);
    EXPECT_LT(worst, 1e-13);
}

TEST(FilmClock, AgreesWithAnIntegrationStepByStep) {
    const Film film = ramp_film();
    const double dt = 1e-5;
    double t = film.start, worst = 0;
    for (int k = 1; k <= 800'000; ++k) {  // the midpoint rule for dt/ds = v(t)
        const double middle = t + 0.5 * dt * film_speed(film, t);
        t += dt * film_speed(film, middle);
        if (k % 1000 == 0) worst = std::max(worst, std::abs(motion_time(film, k * dt) - t));
    }
    ASSERT_GT(t, 1.7);
    fmt::print("against steps of 1e-5 s: off by {:.1e} s (at most 1e-7)\n", worst);
    EXPECT_LT(worst, 1e-7);
}

TEST(FilmClock, TheSceneMayGiveARamp) {
    const Film film =
        scene_of("carom: 1\nfilm: {speed: [{time: 0, speed: 1}, {time: 1.2, speed: 0.1}]}").film;
    ASSERT_EQ(film.ramp.size(), 2U);
    EXPECT_EQ(film.ramp[1].time, 1.2);
    EXPECT_EQ(film.ramp[1].speed, 0.1);
    EXPECT_EQ(film.speed, 0.1);
}

TEST(FilmClock, WrongRampsAreRefused) {
    EXPECT_EQ(errors_of("carom: 1\nfilm: {speed: []}"),
              "t.yaml:2:15: error: the list of speeds has no entries\n");
    EXPECT_EQ(errors_of("carom: 1\nfilm: {speed: [{time: 1, speed: 1}, {time: 1, speed: 0.1}]}"),
              "t.yaml:2:44: error: the times of the film's speeds must increase\n");
    EXPECT_EQ(errors_of("carom: 1\nfilm: {speed: [{time: 1, speed: 0}]}"),
              "t.yaml:2:33: error: 'speed' must be above 0, not 0\n");
}

}  // namespace
}  // namespace carom
