// Which of a film's frames are wanted.
#pragma once

#include <cstdint>
#include <string>

#include "scene/frame_ranges.h"
#include "scene/scene.h"

namespace carom {

/// "0-9,20-40:2,100-" out of `count` frames: inclusive ranges with an optional step.
/// Throws Failure(kInput) when malformed or beyond the film.
FrameRanges parse_frames(const std::string& text, std::int64_t count);

/// Chunk I of N ("I/N", 1 <= I <= N) out of `count` frames: floor((I-1) F/N) ... floor(I F/N) - 1.
/// "auto" takes I and N from a batch system's array (array_task.h).
/// Empty where there are more chunks than frames.
/// `name` is the option that the text comes from.
FrameRanges parse_chunk(const std::string& text, std::int64_t count,
                        const std::string& name = "--chunk");

/// Refuses what nobody can mean, with numbers and what to change: Failure(kInput).
void require_drawable(const FrameRanges& frames, const Film& film);

}  // namespace carom
