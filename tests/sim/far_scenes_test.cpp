// Scenes far from the origin move as they do near it, up to the rounding of their own coordinates.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "exact_scenes.h"
#include "shapes.h"
#include "sim/nearby_origin.h"

namespace carom::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

Vec3 direction() { return Vec3(10, -7, 3).normalized(); }

SurfaceShape moved(SurfaceShape shape, const Vec3& by) {
    if (auto* plane = std::get_if<PlaneShape>(&shape)) plane->offset_m += plane->normal.dot(by);
    if (auto* box = std::get_if<BoxShape>(&shape)) box->center += by;
    if (auto* sphere = std::get_if<SphereShape>(&shape)) sphere->center += by;
    if (auto* capsule = std::get_if<CapsuleShape>(&shape)) {
        capsule->from += by;
        capsule->to += by;
    }
    return shape;
}

Scene moved(const Scene& scene, const Vec3& by) {
    Scene other = scene;
    for (Surface& s : other.surfaces) s.shape = moved(s.shape, by);
    for (Ball& b : other.balls) b.position += by;
    return other;
}

// ---- The origin nearby
// ----------------------------------------------------------------------------

TEST(NearbyOrigin, ScenesAboutTheOriginKeepTheirCoordinates) {
    Scene scene = exact_scene(1, 0, kGravity);
    add_plane(scene);
    add_ball(scene, Vec3(0, 0, 1.9));
    EXPECT_TRUE(nearby_origin(scene).isZero(0));
    EXPECT_TRUE(nearby_origin(moved(scene, Vec3(20, -7, 1))).isZero(0));
    // A far plane, or a far body, is a part of the scene like others.
    scene.balls[0].position.z() = 1e6;
    EXPECT_TRUE(nearby_origin(scene).isZero(0));
    EXPECT_TRUE(nearby_origin(Scene{}).isZero(0));
}

TEST(NearbyOrigin, FarScenesLoseNothingWhenSeenFromIt) {
    Scene scene = exact_scene(1, 0, kGravity);
    add_plane(scene, Vec3(1, 2, 3));
    add_shape(scene, SphereShape{Vec3(0.3, 0.1, 1), 0.2});
    add_ball(scene, Vec3(0.1, 0.7, 1.9));
    for (const double far : {1e3, 1e6, 1e9}) {
        const Scene there = moved(scene, far * direction());
        const Vec3 origin = nearby_origin(there);
        EXPECT_LE((origin - far * direction()).norm(), 2 + 1e-7 * far);
        const Scene seen = seen_from(there, origin);
        const auto& sphere = std::get<SphereShape>(seen.surfaces[1].shape);
        // The differences of the doubles, digit by digit.
        EXPECT_EQ(seen.balls[0].position - sphere.center,
                  there.balls[0].position - std::get<SphereShape>(there.surfaces[1].shape).center);
        EXPECT_EQ(seen.balls[0].position + origin, there.balls[0].position);
        const auto& plane = std::get<PlaneShape>(seen.surfaces[0].shape);
        const double height = plane.normal.dot(seen.balls[0].position) - plane.offset_m;
        const auto& here = std::get<PlaneShape>(scene.surfaces[0].shape);
        EXPECT_NEAR(height, here.normal.dot(scene.balls[0].position), 8 * kEpsilon * far + 1e-15);
    }
}

// ---- Motions
// --------------------------------------------------------------------------------------

/// A ball that drops on an oblique plane, along its normal.
Scene oblique_drop(double restitution, double height, const Vec3& foot) {
    const Vec3 n = Vec3(1, -2, 3).normalized();
    Scene scene = exact_scene(restitution, 0, 0);
    scene.simulation.gravity = -kGravity * n;
    add_plane(scene, n, n.dot(foot));
    add_ball(scene, foot + (0.1 + height) * n);
    return scene;
}

TEST(FarScenes, ABounceHasItsClosedFormAnywhere) {
    const double e = 0.7, height = 1.8;
    for (const double far : {0.0, 1e3, 1e6, 1e9}) {
        Scene scene = oblique_drop(e, height, far * direction());
        const SimulationResult result = run(scene, 6);
        const std::vector<Event> impacts = impacts_of(result.motion);
        ASSERT_GT(impacts.size(), 12u);
        const double first = std::sqrt(2 * height / kGravity);
        double worst = 0;
        for (std::size_t i = 0; i < 12; ++i) {
            const double after = 2 * e * (1 - std::pow(e, double(i))) / (1 - e);
            worst = std::max(worst, std::abs(impacts[i].time - first * (1 + after)));
        }
        // The series ends, and the ball stays where it touches: at rest, but for a rounding of its
        // speed along the oblique plane.
        const double end = first * (1 + e) / (1 - e);
        ASSERT_NE(result.motion.events.back().kind, EventKind::kImpact);
        const double rest = result.motion.events.back().time;
        const double bound = 1e-12 + 16 * kEpsilon * far;
        fmt::print("at {:.0e} m: 12 impacts within {:.1e} s, rest within {:.1e} s (bound {:.1e})\n",
                   far, worst, std::abs(rest - end), bound);
        EXPECT_LE(worst, bound);
        EXPECT_LE(std::abs(rest - end), 1e-6);
        const Vec3 x = result.motion.balls[0].at(6).position;
        const auto& plane = std::get<PlaneShape>(scene.surfaces[0].shape);
        EXPECT_NEAR(plane.normal.dot(x) - plane.offset_m, 0.1, bound);
    }
}

