#include "sim/collide/neighbour_lists.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Boxes count as wider by this part than balls go: rounding of the times at which they leave.
constexpr double kWider = 1.001;

/// What a list knows of beyond touching, as a part of the radii: the gap of a link
/// (island_step.h), and more.
constexpr double kReach = 1.00001;

/// The freedom, as parts of the diameter and of the mean gap: less of it is used up more often,
/// more makes longer lists. Measured on gases (bench/gas.cpp).
constexpr double kOfDiameter = 0.12, kOfGap = 0.4;

/// Of its freedom, how far a ball's box is ahead of it when it is new.
constexpr double kAhead = 0.6;

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

NeighbourLists::NeighbourLists(const std::vector<Vec3>& positions, const std::vector<double>& radii)
    : median_radius_(median_of(radii)),
      freedom_(freedom_in(bounds_of(positions), radii.size())),
      grid_(positions, radii, kWider * freedom_),
      lists_(positions.size()) {
    for (std::size_t i = 0; i < positions.size(); ++i)
        boxes_.push_back({positions[i], radii[i], false});
    for (int i = 0; i < static_cast<int>(positions.size()); ++i)
        if (grid_.in_cell(i))
            grid_.for_each_near(i, [&](int other) {
                if (grid_.in_cell(other) && may_touch(box(i), box(other)))
                    lists_[static_cast<std::size_t>(i)].push_back(other);
            });
}

double NeighbourLists::freedom_in(const Box3& space, std::size_t balls) const {
    const double diameter = 2 * median_radius_;
    const Vec3 extent = space.sizes().cwiseMax(diameter);
    const double spacing = std::cbrt(extent.prod() / static_cast<double>(balls));
    return kOfDiameter * diameter + kOfGap * std::max(spacing - diameter, 0.0);
}

/// Whether the two could touch somewhere in their boxes.
inline bool NeighbourLists::may_touch(const Box& a, const Box& b) const {
    const double sum = kReach * (a.radius + b.radius);
    const Vec3 apart =
        ((a.center - b.center).cwiseAbs().array() - 2 * kWider * freedom_).max(0.0).matrix();
    return apart.squaredNorm() <= sum * sum;
}

void NeighbourLists::move(int ball, const Vec3& x, const Vec3& velocity) {
    const double speed = velocity.cwiseAbs().maxCoeff();
    Box& here = boxes_[static_cast<std::size_t>(ball)];
    here.center = speed > 0 ? Vec3(x + (kAhead * freedom_ / speed) * velocity) : x;
    grid_.move(ball, grid_.cell_at(here.center));
    std::vector<int>& list = lists_[static_cast<std::size_t>(ball)];
    before_.swap(list);
    list.clear();
    added_.clear();
    for (const int other : before_) boxes_[static_cast<std::size_t>(other)].was_near = true;
    grid_.for_each_near(ball, [&](int other) {
        Box& there = boxes_[static_cast<std::size_t>(other)];
        if (!grid_.in_cell(other) || !may_touch(here, there)) return;
        list.push_back(other);
        if (!there.was_near) added_.push_back(other);
        there.was_near = false;
    });
    for (const int other : added_) lists_[static_cast<std::size_t>(other)].push_back(ball);
    for (const int other : before_) {
        bool& gone = boxes_[static_cast<std::size_t>(other)].was_near;
        if (gone) remove(other, ball);
        gone = false;
    }
}

void NeighbourLists::remove(int ball, int other) {
    std::vector<int>& list = lists_[static_cast<std::size_t>(ball)];
    *std::find(list.begin(), list.end(), other) = list.back();
    list.pop_back();
}

}  // namespace carom
