#include "scene/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "geometry/bounds.h"
#include "geometry/nearest.h"

namespace carom {

namespace {

/// From where to where a shape extends along x; without end for planes.
std::array<double, 2> extent_x(const SurfaceShape& shape) {
    if (is_unbounded(shape)) {
        const double infinity = std::numeric_limits<double>::infinity();
        return {-infinity, infinity};
    }
    const Box3 bounds = bounds_of(shape);
    return {bounds.min().x(), bounds.max().x()};
}

double largest(const Vec3& v) { return v.cwiseAbs().maxCoeff(); }

/// The largest number that says where a surface is.
double numbers_of(const PlaneShape& plane) { return std::abs(plane.offset_m); }
double numbers_of(const SphereShape& sphere) { return largest(sphere.center) + sphere.radius; }
double numbers_of(const BoxShape& box) { return largest(box.center) + largest(box.size); }
double numbers_of(const CapsuleShape& capsule) {
    return largest(capsule.from) + largest(capsule.to) + capsule.radius;
}

double numbers_of(const CylinderShape& cylinder) {
    return largest(cylinder.from) + largest(cylinder.to) + cylinder.radius;
}

double numbers_of(const RingShape& ring) {
    return largest(ring.center) + ring.radius + ring.tube_radius;
}

double numbers_of(const BowlShape& bowl) { return largest(bowl.center) + bowl.radius; }
double numbers_of(const PipeShape& pipe) {
    return largest(pipe.from) + largest(pipe.to) + pipe.radius;
}

/// The radius of what a ball meets, at most its own: what is flat has none.
double size_of_other(const PlaneShape&, double ball_radius) { return ball_radius; }
double size_of_other(const BoxShape&, double ball_radius) { return ball_radius; }
double size_of_other(const SphereShape& sphere, double ball_radius) {
    return std::min(sphere.radius, ball_radius);
}
double size_of_other(const CapsuleShape& capsule, double ball_radius) {
    return std::min(capsule.radius, ball_radius);
}
double size_of_other(const CylinderShape& cylinder, double ball_radius) {
    return std::min(cylinder.radius, ball_radius);
}
double size_of_other(const RingShape& ring, double ball_radius) {
    return std::min(ring.tube_radius, ball_radius);
}
double size_of_other(const BowlShape& bowl, double ball_radius) {
    return std::min(bowl.radius, ball_radius);
}
double size_of_other(const PipeShape& pipe, double ball_radius) {
    return std::min(pipe.radius, ball_radius);
}

/// How deep a ball may be in a shape and count as touching it, m.
double touching_depth(const SurfaceShape& shape, const Ball& ball) {
    return std::visit(
        [&](const auto& s) {
            return kTouchingDepth * size_of_other(s, ball.radius) +
                   kPlaceRounding * (largest(ball.position) + numbers_of(s));
        },
        shape);
}

/// A grid with one level per power of two, so that small balls among large ones stay cheap. A ball
/// lives in the level whose cells are 2 r ... 4 r wide, in the cell of its centre.
class BallGrid {
  public:
    BallGrid(const Scene& scene, const std::vector<bool>& sound) : scene_(scene) {
        for (std::size_t i = 0; i < scene.balls.size(); ++i)
            if (sound[i]) entries_.push_back(entry(static_cast<int>(i)));
        std::sort(entries_.begin(), entries_.end());
        for (const Entry& e : entries_)
            if (levels_.empty() || levels_.back() != e.level) levels_.push_back(e.level);
    }

    void collect(std::vector<BallOverlap>& found) const {
        for (const Entry& e : entries_)
            for (const int level : levels_)
                if (level >= e.level && !collect_near(e, level, found)) return;
    }

  private:
    struct Entry {
        int level;
        std::int64_t x, y, z;
        int ball;
        auto operator<=>(const Entry&) const =
            default;  // NOLINT(modernize-use-nullptr): no pointer
    };

    const Ball& ball(int index) const { return scene_.balls[static_cast<std::size_t>(index)]; }

    static std::int64_t cell(double coordinate, int level) {
        return static_cast<std::int64_t>(std::floor(std::ldexp(coordinate, -level)));
    }

    Entry entry(int index) const {
        const Ball& b = ball(index);
        const int level = std::ilogb(b.radius) + 2;
        return at_level(b, level, index);
    }

