// Encoding beside drawing.
#pragma once

#include <memory>

#include "media/frame_sink.h"

namespace carom {

/// Runs `sink` on a thread of its own behind a queue of at most `capacity` frames, so that drawing
/// and encoding overlap.
///
/// Memory: capacity + 1 pictures, used again and again. write() copies the frame, write_changed()
/// what changed of it since its picture was last used; both wait while the queue is full. The first
/// exception of the sink comes out of the next write(), of finish() or of keep_partial(). finish()
/// and keep_partial() wait for the frames in the queue, then call the sink's on the calling thread.
/// times() may wait for the frame in work; its figures do not hold the copying, which is the
/// caller's time.
std::unique_ptr<FrameSink> make_threaded_sink(std::unique_ptr<FrameSink> sink, int capacity = 3);

}  // namespace carom
