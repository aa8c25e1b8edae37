// Which frames a film has, which of them are wanted, and which instant each one shows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// ceil(T fps - 1e-9), T the film time at the end of the motion (scene/film_clock.h), which is
/// (duration - start) / speed where the speed is constant: a last frame that would only repeat the
/// end by rounding is left out.
std::int64_t frame_count(const Film& film, double duration);

/// What the film shows k / fps after its begin, in seconds of the motion: start + speed k / fps
/// where the speed is constant.
double frame_time(const Film& film, std::int64_t frame);

/// "0-9,20-40:2,100-" out of `count` frames: inclusive ranges with an optional step.
/// Increasing, each once. Throws Failure(kInput) when malformed or beyond the film.
std::vector<std::int64_t> parse_frames(const std::string& text, std::int64_t count);

/// Chunk I of N ("I/N", 1 <= I <= N) out of `count` frames: floor((I-1) F/N) ... floor(I F/N) - 1.
/// "auto" takes I and N from the array variables of Slurm.
std::vector<std::int64_t> parse_chunk(const std::string& text, std::int64_t count);

/// All `count` frames.
std::vector<std::int64_t> all_frames(std::int64_t count);

}  // namespace carom
