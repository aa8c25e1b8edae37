#include "render/runs/motion_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "geometry/nearest.h"

namespace carom {

using Box = Eigen::AlignedBox3d;

double MotionExtent::Arc::support(const Vec3& n) const {
    const double np = n.dot(p), nv = n.dot(v), na = n.dot(a);
    double best = std::max(np, np + duration * (nv + 0.5 * duration * na));
    // n . (p + v s + a s^2 / 2) has its vertex at s = -n.v / n.a, a maximum where n.a < 0.
    if (na < 0) {
        const double s = -nv / na;
        if (s > 0 && s < duration) best = std::max(best, np + 0.5 * nv * s);
    }
    return best + radius * n.norm();
}

namespace {

/// The first time in (0, duration] at which p + v s + a s^2 / 2 leaves the box, else duration.
double time_inside(const Vec3& p, const Vec3& v, const Vec3& a, double duration, const Box& box) {
    if (!box.contains(p)) return 0;
    double first = duration;
    for (int i = 0; i < 3; ++i) {
        for (const double face : {box.min()[i], box.max()[i]}) {
            const double c = p[i] - face, half_a = 0.5 * a[i];
            // Roots of half_a s^2 + v s + c = 0 in the form that does not cancel.
            const double root = v[i] * v[i] - 4 * half_a * c;
            if (root < 0) continue;
            const double q = -0.5 * (v[i] + std::copysign(std::sqrt(root), v[i]));
            for (const double s : {half_a != 0 ? q / half_a : -1, q != 0 ? c / q : -1})
                if (s > 0) first = std::min(first, s);
        }
    }
    return first;
}

/// Of a parabola that leaves and arrives as the piece does. A curve turns by less than a radian,
/// and leaves that parabola by about 1 % of its length.
Vec3 mean_acceleration(const Piece& piece, double from, double to) {
    if (!piece.curve || !(to > from)) return piece.acceleration;
    const double h = to - from;
    return (2 / (h * h)) *
           (piece.position_at(to) - piece.position_at(from) - h * piece.velocity_at(from));
}

Box grown(const Box& box, double by) {
    return Box(box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by));
}

/// Places all around a circle: they lie so close that what is between them stands out by 1 % of its
/// radius.
std::vector<Vec3> on_circle(const Vec3& middle, const Vec3& axis, double radius) {
    constexpr int kPlaces = 24;
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    std::vector<Vec3> places;
    for (int i = 0; i < kPlaces; ++i) {
        const double turn = 2 * std::numbers::pi * i / kPlaces;
        places.push_back(middle + radius * (std::cos(turn) * u + std::sin(turn) * v));
    }
    return places;
}

}  // namespace

MotionExtent::MotionExtent(const Scene& scene, const Motion& motion) {
    for (const Ball& ball : scene.balls) largest_radius_ = std::max(largest_radius_, ball.radius);
    cut_departures(sort_arcs(scene, motion));
    if (ball_box_.isEmpty()) ball_box_ = Box(Vec3(-1, -1, 0), Vec3(1, 1, 2));
    add_surfaces(scene);
    add_floor_below(scene, motion);
    // A ball that stays where it is does not fill the picture.
    constexpr double kRoomAroundBall = 2.5;
    blobs_.push_back({ball_box_.center(), kRoomAroundBall * largest_radius_,
                      -std::numeric_limits<double>::infinity()});
}

void MotionExtent::keep(const Arc& arc) {
    arcs_.push_back(arc);
    Vec3 low, high;
    for (int i = 0; i < 3; ++i) {
        low[i] = -arc.support(-Vec3::Unit(i));
        high[i] = arc.support(Vec3::Unit(i));
    }
    ball_box_.extend(low);
    ball_box_.extend(high);
    const double bottom = high.z() - 2 * arc.radius;
    highest_bottom_ = arcs_.size() == 1 ? bottom : std::max(highest_bottom_, bottom);
}

MotionExtent::Sorted MotionExtent::sort_arcs(const Scene& scene, const Motion& motion) const {
    const std::size_t count = std::min(scene.balls.size(), motion.balls.size());
    constexpr double kNever = -1;
    std::vector<double> last_event(count, kNever);
    for (const Event& event : motion.events) {
        for (const int ball : {event.ball, event.other.is_surface ? -1 : event.other.index})
            if (ball >= 0 && static_cast<std::size_t>(ball) < count)
                last_event[static_cast<std::size_t>(ball)] = event.time;
    }

    const double begin = std::clamp(scene.film.start, 0.0, motion.duration);
    Sorted sorted{std::vector<std::vector<Arc>>(count), std::vector<std::vector<Arc>>(count),
                  false};
    for (std::size_t b = 0; b < count; ++b) {
        sorted.any_event = sorted.any_event || last_event[b] >= begin;
        const std::vector<Piece>& pieces = motion.balls[b].pieces();
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const bool last = k + 1 == pieces.size();
            const double end =
                last ? motion.duration : std::min(pieces[k + 1].start, motion.duration);
            const double from = std::max(begin, pieces[k].start);
            if (from > end || (from == end && !last)) continue;
            const BallState state = pieces[k].at(from);
            Arc arc{state.position, state.velocity,        mean_acceleration(pieces[k], from, end),
                    end - from,     scene.balls[b].radius, static_cast<int>(b)};
            if (!arc.p.allFinite() || !arc.v.allFinite() || !arc.a.allFinite()) continue;
            const bool departs = from >= last_event[b];
            if (departs) sorted.after[b].push_back(arc);
            // Where a ball stands at the beginning counts in any case.
            if (departs) arc.duration = 0;
            if (!departs || from == begin) sorted.before[b].push_back(arc);
        }
    }
    return sorted;
}

