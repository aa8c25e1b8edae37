// What the height of a ball's centre reaches.
#pragma once

#include <algorithm>
#include <limits>

#include "motion/motion.h"

namespace carom {

struct HeightRange {
    double low_m = std::numeric_limits<double>::infinity();
    double high_m = -std::numeric_limits<double>::infinity();

    void add(double height_m) {
        low_m = std::min(low_m, height_m);
        high_m = std::max(high_m, height_m);
    }
    /// A piece from `begin` to `end` [s]: at its ends, and where it turns.
    void add(const Piece& piece, double begin, double end) {
        add(piece.position_at(begin).z());
        add(piece.position_at(end).z());
        const double fall = piece.acceleration.z();
        const double top = fall != 0 ? piece.start - piece.velocity.z() / fall : begin;
        if (top > begin && top < end) add(piece.position_at(top).z());
    }
};

}  // namespace carom
