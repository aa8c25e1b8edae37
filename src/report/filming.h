// The loop of every film: frame by frame, drawn and handed to all outputs.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "media/frame_sink.h"
#include "render/painter.h"
#include "scene/frame_ranges.h"
#include "scene/scene.h"

namespace carom {

/// What goes on beside it; each may be empty.
struct FilmingHooks {
    std::function<bool()> stops;  ///< asked before each frame; true ends the loop
    /// Called before the instant t [s] is drawn, as a part of what draws it: returns when the
    /// motion is known as far as that needs.
    std::function<void(double t)> await;
    /// Runs what draws a frame: it may take long, and may be left in the middle for good.
    std::function<void(const std::function<void()>& draw)> run_drawing;
    std::function<void(std::int64_t done)> written;  ///< after each frame
};

/// Draws `frames` in order and hands each to all `sinks`, of which there is at least one. Returns
/// how many were written: fewer than all where it was stopped. Sinks are not finished, nor is
/// anything kept of them. What painter and sinks throw goes through.
std::int64_t film_frames(Painter& painter, const Film& film, const FrameRanges& frames,
                         const std::vector<std::unique_ptr<FrameSink>>& sinks,
                         const FilmingHooks& hooks = {});

}  // namespace carom
