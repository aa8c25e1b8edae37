#include "sim/collide/time_of_impact_high_degree.h"

#include <algorithm>
#include <cmath>

#include "geometry/feature_side.h"
#include "geometry/nearest.h"
#include "sim/collide/conservative_advancement.h"
#include "sim/math/bernstein_roots.h"

namespace carom {

namespace {

/// A crossing of one feature's gap counts if the whole body is as near then, up to the rounding of
/// a polynomial of high degree in places of this size.
constexpr double kGapRounding = 1e-13;

/// Rates of a gap below this fraction of the speed are rounding of a zero.
constexpr double kStillRate = 2e-14;

/// Features whose gap is below this fraction of their size are those in contact.
constexpr double kContact = 1e-9;

LongPolynomial plane_gap(const HighDegreePath& p, const Vec3& normal, double offset) {
    LongPolynomial gap;
    gap.degree = p.c.size() - 1;
    for (std::size_t i = 0; i < p.c.size(); ++i) gap.c[i] = normal.dot(p.c[i]);
    gap.c[0] -= offset;
    return gap;
}

/// |across (p - origin)|^2 - d^2
LongPolynomial round_gap(const HighDegreePath& p, const Vec3& origin, const Mat3& across,
                         double d) {
    std::array<Vec3, 9> q;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = across * p.c[i];
    q[0] = across * (p.c[0] - origin);
    LongPolynomial gap;
    gap.degree = 2 * (q.size() - 1);
    for (std::size_t i = 0; i < q.size(); ++i) {
        gap.c[2 * i] += q[i].squaredNorm();
        for (std::size_t j = i + 1; j < q.size(); ++j) gap.c[i + j] += 2 * q[i].dot(q[j]);
    }
    // The difference of squares without their rounding.
    const double near = q[0].norm();
    gap.c[0] = (near - d) * (near + d);
    return gap;
}

/// The first touch of all features of one body.
class FirstTouch {
  public:
    FirstTouch(const HighDegreePath& path, bool touching) : path_(path), touching_(touching) {}

    /// `rate_scale`: how the gap's rate goes with the distance's. `holds`: the motion leads to this
    /// feature, which therefore decides whether they press. `touched`: whether the whole body is
    /// met there.
    template <class Touched>
    void offer(LongPolynomial gap, double size, double rate_scale, bool holds, Touched&& touched) {
        if (result_.state == ImpactState::kCapped) return;
        if (touching_ && std::abs(gap.c[0]) <= kContact * size * rate_scale) {
            const LongPolynomial whole = gap;
            const double still = kStillRate * rate_scale * path_.reach();
            gap = gap.divided_by_u();
            if (gap.c[0] <= still) {
                gap = gap.divided_by_u();
                if (std::abs(gap.c[0]) <= still && path_.flies) {
                    // Nothing moves or pulls it in yet: it is met once it is in by a rounding.
                    gap = whole;
                    gap.c[0] = kGapRounding * size * rate_scale;
                } else if (gap.c[0] < 0) {
                    pressed_ |= holds;
                    return;
                }
            }
        }
        DownwardCrossings crossings(gap);
        for (double u = 0; crossings.next(u);) {
            const double s = u * path_.seconds;
            if (result_.state == ImpactState::kHit && s >= result_.s) return;
            if (!touched(u)) continue;
            result_ = {ImpactState::kHit, s};
            return;
        }
        if (crossings.capped()) result_ = {ImpactState::kCapped, 0};
    }
    TimeOfImpact result() const {
        return pressed_ ? TimeOfImpact{ImpactState::kPressed, 0} : result_;
    }