/// One ball on one oblique plane, sliding across the slope: it crashed at 10 km.
TEST(FarScenes, ABallSlidesAcrossASlopeAnywhere) {
    const Vec3 n = Vec3(-0.39955885666192975, 0.37041743589610365, 0.8385366081735295).normalized();
    Scene scene = exact_scene(0.3, 0.2, 0);
    scene.simulation.gravity = Vec3(5.672397465559252, -4.51943867383567, -8.485667482200808);
    add_plane(scene, n, 0);
    add_ball(scene, 0.1 * n, Vec3(0.5736331141215899, -2.88768219286057, 1.1449253696852073));
    scene.balls[0].spin = Vec3(-18.218256471115126, 6.402355759966667, 9.427075861268923);
    const BallState here = run(scene, 1).motion.balls[0].at(1);
    for (const double far : {1e3, 1e4, 1e6}) {
        const Vec3 by = far * direction();
        Scene there = moved(scene, by);
        const BallState at = run(there, 1).motion.balls[0].at(1);
        const double off = (at.position - by - here.position).norm();
        const double bound = 1e-11 + 32 * kEpsilon * far;
        fmt::print("across a slope at {:.0e} m: {:.1e} m (bound {:.1e})\n", far, off, bound);
        EXPECT_LE(off, bound);
        EXPECT_LE((at.velocity - here.velocity).norm(), bound);
    }
}

struct Named {
    std::string name;
    Scene scene;
};

/// Scenes in which bodies touch at the start.
std::vector<Named> touching_scenes() {
    std::vector<Named> all;
    Scene cradle = exact_scene(1, 0, 0);
    use_pair(cradle, 1);
    for (int i = 0; i < 4; ++i) add_ball(cradle, Vec3(0.2 * i, 0, 0));
    add_ball(cradle, Vec3(-1, 0, 0), Vec3(2, 0, 0));
    all.push_back({"cradle", cradle});

    Scene rolling = exact_scene(0.5, 0.4, kGravity);
    add_plane(rolling);
    add_shape(rolling, BoxShape{Vec3(1, 0, 0), Vec3(0.4, 2, 0.4), Quat::Identity()});
    add_ball(rolling, Vec3(0, 0, 0.1), Vec3(2, 0.3, 0)).spin = Vec3(3, -5, 2);
    all.push_back({"rolling to a wall", rolling});

    Scene groove = exact_scene(0, 0, kGravity);
    add_plane(groove, Vec3(1, 0, 1));
    add_plane(groove, Vec3(-1, 0, 1));
    add_ball(groove, Vec3(0, 0, 0.1 * std::sqrt(2.0)), Vec3(0, 1, 0));
    all.push_back({"groove", groove});

    Scene dome = exact_scene(0.5, 0, kGravity);
    add_plane(dome);
    add_shape(dome, SphereShape{Vec3::Zero(), 0.5});
    add_ball(dome, Vec3(0, 0, 0.6), Vec3(0.5, 0, 0));
    all.push_back({"off a sphere", dome});
    return all;
}

TEST(FarScenes, BodiesThatTouchDoSoAnywhere) {
    for (const Named& named : touching_scenes())
        for (const double far : {1e3, 1e6}) {
            Scene here = named.scene;
            const Vec3 by = far * direction();
            Scene there = moved(here, by);
            const Motion a = run(here, 1).motion, b = run(there, 1).motion;
            double off = 0;
            for (std::size_t i = 0; i < a.balls.size(); ++i)
                off = std::max(off,
                               (b.balls[i].at(1).position - by - a.balls[i].at(1).position).norm());
            // Rounding of the places, and what a second of motion makes of it.
            const double bound = 1e-11 + 100 * kEpsilon * far;
            fmt::print("{} at {:.0e} m: {:.1e} m (bound {:.1e})\n", named.name, far, off, bound);
            EXPECT_LE(off, bound) << named.name;
            // The last bounces are summed from where hops drown in the rounding of places.
            EXPECT_NEAR(static_cast<double>(impacts_of(a).size()),
                        static_cast<double>(impacts_of(b).size()), 2)
                << named.name;
        }
}

TEST(FarScenes, FixedStepsMoveThemTheSame) {
    Scene here = oblique_drop(0.8, 0.5, Vec3::Zero());
    here.simulation.method = Method::kFixed;
    const Vec3 by = 1e6 * direction();
    Scene there = moved(here, by);
    const BallState a = run(here, 1).motion.balls[0].at(1), b = run(there, 1).motion.balls[0].at(1);
    const double off = (b.position - by - a.position).norm();
    fmt::print("fixed at 1e6 m: {:.1e} m (bound 1e-8)\n", off);
    EXPECT_LE(off, 1e-8);
    EXPECT_LE((b.velocity - a.velocity).norm(), 1e-8);
}

}  // namespace
}  // namespace carom::testing
