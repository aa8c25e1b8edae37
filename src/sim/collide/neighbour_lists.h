// Which balls are near which where they stand dense: lists that hold while balls stay near where
// they were looked up.
#pragma once

#include <cstddef>
#include <vector>

#include "core/types.h"
#include "sim/collide/neighbour_grid.h"

namespace carom {

/// Each ball may go so far along each axis, its freedom, from the centre of a box of its own, and
/// has a list of all others that it could touch while both are in their boxes (L. Verlet,
/// "Computer experiments on classical fluids", Phys. Rev. 159, 1967; boxes with centres of their
/// own: A. Donev, S. Torquato, F. Stillinger, J. Comput. Phys. 202, 2005). A grid holds the
/// centres. Dense balls hardly ever leave their boxes, and lists are shorter than what 27 cells
/// hold. Balls that are much larger than the rest have no list, as they stand in no cell.
/// Positions in m, world frame.
class NeighbourLists {
  public:
    NeighbourLists(const std::vector<Vec3>& positions, const std::vector<double>& radii);

    double freedom() const { return freedom_; }  ///< m
    /// What it should be where so many balls fill this space, m.
    double freedom_in(const Box3& space, std::size_t balls) const;
    const Vec3& center(int ball) const { return boxes_[static_cast<std::size_t>(ball)].center; }
    bool in_box(int ball, const Vec3& x) const {
        return (x - center(ball)).cwiseAbs().maxCoeff() <= freedom_;
    }
    const NeighbourGrid& grid() const { return grid_; }
    /// Only of a ball in a cell; without those that are in none.
    const std::vector<int>& of(int ball) const { return lists_[static_cast<std::size_t>(ball)]; }
    /// A ball in a cell is at x, and gets a box around it that is ahead on its way.
    void move(int ball, const Vec3& x, const Vec3& velocity);
    /// Those that came into its list by the last move.
    const std::vector<int>& added() const { return added_; }

  private:
    struct alignas(64) Box {
        Vec3 center;
        double radius;          ///< m, of the ball
        bool was_near = false;  ///< while another one is moved
    };
    const Box& box(int ball) const { return boxes_[static_cast<std::size_t>(ball)]; }
    bool may_touch(const Box& a, const Box& b) const;
    void remove(int ball, int other);

    double median_radius_;  ///< m
    double freedom_;
    NeighbourGrid grid_;
    std::vector<Box> boxes_;
    std::vector<std::vector<int>> lists_;
    std::vector<int> before_, added_;  ///< of the last move; members, so that it allocates nothing
};

}  // namespace carom
