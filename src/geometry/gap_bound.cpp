#include "geometry/gap_bound.h"

namespace carom {

GapBound gap_bound(const CylinderShape& cylinder, const Vec3& center, double radius) {
    const Nearest nearest = nearest_on(cylinder, center, radius);
    GapBound bound;
    bound.gap = nearest.gap;
    bound.normal = nearest.normal;
    return bound;
}

}  // namespace carom
