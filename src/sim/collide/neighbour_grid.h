// Which balls are near which: space cut into cubes, so that the cost of an event does not grow with
// the number of balls.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.h"

namespace carom {

/// Around the places of balls, m.
Box3 bounds_of(const std::vector<Vec3>& positions);

/// A hashed grid of cubes that hold balls by their centres. A ball touches only balls of its own
/// cell and of the 26 around it. The few balls that are much larger than the rest stand in no cell:
/// everyone has to look at them. Positions in m, world frame.
class NeighbourGrid {
  public:
    using Cell = std::array<std::int64_t, 3>;

    /// Chooses a cell size for these balls: by their distances as they are spread now, and never
    /// less than the largest diameter (of those in cells) plus the margin.
    NeighbourGrid(const std::vector<Vec3>& positions, const std::vector<double>& radii);
    /// With cells for balls that may go `freedom` [m] along each axis from where they stand in
    /// their cell before they are moved.
    NeighbourGrid(const std::vector<Vec3>& positions, const std::vector<double>& radii,
                  double freedom);

    double cell_size() const { return size_; }
    /// The size that these balls should have when they fill the space from low to high.
    double cell_size_for(const Vec3& low, const Vec3& high) const;
    /// A ball counts as inside its cell until it is this far outside, so that one on a border does
    /// not go to and fro with its rounding.
    double margin() const { return margin_; }
    bool in_cell(int ball) const { return places_[static_cast<std::size_t>(ball)].in_cell; }
    /// Those that stand in no cell.
    const std::vector<int>& large() const { return large_; }
    const Cell& cell_of(int ball) const { return places_[static_cast<std::size_t>(ball)].cell; }
    Cell cell_at(const Vec3& position) const {
        return {floor_of(position[0] / size_), floor_of(position[1] / size_),
                floor_of(position[2] / size_)};
    }
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
        for_each_in({c[0] - 1, c[1] - 1, c[2] - 1}, {c[0] + 1, c[1] + 1, c[2] + 1}, ball, f);
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
        for_each_in(cell_at(x - Vec3::Constant(reach)), cell_at(x + Vec3::Constant(reach)), ball,
                    f);
    }

    /// The same for the layer of nine cells that comes into reach when `ball` has moved by one cell
    /// along an axis.
    template <class F>
    void for_each_in_layer(int ball, int axis, std::int64_t side, F&& f) const {
        const auto a = static_cast<std::size_t>(axis);
        const Cell& c = cell_of(ball);
        Cell low{c[0] - 1, c[1] - 1, c[2] - 1}, high{c[0] + 1, c[1] + 1, c[2] + 1};
        low[a] = high[a] = c[a] + side;
        for_each_in(low, high, ball, f);
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

    /// Of what fits in.
    static std::int64_t floor_of(double x) {
        const auto whole = static_cast<std::int64_t>(x);
        return whole - (x < static_cast<double>(whole) ? 1 : 0);
    }
    static ShortCell shortened(const Cell& c) {
        return {static_cast<std::uint32_t>(c[0]), static_cast<std::uint32_t>(c[1]),
                static_cast<std::uint32_t>(c[2])};
    }
    static bool same(const ShortCell& a, const ShortCell& b) {
        return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
    }
    const Slot& slot(int ball) const { return slots_[static_cast<std::size_t>(ball)]; }
    /// Neighbouring cells' buckets lie together, so that a search reads few lines of memory: blocks
    /// of 2 x 2 x 4 cells fill one, and large odd factors spread the blocks. What each axis adds to
    /// the number of a bucket: that of its block, and its place inside.
    struct Hash {
        std::uint64_t block = 0, inside = 0;
    };
    static Hash hash_x(std::uint32_t c) { return {c / 2 * 0x9e3779b97f4a7c15u, c % 2 * 8}; }
    static Hash hash_y(std::uint32_t c) { return {c / 2 * 0xc2b2ae3d27d4eb4fu, c % 2 * 4}; }
    static Hash hash_z(std::uint32_t c) { return {c / 4 * 0x165667b19e3779f9u, c % 4}; }
    std::size_t bucket(const Hash& x, const Hash& y, const Hash& z) const {
        const std::uint64_t mixed = x.block ^ y.block ^ z.block;
        return static_cast<std::size_t>((mixed ^ (mixed >> 32)) * 16 + x.inside + y.inside +
                                        z.inside) &
               (heads_.size() - 1);
    }
    std::size_t bucket(const ShortCell& c) const {
        return bucket(hash_x(c[0]), hash_y(c[1]), hash_z(c[2]));
    }
    void prepare(const std::vector<Vec3>& positions, const std::vector<double>& radii);
    void fill(const std::vector<Vec3>& positions);
    void insert(int ball, const Cell& cell);
    void choose_large(const std::vector<double>& radii);

    /// In all cells from one to another.
    template <class F>
    void for_each_in(const Cell& low, const Cell& high, int ball, F&& f) const {
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                const auto short_x = static_cast<std::uint32_t>(x);
                const auto short_y = static_cast<std::uint32_t>(y);
                const Hash of_x = hash_x(short_x), of_y = hash_y(short_y);
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto short_z = static_cast<std::uint32_t>(z);
                    const ShortCell wanted{short_x, short_y, short_z};
                    int other = heads_[bucket(of_x, of_y, hash_z(short_z))];
                    for (; other >= 0; other = slot(other).next)
                        if (other != ball && same(slot(other).cell, wanted)) f(other);
                }
            }
    }

    double size_ = 1, margin_ = 0;
    std::int64_t moves_ = 0;
    double largest_radius_ = 0;  ///< of the balls in cells
    std::vector<Place> places_;  ///< one per ball
    std::vector<Slot> slots_;    ///< one per ball
    std::vector<int> heads_;     ///< first ball of each bucket, -1 for none; a power of two of them
    std::vector<int> large_;
};

}  // namespace carom
