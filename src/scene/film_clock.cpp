#include "scene/film_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/failure.h"

namespace carom {

namespace {

/// Time in which dt/ds = v + a t goes from 0 to t: ln(1 + a t / v) / a.
double time_over(double v, double a, double t) {
    const double x = a == 0 ? 0 : a * t / v;  // t may be infinite there
    return t / v * (x == 0 ? 1 : std::log1p(x) / x);
}

/// How far dt/ds = v + a t comes in the time s: v (exp(a s) - 1) / a.
double way_in(double v, double a, double s) {
    const double x = a * s;
    return v * s * (x == 0 ? 1 : std::expm1(x) / x);
}

/// A stretch of the motion with v linear in time; the last one has no end.
struct Stretch {
    double length;  ///< s of the motion
    double speed;   ///< at its begin
    double slope;   ///< 1/s
};

/// From `film.start` on, in order. Calls use(stretch) until it returns false.
template <class Use>
void for_each_stretch(const Film& film, const Use& use) {
    double t = film.start;
    for (std::size_t i = 0; i < film.ramp.size(); ++i) {
        const SpeedKey& key = film.ramp[i];
        if (key.time <= t) continue;
        const double speed = film_speed(film, t);
        const double length = key.time - t;
        if (!use(Stretch{length, speed, i == 0 ? 0 : (key.speed - speed) / length})) return;
        t = key.time;
    }
    use(Stretch{HUGE_VAL, film_speed(film, t), 0});
}

}  // namespace

double film_speed(const Film& film, double motion_s) {
    if (film.ramp.empty()) return film.speed;
    const auto after = std::upper_bound(film.ramp.begin(), film.ramp.end(), motion_s,
                                        [](double t, const SpeedKey& key) { return t < key.time; });
    if (after == film.ramp.begin()) return after->speed;
    const SpeedKey& a = *std::prev(after);
    if (after == film.ramp.end()) return a.speed;
    return a.speed + (after->speed - a.speed) * ((motion_s - a.time) / (after->time - a.time));
}

double motion_time(const Film& film, double film_s) {
    if (film.ramp.empty() || film_s <= 0) return film.start + film_speed(film, film.start) * film_s;
    double t = film.start, left = film_s;
    for_each_stretch(film, [&](const Stretch& stretch) {
        const double whole = time_over(stretch.speed, stretch.slope, stretch.length);
        if (left <= whole) {
            t += std::min(way_in(stretch.speed, stretch.slope, left), stretch.length);
            return false;
        }
        t += stretch.length;
        left -= whole;
        return true;
    });
    return t;
}

double film_time(const Film& film, double motion_s) {
    const double way = motion_s - film.start;
    if (film.ramp.empty() || way <= 0) return way / film_speed(film, film.start);
    double s = 0, left = way;
    for_each_stretch(film, [&](const Stretch& stretch) {
        s += time_over(stretch.speed, stretch.slope, std::min(left, stretch.length));
        left -= stretch.length;
        return left > 0;
    });
    return s;
}

std::int64_t frame_count(const Film& film, double duration) {
    constexpr double kMost = 1e9;  // more is a mistake in duration, fps or speed
    const double seconds = film_time(film, duration);
    const double frames = std::ceil(seconds * film.fps.numerator / film.fps.denominator - 1e-9);
    if (!(frames >= 1))
        throw Failure(
            FailureKind::kInput,
            fmt::format("the film is empty: it starts at {} s and the motion ends at {} s",
                        film.start, duration));
    if (frames > kMost)
        throw Failure(FailureKind::kInput,
                      fmt::format("the film would have {:.3g} frames", frames));
    return static_cast<std::int64_t>(frames);
}

double frame_time(const Film& film, std::int64_t k) {
    return motion_time(film, static_cast<double>(k) * film.fps.denominator / film.fps.numerator);
}

}  // namespace carom
