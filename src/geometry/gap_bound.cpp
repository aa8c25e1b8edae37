#include "geometry/gap_bound.h"

#include "geometry/around_axis.h"

namespace carom {

GapBound gap_bound(const CylinderShape& cylinder, const Vec3& center, double radius) {
    const Nearest nearest = nearest_on(cylinder, center, radius);
    GapBound bound;
    bound.gap = nearest.gap;
    bound.normal = nearest.normal;
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
