#include "sim/neighbour_grid.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace carom {

namespace {

/// A ball with a radius above this many medians is large: in a cell of its size there would be too
/// many others.
constexpr double kLarge = 3;

/// Cells, as a part of the balls' mean distance: smaller ones are left more often, larger ones hold
/// more balls to look at. Measured on gases (bench/exact_cost.cpp).
constexpr double kOfSpacing = 0.6;

/// At most this many large balls: everyone looks at all of them. Of more than that, the smaller
/// ones stand in cells.
constexpr std::size_t kMostLarge = 16;

}  // namespace

NeighbourGrid::NeighbourGrid(const std::vector<Vec3>& positions, const std::vector<double>& radii) {
    CAROM_CHECK(positions.size(), ==, radii.size());
    slots_.resize(positions.size());
    if (positions.empty()) return;
    choose_large(radii);

    Vec3 low = positions.front(), high = positions.front();
    for (const Vec3& p : positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    double diameter = 0;
    for (std::size_t i = 0; i < radii.size(); ++i)
        if (slots_[i].in_cell) diameter = std::max(diameter, 2 * radii[i]);
    largest_radius_ = 0.5 * diameter;
    size_ = cell_size_for(low, high);

    std::size_t buckets = 16;
    while (buckets < 4 * positions.size()) buckets *= 2;
    heads_.assign(buckets, -1);
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (slots_[i].in_cell) insert(static_cast<int>(i), cell_at(positions[i]));
}

double NeighbourGrid::cell_size_for(const Vec3& low, const Vec3& high) const {
    const double diameter = 2 * largest_radius_;
    const Vec3 extent = (high - low).cwiseMax(diameter);
    const double spacing = std::cbrt(extent.prod() / static_cast<double>(slots_.size()));
    return std::max(kOfSpacing * spacing, diameter * (1 + 4 * kMargin));
}

void NeighbourGrid::choose_large(const std::vector<double>& radii) {
    std::vector<double> sorted = radii;
    std::sort(sorted.begin(), sorted.end());
    const double median = sorted[sorted.size() / 2];
    const std::size_t first_allowed = sorted.size() - std::min(sorted.size(), kMostLarge);
    const double bound = std::max(kLarge * median, sorted[first_allowed]);
    for (std::size_t i = 0; i < radii.size(); ++i)
        if (radii[i] > bound) {
            slots_[i].in_cell = false;
            large_.push_back(static_cast<int>(i));
        }
}

NeighbourGrid::Cell NeighbourGrid::cell_at(const Vec3& position) const {
    Cell cell{};
    for (std::size_t i = 0; i < 3; ++i)
        cell[i] =
            static_cast<std::int64_t>(std::floor(position[static_cast<Eigen::Index>(i)] / size_));
    return cell;
}

std::size_t NeighbourGrid::bucket(const Cell& cell) const {
    // Large odd factors and a fold of the upper half spread neighbouring cells over the buckets.
    const auto x = static_cast<std::uint64_t>(cell[0]) * 0x9e3779b97f4a7c15u;
    const auto y = static_cast<std::uint64_t>(cell[1]) * 0xc2b2ae3d27d4eb4fu;
    const auto z = static_cast<std::uint64_t>(cell[2]) * 0x165667b19e3779f9u;
    const std::uint64_t mixed = x ^ y ^ z;
    return static_cast<std::size_t>((mixed ^ (mixed >> 32)) & (heads_.size() - 1));
}

void NeighbourGrid::insert(int ball, const Cell& cell) {
    Slot& s = slots_[static_cast<std::size_t>(ball)];
    int& head = heads_[bucket(cell)];
    s.cell = cell;
    s.next = head;
    head = ball;
}

void NeighbourGrid::move(int ball, const Cell& to) {
    const Slot& s = slot(ball);
    CAROM_CHECK(s.in_cell, ==, true);
    int* link = &heads_[bucket(s.cell)];
    while (*link != ball) link = &slots_[static_cast<std::size_t>(*link)].next;
    *link = s.next;
    insert(ball, to);
}

}  // namespace carom
