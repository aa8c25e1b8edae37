// Which frames a film has, which of them are wanted, and which instant each one shows.
#pragma once

#include <cstdint>
#include <string>

#include "cli/frame_ranges.h"
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
/// Throws Failure(kInput) when malformed or beyond the film.
FrameRanges parse_frames(const std::string& text, std::int64_t count);

/// Chunk I of N ("I/N", 1 <= I <= N) out of `count` frames: floor((I-1) F/N) ... floor(I F/N) - 1.
/// "auto" takes I and N from the array variables of Slurm.
/// Empty where there are more chunks than frames.
FrameRanges parse_chunk(const std::string& text, std::int64_t count);

/// Refuses what nobody can mean, with numbers and what to change: Failure(kInput).
void require_drawable(const FrameRanges& frames, const Film& film);

}  // namespace carom
