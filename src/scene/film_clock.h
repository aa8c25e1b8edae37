// Film time and motion time: which instant of the motion a film shows, and when; its frames.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace carom {

/// The instant of the motion [s] that the film shows `film_s` seconds after its first frame.
/// With t the time of the motion and v(t) the film's speed, dt / d(film time) = v(t): start + v
/// film_s where v is constant, and in closed form, piece by piece, where it is linear in t.
double motion_time(const Film& film, double film_s);

/// The inverse: how long after its first frame [s] the film shows the instant `motion_s`.
double film_time(const Film& film, double motion_s);

/// v at an instant of the motion.
double film_speed(const Film& film, double motion_s);

/// How many frames a film of a motion of `duration` seconds has: ceil(T fps - 1e-9), T the film
/// time at the motion's end. A last frame that would only repeat the end by rounding is left out.
/// Failure(kInput) for a film without frames, or with more than 1e9.
std::int64_t frame_count(const Film& film, double duration);

/// The instant of the motion [s] that frame k shows, which is k / fps after the first one.
double frame_time(const Film& film, std::int64_t k);

}  // namespace carom
