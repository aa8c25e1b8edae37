#include "sim/nearby_origin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/bounds.h"
#include "geometry/translation.h"

namespace carom {

namespace {

/// A scene is far from the origin where its middle is farther from it than so many times its own
/// extent: nearer ones lose less than two decimals, and keep their coordinates.
constexpr double kFar = 32;

/// Roundings of the coordinates that make a gap: those of two places, and of a plane's normal and
/// offset, which were divided by the normal's length.
constexpr double kRoundings = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

Vec3 nearby_origin(const Scene& scene) {
    Box3 around;
    for (const Ball& b : scene.balls) {
        around.extend(b.position - Vec3::Constant(b.radius));
        around.extend(b.position + Vec3::Constant(b.radius));
    }
    if (around.isEmpty()) return Vec3::Zero();
    for (const Surface& s : scene.surfaces) around.extend(bounds_of(s.shape));
    const Vec3 middle = around.center();
    double extent = around.sizes().maxCoeff();
    for (const Surface& s : scene.surfaces)
        if (const auto* plane = std::get_if<PlaneShape>(&s.shape))
            extent = std::max(extent, std::abs(plane->normal.dot(middle) - plane->offset_m));
    if (!(middle.cwiseAbs().maxCoeff() > kFar * extent)) return Vec3::Zero();
    // Floats: half of a double's digits are left to what is subtracted from them.
    const Vec3 origin = middle.cast<float>().cast<double>();
    return origin.allFinite() ? origin : Vec3::Zero();
}

Scene seen_from(const Scene& scene, const Vec3& origin) {
    Scene seen = scene;
    for (Ball& b : seen.balls) b.position -= origin;
    for (Surface& s : seen.surfaces) s.shape = seen_from(s.shape, origin);
    return seen;
}

void move_back(Motion& motion, const Vec3& origin) {
    for (Trajectory& ball : motion.balls) {
        Trajectory moved;
        moved.reserve(ball.pieces().size());
        for (Piece piece : ball.pieces()) {
            piece.position += origin;
            moved.append(std::move(piece));
        }
        ball = std::move(moved);
    }
    for (Event& event : motion.events) event.point += origin;
}

double place_rounding(const Vec3& origin) { return kRoundings * origin.cwiseAbs().maxCoeff(); }

}  // namespace carom