  private:
    const HighDegreePath& path_;
    bool touching_;
    bool pressed_ = false;
    TimeOfImpact result_;
};

Mat3 across_axis(const Vec3& axis) { return Mat3::Identity() - axis * axis.transpose(); }

/// The side of an extent around `middle` that the beginning of a path leads to.
int side_along(const HighDegreePath& p, const Vec3& axis, const Vec3& middle, double half,
               double radius) {
    const double border = kBorder * (p.c[0].cwiseAbs().maxCoeff() + radius);
    return side_of({axis.dot(p.c[0] - middle), axis.dot(p.c[1]), axis.dot(p.c[2])}, half, border,
                   p.c[1].norm());
}

template <class Touched>
void offer_features(FirstTouch& first, const HighDegreePath& p, double radius, const BoxShape& box,
                    const Touched& touched) {
    using Sides = std::array<int, 3>;
    const Mat3 axes = box.orientation.toRotationMatrix();
    Sides sides{};
    for (int i = 0; i < 3; ++i)
        sides[static_cast<std::size_t>(i)] =
            side_along(p, axes.col(i), box.center, 0.5 * box.size[i], radius);
    for (int i = 0; i < 3; ++i)
        for (const int side : {-1, 1}) {
            const Vec3 normal = side * axes.col(i);
            const double offset = normal.dot(box.center) + 0.5 * box.size[i] + radius;
            Sides face{};
            face[static_cast<std::size_t>(i)] = side;
            first.offer(plane_gap(p, normal, offset), radius, 1, sides == face, touched);
        }
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 at = box.center;
        Sides there{};
        for (int i = 0; i < 3; ++i) {
            const int side = (corner >> i & 1) != 0 ? 1 : -1;
            there[static_cast<std::size_t>(i)] = side;
            at += 0.5 * side * box.size[i] * axes.col(i);
        }
        first.offer(round_gap(p, at, Mat3::Identity(), radius), radius, 2 * radius, sides == there,
                    touched);
        // The edges that start at this corner and run along +axis.
        for (int i = 0; i < 3; ++i) {
            if (there[static_cast<std::size_t>(i)] > 0) continue;
            Sides along = there;
            along[static_cast<std::size_t>(i)] = 0;
            first.offer(round_gap(p, at, across_axis(axes.col(i)), radius), radius, 2 * radius,
                        sides == along, touched);
        }
    }
}

/// One feature: where its gap closes the body is met.
bool always(double) { return true; }

template <class Touched>
void offer_features(FirstTouch& first, const HighDegreePath& p, double radius,
                    const PlaneShape& plane, const Touched&) {
    first.offer(plane_gap(p, plane.normal, plane.offset_m + radius), radius, 1, true, always);
}

template <class Touched>
void offer_features(FirstTouch& first, const HighDegreePath& p, double radius,
                    const SphereShape& sphere, const Touched&) {
    const double d = radius + sphere.radius;
    first.offer(round_gap(p, sphere.center, Mat3::Identity(), d), d, 2 * d, true, always);
}

template <class Touched>
void offer_features(FirstTouch& first, const HighDegreePath& p, double radius,
                    const CapsuleShape& capsule, const Touched& touched) {
    const double d = radius + capsule.radius;
    const Vec3 whole = capsule.to - capsule.from, axis = whole.normalized();
    const int side =
        side_along(p, axis, 0.5 * (capsule.from + capsule.to), 0.5 * whole.norm(), radius);
    first.offer(round_gap(p, capsule.from, across_axis(axis), d), d, 2 * d, side == 0, touched);
    first.offer(round_gap(p, capsule.from, Mat3::Identity(), d), d, 2 * d, side < 0, touched);
    first.offer(round_gap(p, capsule.to, Mat3::Identity(), d), d, 2 * d, side > 0, touched);
}

template <class Shape>
TimeOfImpact impact_with(const Shape& shape, const HighDegreePath& ball, double radius,
                         bool touching) {
    // Of what touches, the gap of now counts as 0, and so does a later one of the same size.
    const double none = touching ? std::max(nearest_on(shape, ball.c[0], radius).gap, 0.0) : 0;
    FirstTouch first(ball, touching);
    const auto touched = [&](double u) {
        const Vec3 center = ball.at(u);
        const double scale =
            ball.c[0].cwiseAbs().maxCoeff() + center.cwiseAbs().maxCoeff() + ball.reach() + radius;
        return nearest_on(shape, center, radius).gap <= none + kGapRounding * scale;
    };
    offer_features(first, ball, radius, shape, touched);
    return first.result();
}

TimeOfImpact impact_with(const CylinderShape& cylinder, const HighDegreePath& ball, double radius,
                         bool touching) {
    return advance_to_impact(ball, radius, cylinder, touching);
}
TimeOfImpact impact_with(const RingShape& ring, const HighDegreePath& ball, double radius,
                         bool touching) {
    return advance_to_impact(ball, radius, ring, touching);
}
TimeOfImpact impact_with(const BowlShape& bowl, const HighDegreePath& ball, double radius,
                         bool touching) {
    return advance_to_impact(ball, radius, bowl, touching);
}
TimeOfImpact impact_with(const PipeShape& pipe, const HighDegreePath& ball, double radius,
                         bool touching) {
    return advance_to_impact(ball, radius, pipe, touching);
}

}  // namespace

