#include "geometry/feature.h"

#include "geometry/around_axis.h"
#include "geometry/feature_side.h"

namespace carom {

namespace {

/// The border of a hole's middle is so wide, as a part of its radius: where the border of a
/// circle's half and that of the middle meet, places have that many digits.
constexpr double kCentredBorder = 1e-4;

Mat3 across_axis(const Vec3& axis) { return Mat3::Identity() - axis * axis.transpose(); }

Feature feature_of(const PlaneShape& plane, const CenterMotion&, double radius) {
    Feature f;
    f.origin = plane.offset_m * plane.normal;
    f.across = plane.normal * plane.normal.transpose();
    f.distance = radius;
    return f;
}

Feature feature_of(const SphereShape& sphere, const CenterMotion&, double radius) {
    Feature f;
    f.origin = sphere.center;
    f.distance = radius + sphere.radius;
    return f;
}

Feature feature_of(const CapsuleShape& capsule, const CenterMotion& center, double radius) {
    Feature f;
    const Vec3 d = capsule.to - capsule.from;
    const Vec3 axis = d.normalized();
    const double half = 0.5 * d.norm(), along = axis.dot(center.x - capsule.from);
    const double border = kBorder * (center.x.cwiseAbs().maxCoeff() + radius);
    const int side = side_of({along - half, axis.dot(center.v), axis.dot(center.pull)}, half,
                             border, center.v.norm());
    f.distance = radius + capsule.radius;
    if (side < 0) {
        f.origin = capsule.from;
        f.add_border(-axis, -axis.dot(capsule.from));
    } else if (side > 0) {
        f.origin = capsule.to;
        f.add_border(axis, axis.dot(capsule.to));
    } else {
        f.origin = capsule.from;
        f.across = across_axis(axis);
        f.add_border(axis, axis.dot(capsule.from));
        f.add_border(-axis, -axis.dot(capsule.to));
    }
    return f;
}

Feature feature_of(const BoxShape& box, const CenterMotion& center, double radius) {
    Feature f;
    const Mat3 world_from_box = box.orientation.toRotationMatrix();
    const double border = kBorder * (center.x.cwiseAbs().maxCoeff() + radius);
    const double speed = center.v.norm();
    f.origin = box.center;
    f.across = Mat3::Zero();
    f.distance = radius;
    for (int i = 0; i < 3; ++i) {
        const Vec3 axis = world_from_box.col(i);
        const double place = axis.dot(center.x - box.center), half = 0.5 * box.size[i];
        const double middle = axis.dot(box.center);
        const int sign =
            side_of({place, axis.dot(center.v), axis.dot(center.pull)}, half, border, speed);
        if (sign != 0) {
            f.origin += (sign * half) * axis;
            f.across += axis * axis.transpose();
            f.add_border(sign * axis, sign * middle + half);
        } else {
            f.add_border(axis, middle - half);
            f.add_border(-axis, -middle - half);
        }
    }
    // Through rounding all three may look inside; then the face that is nearest is the one.
    if (f.across.isZero(0)) {
        Vec3 place = box.orientation.conjugate() * (center.x - box.center);
        int nearest = 0;
        (place.cwiseAbs() - 0.5 * box.size).maxCoeff(&nearest);
        const Vec3 normal = (place[nearest] < 0 ? -1.0 : 1.0) * world_from_box.col(nearest);
        f.origin += 0.5 * box.size[nearest] * normal;
        f.across = normal * normal.transpose();
    }
    return f;
}

/// A circle whose tube of the radius of `distance` the ball's centre is on.
Feature circle_feature(const Vec3& middle, const Vec3& axis, double core_radius, double distance) {
    Feature f;
    f.origin = middle;
    f.core_axis = axis;
    f.core_radius = core_radius;
    f.distance = distance;
    return f;
}

/// The same for a ball at x, of which the circle's hole may hold a part: a ball in the middle of a
/// hole that is too small for it touches it all around, which holds it along the axis and across.
Feature circle_or_seat(const Vec3& middle, const Vec3& axis, double core_radius, double distance,
                       const CenterMotion& center, double radius) {
    Feature f = circle_feature(middle, axis, core_radius, distance);
    if (distance <= core_radius) return f;
    // On the border of the middle the motion decides.
    const AroundAxis at(middle, axis, center.x);
    const double centred = kCentred * core_radius, off = at.away / centred - 1;
    const bool outside = std::abs(off) > kCentredBorder ? off > 0 : at.outward.dot(center.v) > 0;
    if (outside) {
        // Where the ball comes to the middle, the other side of the hole meets it.
        f.half = at.outward;
        f.add_border(f.half, f.half.dot(middle) + centred);
        return f;
    }
    const double height = std::sqrt((distance - core_radius) * (distance + core_radius));
    Feature seat;
    seat.origin = middle + (at.along < 0 ? -1 : 1) * (height - radius) * axis;
    seat.across = axis * axis.transpose();
    seat.distance = radius;
    seat.hold = core_radius / height;
    seat.add_round_border(middle, axis, centred, -1);
    return seat;
}

/// How a centre moves away from an axis. A centre that goes by `around` [m/s] about the axis is
/// drawn outwards as if pulled by around^2 / away.
AxisMotion motion_away(const AroundAxis& at, const Vec3& axis, const CenterMotion& center) {
    const double rate = at.outward.dot(center.v);
    const double around = axis.cross(at.outward).dot(center.v);
    const double drawn = at.away > 0 ? around * around / at.away : 0;
    return {at.away, rate, at.outward.dot(center.pull) + drawn};
}

Feature end_of(const Vec3& end, const Vec3& outward, const Vec3& axis, double rim, double radius) {
    Feature f;
    f.origin = end;
    f.across = outward * outward.transpose();
    f.distance = radius;
    f.add_round_border(end, axis, rim, -1);
    return f;
}

Feature shaft_of(const CylinderShape& cylinder, const Vec3& axis, double radius) {
    Feature f;
    f.origin = cylinder.from;
    f.across = across_axis(axis);
    f.distance = radius + cylinder.radius;
    f.add_border(axis, axis.dot(cylinder.from));
    f.add_border(-axis, -axis.dot(cylinder.to));
    return f;
}

Feature feature_of(const CylinderShape& cylinder, const CenterMotion& center, double radius) {
    const Vec3 whole = cylinder.to - cylinder.from, axis = whole.normalized();
    const double half = 0.5 * whole.norm();
    const double border = kBorder * (center.x.cwiseAbs().maxCoeff() + radius);
    const double speed = center.v.norm();
    const AroundAxis at(cylinder.from, axis, center.x);
    const double place = at.along - half;
    int side = side_of({place, axis.dot(center.v), axis.dot(center.pull)}, half, border, speed);
    const bool beyond_rim =
        side_of(motion_away(at, axis, center), cylinder.radius, border, speed) > 0;
    // Through rounding the centre may look inside; then the face that is nearest is the one.
    if (side == 0 && !beyond_rim && std::abs(place) - half > at.away - cylinder.radius)
        side = place < 0 ? -1 : 1;
    if (side == 0) return shaft_of(cylinder, axis, radius);
    const Vec3& end = side < 0 ? cylinder.from : cylinder.to;
    const Vec3 outward = side * axis;
    if (!beyond_rim) return end_of(end, outward, axis, cylinder.radius, radius);
    Feature f = circle_feature(end, axis, cylinder.radius, radius);
    f.add_border(outward, outward.dot(end));
    f.add_round_border(end, axis, cylinder.radius, 1);
    return f;
}

Feature feature_of(const RingShape& ring, const CenterMotion& center, double radius) {
    return circle_or_seat(ring.center, ring.axis, ring.radius, radius + ring.tube_radius, center,
                          radius);
}

/// How a centre goes over a border. One that goes by `around` [m/s] about the border's axis is
/// drawn outwards as if pulled by around^2 / away.
AxisMotion motion_over(const FeatureBorder& border, const CenterMotion& center) {
    AxisMotion m{border.margin(center.x), border.direction.dot(center.v),
                 border.direction.dot(center.pull)};
    if (border.slant == 0) return m;
    const AroundAxis at(border.origin, border.axis, center.x);
    const AxisMotion away = motion_away(at, border.axis, center);
    m.rate += border.slant * away.rate;
    m.pull += border.slant * away.pull;
    return m;
}

/// A round wall around a core, met from the side where the centre is.
void set_wall(Feature& f, double wall, double away, double radius) {
    f.hollow = away < wall;
    f.distance = f.hollow ? wall - radius : wall + radius;
}

Feature feature_of(const BowlShape& bowl, const CenterMotion& center, double radius) {
    const double border = kBorder * (center.x.cwiseAbs().maxCoeff() + radius);
    // The cone through the rim, from the sphere's middle; beyond it the rim is what is met.
    const double up = bowl.rim_height() / bowl.radius, out = bowl.rim_radius() / bowl.radius;
    const FeatureBorder cone{out * bowl.opening, out * bowl.opening.dot(bowl.center), -up,
                             bowl.center, bowl.opening};
    if (!bowl.is_closed() && leads_beyond(motion_over(cone, center), border, center.v.norm())) {
        Feature rim = circle_or_seat(bowl.center + bowl.rim_height() * bowl.opening, bowl.opening,
                                     bowl.rim_radius(), radius, center, radius);
        rim.add_border(cone);
        return rim;
    }
    Feature f;
    f.origin = bowl.center;
    set_wall(f, bowl.radius, (center.x - bowl.center).norm(), radius);
    if (!bowl.is_closed()) f.add_border(cone.reversed());
    return f;
}

Feature feature_of(const PipeShape& pipe, const CenterMotion& center, double radius) {
    const Vec3 whole = pipe.to - pipe.from, axis = whole.normalized();
    const double half = 0.5 * whole.norm(), speed = center.v.norm();
    const double border = kBorder * (center.x.cwiseAbs().maxCoeff() + radius);
    const AroundAxis at(pipe.from, axis, center.x);
    const int side =
        side_of({at.along - half, axis.dot(center.v), axis.dot(center.pull)}, half, border, speed);
    const Vec3 end = side > 0 ? pipe.to : pipe.from;
    // Beyond it the edges are what is met: where the angle from the wall's middle is too large.
    const double cosine = std::cos(0.5 * pipe.angle);
    const FeatureBorder slot{pipe.opening, pipe.opening.dot(pipe.from), cosine, pipe.from, axis};
    const bool beyond = !pipe.is_tube() && leads_beyond(motion_over(slot, center), border, speed);
    Feature f;
    f.origin = end;
    if (beyond) {
        const Vec3 across = axis.cross(pipe.opening);
        const double aside = across.dot(center.x - pipe.from);
        const AxisMotion over{aside, across.dot(center.v), across.dot(center.pull)};
        const double edge = leads_beyond(over, border, speed) ? 1 : -1;
        f.origin +=
            pipe.radius * (edge * std::sin(0.5 * pipe.angle) * across - cosine * pipe.opening);
        f.distance = radius;
        f.add_border(slot);
        f.add_border(edge * across, edge * across.dot(pipe.from));
    } else if (side == 0) {
        set_wall(f, pipe.radius, at.away, radius);
        if (!pipe.is_tube()) f.add_border(slot.reversed());
    } else if (pipe.is_tube()) {
        f = circle_or_seat(end, axis, pipe.radius, radius, center, radius);
    } else {
        f = circle_feature(end, axis, pipe.radius, radius);
        f.add_border(slot.reversed());
    }
    if (side == 0) {
        f.across = across_axis(axis);
        f.add_border(axis, axis.dot(pipe.from));
        f.add_border(-axis, -axis.dot(pipe.to));
    } else {
        f.add_border(side * axis, side * axis.dot(end));
    }
    return f;
}

bool has_flat(const PlaneShape&, const Vec3&) { return true; }
bool has_flat(const SphereShape&, const Vec3&) { return false; }
bool has_flat(const CapsuleShape&, const Vec3&) { return false; }
bool has_flat(const CylinderShape& cylinder, const Vec3& normal) {
    return std::abs((cylinder.to - cylinder.from).normalized().dot(normal)) > 1 - 1e-12;
}
bool has_flat(const RingShape&, const Vec3&) { return false; }
bool has_flat(const BowlShape&, const Vec3&) { return false; }
bool has_flat(const PipeShape&, const Vec3&) { return false; }
bool has_flat(const BoxShape& box, const Vec3& normal) {
    const Vec3 local = box.orientation.conjugate() * normal;
    return local.cwiseAbs().maxCoeff() > 1 - 1e-12;
}

}  // namespace

double FeatureBorder::margin(const Vec3& x) const {
    const double straight = direction.dot(x) - offset;
    if (slant == 0) return straight;
    return straight + slant * AroundAxis(origin, axis, x).away;
}

Vec3 Feature::from_core(const Vec3& x) const {
    if (!has_circle()) return across * (x - origin);
    const AroundAxis at = around_axis(x);
    return (at.away - core_radius) * at.outward + at.along * core_axis;
}

double Feature::gap_growth(const Vec3& x, const Vec3& way) const {
    const Vec3 q = from_core(x), after = from_core(x + way);
    const double sum = hollow ? -(q.norm() + after.norm()) : q.norm() + after.norm();
    // Of q^2: differences of squares are those of the numbers times their sums.
    if (!has_circle()) {
        const Vec3 moved = across * way;
        return moved.dot(2 * q + moved) / sum;
    }
    const AroundAxis from = around_axis(x), to = around_axis(x + way);
    const double along = core_axis.dot(way);
    const Vec3 moved = way - along * core_axis;
    const double out = moved.dot(2 * from.away * from.outward + moved) / (from.away + to.away);
    return (out * (from.away + to.away - 2 * core_radius) + along * (from.along + to.along)) / sum;
}

FeatureMotion Feature::motion_at(const Vec3& x, const Vec3& v) const {
    FeatureMotion m;
    const Vec3 q = from_core(x);
    Vec3 q_rate = across * v;
    m.turning_speed = q_rate;
    if (has_circle()) {
        // The nearest point of the circle goes along with what leads around the axis.
        const AroundAxis at = around_axis(x);
        const Vec3 around = core_axis.cross(at.outward);
        q_rate = v - (core_radius / at.away * around.dot(v)) * around;
        m.turning_speed = v;
    }
    m.distance = q.norm();
    m.gap = m.distance - distance;
    m.normal = q / m.distance;
    m.normal_rate = (q_rate - m.normal.dot(q_rate) * m.normal) / m.distance;
    if (hollow) {
        m.gap = -m.gap;
        m.normal = -m.normal;
        m.normal_rate = -m.normal_rate;
    }
    return m;
}

Feature feature_at(const SurfaceShape& shape, const CenterMotion& center, double radius) {
    return std::visit([&](const auto& s) { return feature_of(s, center, radius); }, shape);
}

bool is_flat(const SurfaceShape& shape, const Vec3& normal) {
    return std::visit([&](const auto& s) { return has_flat(s, normal); }, shape);
}

}  // namespace carom