void MotionExtent::cut_departures(const Sorted& sorted) {
    for (const auto& arcs : sorted.before)
        for (const Arc& arc : arcs) keep(arc);
    if (ball_box_.isEmpty()) return;
    const double radii = (sorted.any_event ? kDepartureRadii : kFlightRadii) * largest_radius_;
    const Box limit = grown(ball_box_, std::max(radii, ball_box_.sizes().maxCoeff()));
    for (const auto& arcs : sorted.after) {
        for (Arc arc : arcs) {
            const double inside = time_inside(arc.p, arc.v, arc.a, arc.duration, limit);
            const bool leaves = inside < arc.duration;
            arc.duration = inside;
            keep(arc);
            if (leaves) break;
        }
    }
}

void MotionExtent::add_surface(const std::vector<Blob>& blobs) {
    Box bounds;
    for (const Blob& blob : blobs) bounds.extend(grown(Box(blob.center, blob.center), blob.radius));
    const Box limit = grown(ball_box_, 0.5 * ball_box_.sizes().maxCoeff());
    if (!bounds.intersects(limit)) return;
    for (const Blob& blob : blobs) {
        const Vec3 held = blob.center.cwiseMax(limit.min()).cwiseMin(limit.max());
        const double most = limit.sizes().maxCoeff();
        blobs_.push_back({held, held == blob.center ? std::min(blob.radius, most) : 0.0,
                          std::min(bounds.max().z(), limit.max().z())});
    }
}

void MotionExtent::add_surfaces(const Scene& scene) {
    using Blobs = std::vector<Blob>;
    for (const Surface& surface : scene.surfaces) {
        const Blobs blobs = std::visit(
            PerShape{
                [](const PlaneShape&) { return Blobs{}; },
                [](const BoxShape& box) {
                    Blobs corners;
                    for (int i = 0; i < 8; ++i) {
                        const Vec3 half(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
                        corners.push_back(
                            {box.center + box.orientation * half.cwiseProduct(box.size), 0, 0});
                    }
                    return corners;
                },
                [](const SphereShape& ball) {
                    return Blobs{{ball.center, ball.radius, 0}};
                },
                [](const CapsuleShape& rail) {
                    return Blobs{{rail.from, rail.radius, 0}, {rail.to, rail.radius, 0}};
                },
                [](const CylinderShape& drum) {
                    const Vec3 axis = (drum.to - drum.from).normalized();
                    Blobs rims;
                    for (const Vec3& end : {drum.from, drum.to})
                        for (const Vec3& p : on_circle(end, axis, drum.radius))
                            rims.push_back({p, 0, 0});
                    return rims;
                },
                [](const RingShape& ring) {
                    Blobs tube;
                    for (const Vec3& p : on_circle(ring.center, ring.axis, ring.radius))
                        tube.push_back({p, ring.tube_radius, 0});
                    return tube;
                },
                [](const BowlShape& bowl) {
                    Blobs wall;
                    for (int ring = 0; ring <= 6; ++ring) {
                        const double up = bowl.depth * ring / 6 - bowl.radius;
                        const double wide = bowl.radius * bowl.radius - up * up;
                        for (const Vec3& p :
                             on_circle(bowl.center + up * bowl.opening, bowl.opening,
                                       std::sqrt(std::max(wide, 0.0))))
                            wall.push_back({p, 0, 0});
                    }
                    return wall;
                },
                [](const PipeShape& pipe) {
                    Blobs wall;
                    const Vec3 axis = (pipe.to - pipe.from).normalized();
                    for (const Vec3& end : {pipe.from, pipe.to})
                        for (const Vec3& p : on_circle(end, axis, pipe.radius))
                            wall.push_back({nearest_on(pipe, p, 0).point, 0, 0});
                    return wall;
                }},
            surface.shape);
        if (!blobs.empty()) add_surface(blobs);
    }
}

void MotionExtent::add_floor_below(const Scene& scene, const Motion& motion) {
    const double reach = ball_box_.sizes().maxCoeff();
    for (const Surface& surface : scene.surfaces) {
        const auto* plane = std::get_if<PlaneShape>(&surface.shape);
        if (!plane || plane->normal.z() < 0.5) continue;
        for (const Trajectory& ball : motion.balls) {
            if (ball.pieces().empty()) continue;
            const Vec3 p = ball.at(std::clamp(scene.film.start, 0.0, motion.duration)).position;
            const double gap = plane->normal.dot(p) - plane->offset_m;
            if (gap >= 0 && gap <= reach)
                blobs_.push_back({p - gap * plane->normal, 0, p.z() - gap});
        }
    }
}

double MotionExtent::upright_support(const Vec3& n, double above_m) const {
    double best = -std::numeric_limits<double>::infinity();
    for (const Arc& arc : arcs_) best = std::max(best, arc.support(n));
    for (const Blob& blob : blobs_)
        if (blob.top >= above_m) best = std::max(best, n.dot(blob.center) + blob.radius * n.norm());
    return best;
}

double MotionExtent::support(const Vec3& n) const {
    return upright_support(n, -std::numeric_limits<double>::infinity());
}

int MotionExtent::outermost_ball(const Vec3& n) const {
    int ball = -1;
    double best = -std::numeric_limits<double>::infinity();
    for (const Arc& arc : arcs_) {
        const double reach = arc.support(n);
        if (reach > best) ball = arc.ball;
        best = std::max(best, reach);
    }
    return ball;
}

}  // namespace carom
