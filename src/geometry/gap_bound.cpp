#include "geometry/gap_bound.h"

#include <algorithm>
#include <cmath>

#include "geometry/around_axis.h"

namespace carom {

GapBound gap_bound(const CylinderShape& cylinder, const Vec3& center, double radius) {
    const Nearest nearest = nearest_on(cylinder, center, radius);
    GapBound bound;
    bound.gap = nearest.gap;
    bound.normal = nearest.normal;
    return bound;
}

namespace {

GapBound bound_of(const Nearest& nearest) {
    GapBound bound;
    bound.gap = nearest.gap;
    bound.normal = nearest.normal;
    return bound;
}

/// Within half of a distance from what bends it by 1 / distance.
void bend_by(GapBound& bound, double distance) {
    bound.within = 0.5 * distance;
    bound.bend = distance > 0 ? 2 / distance : 0;
}

}  // namespace

GapBound gap_bound(const BowlShape& bowl, const Vec3& center, double radius) {
    GapBound bound = bound_of(nearest_on(bowl, center, radius));
    const AroundAxis at(bowl.center, bowl.opening, center);
    const double away = std::hypot(at.along, at.away);
    if (bowl.is_closed()) {
        bend_by(bound, away);
        return bound;
    }
    // Beyond the cone through the rim that is the nearest.
    const double beyond =
        (bowl.rim_radius() * at.along - bowl.rim_height() * at.away) / bowl.radius;
    const double here = beyond < 0 ? away : at.away;
    if (std::min(std::abs(beyond), 0.5 * here) > 0.5 * std::min(away, at.away)) {
        bend_by(bound, here);
        bound.within = std::min(bound.within, std::abs(beyond));
    } else {
        bend_by(bound, std::min(away, at.away));
    }
    return bound;
}

GapBound gap_bound(const PipeShape& pipe, const Vec3& center, double radius) {
    GapBound bound = bound_of(nearest_on(pipe, center, radius));
    const Vec3 axis = (pipe.to - pipe.from).normalized();
    const AroundAxis at(pipe.from, axis, center);
    bend_by(bound, at.away);
    const Vec3 out = at.away * at.outward;
    if (!pipe.is_tube() && pipe.opening.dot(out) > 0)
        bound.within = std::min(bound.within, std::abs(axis.cross(pipe.opening).dot(out)));
    return bound;
}

GapBound gap_bound(const RingShape& ring, const Vec3& center, double radius) {
    const Nearest nearest = nearest_on(ring, center, radius);
    GapBound bound;
    bound.gap = nearest.gap;
    bound.normal = nearest.normal;
    const double away = AroundAxis(ring.center, ring.axis, center).away;
    const double beyond = away - ring.radius;
    if (away <= kCentred * ring.radius) {  // only that distances change by no more than the way
        bound.within = 0;
    } else if (beyond >= 0.5 * away) {  // outside of the circle for as long as that
        bound.within = beyond;
    } else {
        bound.within = 0.5 * away;
        bound.bend = 2 / away;
    }
    return bound;
}

}  // namespace carom
