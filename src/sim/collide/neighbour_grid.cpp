#include "sim/collide/neighbour_grid.h"

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

Box3 bounds_of(const std::vector<Vec3>& positions) {
    Box3 box;
    for (const Vec3& p : positions) box.extend(p);
    return box;
}

NeighbourGrid::NeighbourGrid(const std::vector<Vec3>& positions, const std::vector<double>& radii) {
    prepare(positions, radii);
    if (positions.empty()) return;
    const Box3 box = bounds_of(positions);
    size_ = cell_size_for(box.min(), box.max());
    margin_ = kMargin * size_;
    fill(positions);
}

NeighbourGrid::NeighbourGrid(const std::vector<Vec3>& positions, const std::vector<double>& radii,
                             double freedom)
    : margin_(freedom) {
    prepare(positions, radii);
    size_ = 2 * largest_radius_ * (1 + kMargin) + 2 * freedom;
    fill(positions);
}

void NeighbourGrid::prepare(const std::vector<Vec3>& positions, const std::vector<double>& radii) {
    CAROM_CHECK(positions.size(), ==, radii.size());
    slots_.resize(positions.size());
    places_.resize(positions.size());
    choose_large(radii);
    for (std::size_t i = 0; i < radii.size(); ++i)
        if (places_[i].in_cell) largest_radius_ = std::max(largest_radius_, radii[i]);
}

void NeighbourGrid::fill(const std::vector<Vec3>& positions) {
    std::size_t buckets = 16;
    while (buckets < 4 * positions.size()) buckets *= 2;
    heads_.assign(buckets, -1);
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (places_[i].in_cell) insert(static_cast<int>(i), cell_at(positions[i]));
}

double NeighbourGrid::cell_size_for(const Vec3& low, const Vec3& high) const {
    const double diameter = 2 * largest_radius_;
    const Vec3 extent = (high - low).cwiseMax(diameter);
    const double spacing = std::cbrt(extent.prod() / static_cast<double>(slots_.size()));
    return std::max(kOfSpacing * spacing, diameter * (1 + 4 * kMargin));
}

void NeighbourGrid::choose_large(const std::vector<double>& radii) {
    if (radii.empty()) return;
    std::vector<double> sorted = radii;
    std::sort(sorted.begin(), sorted.end());
    const double median = sorted[sorted.size() / 2];
    const std::size_t first_allowed = sorted.size() - std::min(sorted.size(), kMostLarge);
    const double bound = std::max(kLarge * median, sorted[first_allowed]);
    for (std::size_t i = 0; i < radii.size(); ++i)
        if (radii[i] > bound) {
            places_[i].in_cell = false;
            large_.push_back(static_cast<int>(i));
        }
}

void NeighbourGrid::insert(int ball, const Cell& cell) {
    places_[static_cast<std::size_t>(ball)].cell = cell;
    Slot& s = slots_[static_cast<std::size_t>(ball)];
    s.cell = shortened(cell);
    int& head = heads_[bucket(s.cell)];
    s.next = head;
    head = ball;
}

void NeighbourGrid::move(int ball, const Cell& to) {
    CAROM_CHECK(in_cell(ball), ==, true);
    const Slot& s = slot(ball);
    int* link = &heads_[bucket(s.cell)];
    while (*link != ball) link = &slots_[static_cast<std::size_t>(*link)].next;
    *link = s.next;
    insert(ball, to);
    ++moves_;
}

}  // namespace carom
