#include "sim/world/exact_world.h"

#include <fmt/core.h>

#include <algorithm>

#include "geometry/nearest.h"
#include "sim/collide/time_of_impact_high_degree.h"

namespace carom {

namespace {

/// Beyond its radius a ball is looked at as far as this part of it: well above the gap of a link
/// (island_step.h).
constexpr double kReach = 1e-5;

/// Up to this many materials all pairs of them are computed at the start.
constexpr std::size_t kCachedMaterials = 256;

/// The grid is built anew when its cells should be larger or smaller by this factor.
constexpr double kMisfit = 1.5;

}  // namespace

ExactWorld::ExactWorld(const Scene& s) : ExactBalls(s), pairs(s) {
    for (int i = 0; i < static_cast<int>(s.surfaces.size()); ++i)
        (is_unbounded(surface(i).shape) ? planes : bounded_surfaces).push_back(i);
    const std::size_t materials = s.materials.size();
    if (materials <= kCachedMaterials)
        for (std::size_t a = 0; a < materials; ++a)
            for (std::size_t b = 0; b < materials; ++b)
                pair_cache_.push_back(pairs.at(static_cast<int>(a), static_cast<int>(b)));
}

PairProperties ExactWorld::pair(int material_a, int material_b) const {
    if (pair_cache_.empty()) return pairs.at(material_a, material_b);
    return pair_cache_[static_cast<std::size_t>(material_a) * scene.materials.size() +
                       static_cast<std::size_t>(material_b)];
}

void ExactWorld::find_neighbours(double t, bool by_lists) {
    std::vector<Vec3> positions;
    std::vector<double> radii;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        positions.push_back(position(static_cast<int>(i), t));
        radii.push_back(scene.balls[i].radius);
    }
    grid.reset();
    lists.reset();
    if (by_lists)
        lists.emplace(positions, radii);
    else
        grid.emplace(positions, radii);
    for (NearList& list : near_lists_) list.ball = -1;
}

bool ExactWorld::refit_neighbours(double t, bool by_lists) {
    Vec3 low = position(0, t), high = low;
    for (int i = 1; i < static_cast<int>(balls.size()); ++i) {
        const Vec3 x = position(i, t);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double ratio = lists ? lists->freedom_in({low, high}, balls.size()) / lists->freedom()
                               : grid->cell_size_for(low, high) / grid->cell_size();
    if (by_lists == lists.has_value() && ratio < kMisfit && ratio > 1 / kMisfit) return false;
    find_neighbours(t, by_lists);
    for (int i = 0; i < static_cast<int>(balls.size()); ++i) renew(i);
    return true;
}

Box3 ExactWorld::place_of(int i) const {
    if (lists) {
        const Vec3 reach = Vec3::Constant(lists->freedom());
        return {lists->center(i) - reach, lists->center(i) + reach};
    }
    const NeighbourGrid::Cell& cell = grid->cell_of(i);
    Vec3 low;
    for (int k = 0; k < 3; ++k)
        low[k] = static_cast<double>(cell[static_cast<std::size_t>(k)]) * grid->cell_size();
    const Vec3 margin = Vec3::Constant(grid->margin());
    return {low - margin, low + Vec3::Constant(grid->cell_size()) + margin};
}

void ExactWorld::follow(int i, double t) {
    if (!has_place(i)) return;
    const Vec3 x = position(i, t);
    if (lists) {
        if (!lists->in_box(i, x)) lists->move(i, x, ball(i).piece.velocity_at(t));
        return;
    }
    const NeighbourGrid::Cell cell = grid->cell_at(x);
    if (cell != grid->cell_of(i)) grid->move(i, cell);
}

const std::vector<int>& ExactWorld::near(int ball_index) const {
    for (const NearList& list : near_lists_)
        if (list.ball == ball_index && list.moves == grid->moves()) return list.others;
    NearList& list = next_list();
    list.ball = ball_index;
    list.moves = grid->moves();
    list.others.clear();
    grid->for_each_near(ball_index, [&](int other) { add_to(list, other); });
    return list.others;
}

void ExactWorld::build_surface_tree() {
    surface_tree.emplace(scene.surfaces);
    clear_.resize(balls.size());
}

double ExactWorld::reach(int i) const { return (1 + kReach) * ball(i).radius + place_rounding; }

/// The planes into what is near of the other surfaces, both ascending.
void ExactWorld::merge_planes(std::vector<int>& found) const {
    const auto others = static_cast<std::ptrdiff_t>(found.size());
    found.insert(found.end(), planes.begin(), planes.end());
    if (others > 0) std::sort(found.begin(), found.end());
}

void ExactWorld::find_surfaces_ahead(int i, double t, double seconds,
                                     std::vector<int>& found) const {
    const Piece& piece = ball(i).piece;
    if (!piece.curve) {
        const Path ahead = path(i, t);
        const Box3 box = SurfaceTree::widened(bounds_of(ahead, 0, seconds), reach(i));
        Box3& clear = clear_[static_cast<std::size_t>(i)];
        if (clear.contains(box)) return;
        if (surface_tree->is_clear(box))
            clear = box;
        else
            surface_tree->find_along(ahead, seconds, reach(i), found);
        return;
    }
    const HighDegreePath curved = high_degree_path(piece, t, seconds);
    surface_tree->find_near(Box3(curved.c[0]), reach(i) + curved.reach(), found);
}

std::string ExactWorld::name(const Partner& partner) const {
    return partner.is_surface ? surface(partner.index).name : body(partner.index).name;
}

Contact ExactWorld::contact_at(int i, const Partner& partner, double t) const {
    if (partner.is_surface) return surface_contact(i, partner.index, position(i, t));
    Contact c;
    c.ball = std::min(i, partner.index);
    c.other = {false, std::max(i, partner.index)};
    const Vec3 a = position(c.ball, t), b = position(c.other.index, t);
    const double distance = (a - b).norm();
    const double sum = ball(c.ball).radius + ball(c.other.index).radius;
    c.normal = distance > 0 ? Vec3((a - b) / distance) : Vec3::UnitZ();
    c.depth = sum - distance;
    c.arm_other = ball(c.other.index).radius * c.normal;
    c.point = b + c.arm_other;
    set_pair(c, ball(c.other.index).material);
    return c;
}

Contact ExactWorld::surface_contact(int i, int index, const Vec3& x) const {
    const Nearest nearest = nearest_on(surface(index).shape, x, ball(i).radius);
    Contact c;
    c.ball = i;
    c.other = {true, index};
    c.normal = nearest.normal;
    c.depth = -nearest.gap;
    c.point = nearest.point;
    set_pair(c, surface(index).material);
    return c;
}

/// What follows from the ball and the material of what it meets.
void ExactWorld::set_pair(Contact& c, int material) const {
    c.arm = -ball(c.ball).radius * c.normal;
    const PairProperties both = pair(ball(c.ball).material, material);
    c.restitution = both.restitution;
    c.friction = both.friction;
    c.laws = both.laws;
}

bool ExactWorld::touches(const Contact& c, double t) const {
    const Vec3 a = position(c.ball, t);
    const double radius = ball(c.ball).radius;
    if (c.other.is_surface)
        return -c.depth <= touch_tolerance(c.ball, c.other, t, a, c.point, radius);
    return -c.depth <= touch_tolerance(c.ball, c.other, t, a, position(c.other.index, t),
                                       radius + ball(c.other.index).radius);
}

}  // namespace carom
