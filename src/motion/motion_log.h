// Pieces of all balls in the order in which they come to be.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/motion.h"

namespace carom {

/// Where balls are many, every piece would go to another place in memory, and wait for it. So they
/// are written down one after the other, and put in order in the end.
class MotionLog {
  public:
    explicit MotionLog(std::size_t balls) : pieces_of_(balls, 0) {}

    void append(int ball, const Piece& piece);

    /// Moves all pieces into the balls' trajectories: Trajectory::append() in the same order. What
    /// comes later goes behind them.
    void move_into(std::vector<Trajectory>& balls);
    std::size_t pieces() const {
        return chunks_.empty() ? 0 : (chunks_.size() - 1) * kChunk + chunks_.back().size();
    }
    std::size_t balls() const { return pieces_of_.size(); }

  private:
    struct Entry {
        int ball = -1;
        Piece piece;
    };
    static constexpr std::size_t kChunk = 512;

    std::vector<std::vector<Entry>> chunks_;
    std::vector<std::uint32_t> pieces_of_;  ///< per ball
};

}  // namespace carom