Vec3 HighDegreePath::at(double u) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = c.size(); i-- > 0;) sum = c[i] + u * sum;
    return sum;
}

HighDegreePath HighDegreePath::relative_to(const HighDegreePath& other) const {
    HighDegreePath path = *this;
    for (std::size_t i = 0; i < c.size(); ++i) path.c[i] -= other.c[i];
    return path;
}

double HighDegreePath::reach() const {
    double sum = 0;
    for (std::size_t i = 1; i < c.size(); ++i) sum += c[i].norm();
    return sum;
}

HighDegreePath high_degree_path(const Piece& piece, double from, double seconds) {
    HighDegreePath path;
    path.seconds = seconds;
    auto& c = path.c;
    if (!piece.curve) {
        c[0] = piece.position_at(from);
        c[1] = seconds * piece.velocity_at(from);
        c[2] = (0.5 * seconds * seconds) * piece.acceleration;
        return path;
    }
    // In z = s / h, then shifted to z0 (W. G. Horner) and scaled.
    const double h = piece.curve->seconds;
    c[0] = piece.position;
    c[1] = h * piece.velocity;
    c[2] = (0.5 * h * h) * piece.acceleration;
    for (std::size_t i = 0; i < 6; ++i) c[i + 3] = piece.curve->position[i];
    const double z0 = (from - piece.start) / h, scale = seconds / h;
    for (std::size_t i = 0; z0 != 0 && i < c.size(); ++i)
        for (std::size_t j = c.size() - 1; j-- > i;) c[j] += z0 * c[j + 1];
    double power = 1;
    for (Vec3& term : c) {
        term *= power;
        power *= scale;
    }
    return path;
}

TimeOfImpact impact_with_sphere(const HighDegreePath& path, double distance, bool touching) {
    if (!touching && path.c[0].norm() - path.reach() > distance) return {};
    FirstTouch first(path, touching);
    first.offer(round_gap(path, Vec3::Zero(), Mat3::Identity(), distance), distance, 2 * distance,
                true, [](double) { return true; });
    return first.result();
}

TimeOfImpact impact_with_surface(const HighDegreePath& ball, double radius,
                                 const SurfaceShape& shape, bool touching) {
    if (!touching && nearest_on(shape, ball.c[0], radius).gap > ball.reach()) return {};
    return std::visit([&](const auto& s) { return impact_with(s, ball, radius, touching); }, shape);
}

double seconds_above(const HighDegreePath& path, const Vec3& direction, double offset) {
    if (direction.dot(path.c[0]) - offset > path.reach()) return path.seconds;
    DownwardCrossings crossings(plane_gap(path, direction, offset));
    double u = 1;
    return crossings.next(u) ? u * path.seconds : path.seconds;
}

}  // namespace carom
