// When a moving ball first touches a body: the first place where the gap between them would become
// negative. Gaps are polynomials of time, because both centres move on parabolas, except where a
// rim is round (conservative_advancement.h).
#pragma once

#include "geometry/shape.h"
#include "sim/math/polynomial.h"

namespace carom {

/// A centre relative to something at rest or moving itself, s seconds from now:
///   position + velocity s + acceleration s^2 / 2.
struct Path {
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 acceleration = Vec3::Zero();

    Vec3 at(double s) const { return position + s * (velocity + (0.5 * s) * acceleration); }
    Path relative_to(const Path& other) const {
        return {position - other.position, velocity - other.velocity,
                acceleration - other.acceleration};
    }
};

enum class ImpactState {
    kMiss,  ///< no impact up to the horizon; a closest approach of exactly 0 is a miss
    kHit,
    kPressed,  ///< they touch now and are pressed together: the contact lasts
    kCapped    ///< an iteration reached its bound: an error, never a silent miss
};

struct TimeOfImpact {
    ImpactState state = ImpactState::kMiss;
    double s = 0;  ///< seconds from now, when state is kHit
};

/// `touching`: the two are in contact now and do not approach. Their gap is then exactly 0 at s =
/// 0, whatever rounding left of it, and only the next contact counts. Where they do not move apart
/// either, the second derivative of the gap says whether the contact lasts.
TimeOfImpact impact_with_plane(const Path& ball, double radius, const PlaneShape& plane,
                               bool touching, double horizon);
/// `path` is the ball's centre relative to the other centre, `distance` the sum of the radii.
TimeOfImpact impact_with_sphere(const Path& path, double distance, bool touching, double horizon);
TimeOfImpact impact_with_capsule(const Path& ball, double radius, const CapsuleShape& capsule,
                                 bool touching, double horizon);
TimeOfImpact impact_with_box(const Path& ball, double radius, const BoxShape& box, bool touching,
                             double horizon);
TimeOfImpact impact_with_surface(const Path& ball, double radius, const SurfaceShape& shape,
                                 bool touching, double horizon);

}  // namespace carom
