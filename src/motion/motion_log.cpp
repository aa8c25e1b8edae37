#include "motion/motion_log.h"

#include <utility>

namespace carom {

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
    for (std::vector<Entry>& chunk : chunks_) {
        for (Entry& e : chunk) balls[static_cast<std::size_t>(e.ball)].append(std::move(e.piece));
        chunk = {};  // its memory is free for the trajectories
    }
    chunks_.clear();
    pieces_of_.assign(pieces_of_.size(), 0);
}

}  // namespace carom
