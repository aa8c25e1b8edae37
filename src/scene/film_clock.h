// Film time and motion time: which instant of the motion a film shows, and when.
#pragma once

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

}  // namespace carom
