// Which balls are near which: space cut into cubes, so that the cost of an event does not grow with
// the number of balls.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.h"

namespace carom {

/// A hashed grid of cubes that hold balls by their centres. A ball touches only balls of its own
/// cell and of the 26 around it. The few balls that are much larger than the rest stand in no cell:
/// everyone has to look at them. Positions in m, world frame.
class NeighbourGrid {
  public:
    using Cell = std::array<std::int64_t, 3>;

    /// Chooses a cell size for these balls: by their distances as they are spread now, and never
    /// less than the largest diameter (of those in cells) plus the margin.
    NeighbourGrid(const std::vector<Vec3>& positions, const std::vector<double>& radii);

    double cell_size() const { return size_; }
    /// The size that these balls should have when they fill the space from low to high.
    double cell_size_for(const Vec3& low, const Vec3& high) const;
    /// A ball counts as inside its cell until it is this far outside, so that one on a border does
    /// not go to and fro with its rounding.
    double margin() const { return kMargin * size_; }
    bool in_cell(int ball) const { return places_[static_cast<std::size_t>(ball)].in_cell; }
    const Cell& cell_of(int ball) const { return places_[static_cast<std::size_t>(ball)].cell; }
    Cell cell_at(const Vec3& position) const;
    /// Has a ball's entries on their way when it is looked at a little later.
    void fetch(int ball) const {
        __builtin_prefetch(&places_[static_cast<std::size_t>(ball)]);
        __builtin_prefetch(&slots_[static_cast<std::size_t>(ball)]);
    }
    /// Puts a ball that stands in a cell into another one.
    void move(int ball, const Cell& to);
    /// How often balls were put elsewhere: until it changes, so do no answers.
    std::int64_t moves() const { return moves_; }

    /// Calls f(other) for all balls that could touch `ball`, and maybe some more; not for itself.
    template <class F>
    void for_each_near(int ball, F&& f) const {
        if (!in_cell(ball)) {
            for (int other = 0; other < static_cast<int>(slots_.size()); ++other)
                if (other != ball) f(other);
            return;
        }
        for (const int other : large_) f(other);
        const Cell& c = cell_of(ball);
        for (std::int64_t x = -1; x <= 1; ++x)
            for (std::int64_t y = -1; y <= 1; ++y)
                for (std::int64_t z = -1; z <= 1; ++z)
                    for_each_in({c[0] + x, c[1] + y, c[2] + z}, ball, f);
    }

    /// The same for balls that stand where they touch a ball of this radius at x now: of the cells
    /// around only those that it reaches into.
    template <class F>
    void for_each_touching(int ball, const Vec3& x, double radius, F&& f) const {
        if (!in_cell(ball)) {
            for_each_near(ball, f);
            return;
        }
        for (const int other : large_) f(other);
        const double reach = radius + largest_radius_ + 2 * margin();
        const Cell low = cell_at(x - Vec3::Constant(reach));
        const Cell high = cell_at(x + Vec3::Constant(reach));
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
            for (std::int64_t j = low[1]; j <= high[1]; ++j)
                for (std::int64_t k = low[2]; k <= high[2]; ++k) for_each_in({i, j, k}, ball, f);
    }

    /// The same for the layer of nine cells that comes into reach when `ball` has moved by one cell
    /// along an axis.
    template <class F>
    void for_each_in_layer(int ball, int axis, std::int64_t side, F&& f) const {
        const auto a = static_cast<std::size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
        Cell cell = cell_of(ball);
        cell[a] += side;
        const std::int64_t middle_b = cell[b], middle_c = cell[c];
        for (std::int64_t i = -1; i <= 1; ++i)
            for (std::int64_t j = -1; j <= 1; ++j) {
                cell[b] = middle_b + i;
                cell[c] = middle_c + j;
                for_each_in(cell, ball, f);
            }
    }

  private:
    static constexpr double kMargin = 0.02;  ///< of the cell size

    /// The lower halves of a cell's numbers: cells that share them are some 10^9 cells apart.
    using ShortCell = std::array<std::uint32_t, 3>;

    /// A ball, as a link of the list of its bucket: small, since a search reads many.
    struct Slot {
        ShortCell cell{};
        int next = -1;
    };
    struct Place {
        Cell cell{};
        bool in_cell = true;
    };

    static ShortCell shortened(const Cell& c) {
        return {static_cast<std::uint32_t>(c[0]), static_cast<std::uint32_t>(c[1]),
                static_cast<std::uint32_t>(c[2])};
    }
    static bool same(const ShortCell& a, const ShortCell& b) {
        return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
    }
    const Slot& slot(int ball) const { return slots_[static_cast<std::size_t>(ball)]; }
    /// Neighbouring cells' buckets lie together, so that a search reads few lines of memory: blocks
    /// of 2 x 2 x 4 cells fill one, and large odd factors spread the blocks.
    std::size_t bucket(const ShortCell& c) const {
        const std::uint64_t x = c[0] / 2 * 0x9e3779b97f4a7c15u;
        const std::uint64_t y = c[1] / 2 * 0xc2b2ae3d27d4eb4fu;
        const std::uint64_t z = c[2] / 4 * 0x165667b19e3779f9u;
        const std::uint64_t mixed = x ^ y ^ z;
        const std::uint64_t inside = c[0] % 2 * 8 + c[1] % 2 * 4 + c[2] % 4;
        return static_cast<std::size_t>((mixed ^ (mixed >> 32)) * 16 + inside) &
               (heads_.size() - 1);
    }
    void insert(int ball, const Cell& cell);
    void choose_large(const std::vector<double>& radii);

    template <class F>
    void for_each_in(const Cell& cell, int ball, F&& f) const {
        const ShortCell wanted = shortened(cell);
        for (int other = heads_[bucket(wanted)]; other >= 0; other = slot(other).next)
            if (other != ball && same(slot(other).cell, wanted)) f(other);
    }

    double size_ = 1;
    std::int64_t moves_ = 0;
    double largest_radius_ = 0;  ///< of the balls in cells
    std::vector<Place> places_;  ///< one per ball
    std::vector<Slot> slots_;    ///< one per ball
    std::vector<int> heads_;     ///< first ball of each bucket, -1 for none; a power of two of them
    std::vector<int> large_;
};

}  // namespace carom
