#include "motion/motion_log.h"

#include <malloc.h>

#include <utility>

namespace carom {

namespace {

/// Some 25 MB.
constexpr std::size_t kChunksPerTrim = 256;

/// What is free goes back to the system: the trajectories are written where nothing was so far, so
/// that memory would be taken twice.
void give_memory_back() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

}  // namespace

void MotionLog::append(int ball, const Piece& piece) {
    if (chunks_.empty() || chunks_.back().size() == kChunk) {
        chunks_.emplace_back();
        chunks_.back().reserve(kChunk);
    }
    chunks_.back().push_back({ball, piece});
    ++pieces_of_[static_cast<std::size_t>(ball)];
}

void MotionLog::move_into(std::vector<Trajectory>& balls) {
    for (std::size_t i = 0; i < balls.size(); ++i)
        if (balls[i].pieces().empty()) balls[i].reserve(pieces_of_[i]);
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
        for (Entry& e : chunks_[i])
            balls[static_cast<std::size_t>(e.ball)].append(std::move(e.piece));
        std::vector<Entry>().swap(chunks_[i]);
        if ((i + 1) % kChunksPerTrim == 0) give_memory_back();
    }
    chunks_.clear();
    pieces_of_.assign(pieces_of_.size(), 0);
}

}  // namespace carom
