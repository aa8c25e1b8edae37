#include "sim/collide/surface_tree.h"

#include <algorithm>

#include "geometry/bounds.h"

namespace carom {

namespace {

/// Boxes are wider than what is asked for by this part of their places and of the reach, well above
/// all roundings of a path.
constexpr double kBoundsRounding = 1e-9;

}  // namespace

Box3 bounds_of(const Path& path, double from, double to) {
    const Vec3 a = path.at(from), b = path.at(to);
    Box3 box(a.cwiseMin(b), a.cwiseMax(b));
    for (int i = 0; i < 3; ++i) {
        if (path.acceleration[i] == 0) continue;
        const double turn = -path.velocity[i] / path.acceleration[i];
        if (turn > from && turn < to) box.extend(path.at(turn));
    }
    return box;
}

SurfaceTree::SurfaceTree(const std::vector<Surface>& surfaces) {
    std::vector<int> bounded;
    for (int i = 0; i < static_cast<int>(surfaces.size()); ++i) {
        bounds_.push_back(bounds_of(surfaces[static_cast<std::size_t>(i)].shape));
        if (!bounds_.back().isEmpty()) bounded.push_back(i);
    }
    if (!bounded.empty()) build(bounded.begin(), bounded.end());
}

/// Returns the node's index.
int SurfaceTree::build(std::vector<int>::iterator begin, std::vector<int>::iterator end) {
    const auto bounds = [this](int i) -> const Box3& {
        return bounds_[static_cast<std::size_t>(i)];
    };
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    for (auto i = begin; i != end; ++i) nodes_[at].box.extend(bounds(*i));
    if (end - begin == 1) {
        nodes_[at].surface = *begin;
        return static_cast<int>(at);
    }
    Box3 centers;
    for (auto i = begin; i != end; ++i) centers.extend(bounds(*i).center());
    int axis = 0;
    centers.sizes().maxCoeff(&axis);
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](int a, int b) {
        return bounds(a).center()[axis] < bounds(b).center()[axis];
    });
    build(begin, middle);
    const int right = build(middle, end);
    nodes_[at].right = right;
    return static_cast<int>(at);
}

Box3 SurfaceTree::widened(const Box3& box, double reach) {
    const double places = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
    const Vec3 by = Vec3::Constant(reach + kBoundsRounding * (reach + places));
    return {box.min() - by, box.max() + by};
}

void SurfaceTree::find_near(const Box3& box, double reach, std::vector<int>& found) const {
    found.clear();
    if (nodes_.empty()) return;
    collect(0, widened(box, reach), found);
    if (found.size() > 1) std::sort(found.begin(), found.end());
}

void SurfaceTree::find_along(const Path& path, double seconds, double reach,
                             std::vector<int>& found) const {
    found.clear();
    if (nodes_.empty()) return;
    collect_along(0, path, 0, seconds, reach, found);
    if (found.size() < 2) return;
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

bool SurfaceTree::meets(std::size_t node, const Box3& box) const {
    const Node& n = nodes_[node];
    if (!n.box.intersects(box)) return false;
    return n.surface >= 0 || meets(node + 1, box) || meets(static_cast<std::size_t>(n.right), box);
}

void SurfaceTree::collect(std::size_t node, const Box3& box, std::vector<int>& found) const {
    const Node& n = nodes_[node];
    if (!n.box.intersects(box)) return;
    if (n.surface >= 0) {
        found.push_back(n.surface);
        return;
    }
    collect(node + 1, box, found);
    collect(static_cast<std::size_t>(n.right), box, found);
}

void SurfaceTree::collect_along(std::size_t node, const Path& path, double from, double to,
                                double reach, std::vector<int>& found) const {
    const Node& n = nodes_[node];
    const Box3 box = bounds_of(path, from, to);
    if (!n.box.intersects(widened(box, reach))) return;
    // A box that is much larger than the node's says little about a path.
    const double middle = 0.5 * (from + to);
    const double size = n.box.sizes().maxCoeff() + reach;
    if (box.sizes().maxCoeff() > 2 * size && middle > from && middle < to) {
        collect_along(node, path, from, middle, reach, found);
        collect_along(node, path, middle, to, reach, found);
    } else if (n.surface >= 0) {
        found.push_back(n.surface);
    } else {
        collect_along(node + 1, path, from, to, reach, found);
        collect_along(static_cast<std::size_t>(n.right), path, from, to, reach, found);
    }
}

}  // namespace carom