    static Entry at_level(const Ball& b, int level, int index) {
        return {level, cell(b.position.x(), level), cell(b.position.y(), level),
                cell(b.position.z(), level), index};
    }

    /// Pairs of `e` with balls of one level, its own or a coarser one: there only the 27 cells
    /// around its centre can hold a ball that reaches it. False when there are too many.
    bool collect_near(const Entry& e, int level, std::vector<BallOverlap>& found) const {
        const Entry here = at_level(ball(e.ball), level, e.ball);
        for (std::int64_t x = here.x - 1; x <= here.x + 1; ++x)
            for (std::int64_t y = here.y - 1; y <= here.y + 1; ++y) {
                const Entry first{level, x, y, here.z - 1, -1};
                auto other = std::lower_bound(entries_.begin(), entries_.end(), first);
                for (; other != entries_.end(); ++other) {
                    if (std::tie(other->level, other->x, other->y) != std::tie(level, x, y) ||
                        other->z > here.z + 1)
                        break;
                    const bool once = other->level != e.level || e.ball < other->ball;
                    if (once && !test(e.ball, other->ball, found)) return false;
                }
            }
        return true;
    }

    bool test(int a, int b, std::vector<BallOverlap>& found) const {
        const Ball& first = ball(a);
        const Ball& second = ball(b);
        const double depth =
            first.radius + second.radius - (first.position - second.position).norm();
        const double rounding =
            kPlaceRounding * (largest(first.position) + largest(second.position));
        if (depth <= kTouchingDepth * std::min(first.radius, second.radius) + rounding) return true;
        found.push_back({std::min(a, b), std::max(a, b), depth});
        return found.size() < kMostOverlaps;
    }

    const Scene& scene_;
    std::vector<Entry> entries_;
    std::vector<int> levels_;
};

/// Balls ordered by x, so that a surface meets only those abreast of it.
class BallsByX {
  public:
    BallsByX(const Scene& scene, const std::vector<bool>& sound) : scene_(scene) {
        for (std::size_t i = 0; i < scene.balls.size(); ++i) {
            if (!sound[i]) continue;
            order_.push_back(static_cast<int>(i));
            largest_ = std::max(largest_, scene.balls[i].radius);
        }
        std::sort(order_.begin(), order_.end(), [&](int a, int b) { return x(a) < x(b); });
    }

    /// False when all surfaces together have had too many balls to be compared with.
    bool collect(int surface, std::vector<SurfaceOverlap>& found, std::size_t& compared) const {
        const SurfaceShape& shape = scene_.surfaces[static_cast<std::size_t>(surface)].shape;
        const auto [low, high] = extent_x(shape);
        auto ball = std::lower_bound(order_.begin(), order_.end(), low - largest_,
                                     [&](int index, double bound) { return x(index) < bound; });
        for (; ball != order_.end() && x(*ball) <= high + largest_; ++ball) {
            if (++compared > kMostComparisons) return false;
            const Ball& one = scene_.balls[static_cast<std::size_t>(*ball)];
            const double distance = signed_distance(shape, one.position);
            const double depth = one.radius - distance;
            if (depth <= touching_depth(shape, one)) continue;
            const double behind = is_unbounded(shape) ? std::max(-distance, 0.0) : 0.0;
            found.push_back({*ball, surface, depth, behind});
            if (found.size() >= kMostOverlaps) return true;
        }
        return true;
    }

  private:
    double x(int ball) const { return scene_.balls[static_cast<std::size_t>(ball)].position.x(); }

    const Scene& scene_;
    std::vector<int> order_;
    double largest_ = 0;
};

}  // namespace

OverlapList find_overlaps(const Scene& scene, const std::vector<bool>& balls,
                          const std::vector<bool>& surfaces) {
    OverlapList found;
    BallGrid(scene, balls).collect(found.balls);
    std::sort(found.balls.begin(), found.balls.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first, a.second) < std::tie(b.first, b.second);
    });
    const BallsByX by_x(scene, balls);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < scene.surfaces.size() && !found.too_many; ++i)
        if (surfaces[i] && found.surfaces.size() < kMostOverlaps)
            found.too_many = !by_x.collect(static_cast<int>(i), found.surfaces, compared);
    std::sort(found.surfaces.begin(), found.surfaces.end(), [](const auto& a, const auto& b) {
        return std::tie(a.ball, a.surface) < std::tie(b.ball, b.surface);
    });
    return found;
}

}  // namespace carom
