// Triangles of bodies against the bodies themselves.
#include "export/mesh.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../geometry/shapes.h"
#include "geometry/nearest.h"

namespace carom {
namespace {

constexpr double kReach = 3;

TEST(Mesh, CornersLieOnTheirShape) {
    for (const SurfaceShape& shape : one_of_each()) {
        const Mesh mesh = surface_mesh(shape, Vec3(0.3, 0.2, -0.1), kReach);
        ASSERT_FALSE(mesh.positions.empty());
        ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
        double worst = 0;
        // A ball of radius 0 has a gap of the distance; of a ring's circle it is the tube's.
        for (const Vec3& p : mesh.positions)
            worst = std::max(worst, std::abs(signed_distance(shape, p)));
        fmt::print("shape {}: corners off by {:.3g} m\n", shape.index(), worst);
        EXPECT_LT(worst, 1e-12) << shape.index();
    }
}

TEST(Mesh, TrianglesFaceTheirNormals) {
    for (const SurfaceShape& shape : one_of_each()) {
        const Mesh mesh = surface_mesh(shape, Vec3::Zero(), kReach);
        ASSERT_EQ(0u, mesh.triangles.size() % 3);
        ASSERT_FALSE(mesh.triangles.empty());
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
            const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1],
                                c = mesh.triangles[i + 2];
            const Vec3 face = (mesh.positions[b] - mesh.positions[a])
                                  .cross(mesh.positions[c] - mesh.positions[a]);
            ASSERT_GT(face.norm(), 0) << shape.index();
            EXPECT_GT(face.dot(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]), 0)
                << shape.index();
        }
    }
}

TEST(Mesh, RoundShapesAreCloseToTheirTriangles) {
    const SphereShape sphere{Vec3(-1, 0.5, 2), 0.8};
    const Mesh mesh = surface_mesh(sphere, Vec3::Zero(), kReach);
    double deepest = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Vec3 middle =
            (mesh.positions[mesh.triangles[i]] + mesh.positions[mesh.triangles[i + 1]] +
             mesh.positions[mesh.triangles[i + 2]]) /
            3;
        deepest = std::max(deepest, sphere.radius - (middle - sphere.center).norm());
    }
    fmt::print("triangles of a sphere: {:.3g} of the radius below it\n", deepest / sphere.radius);
    EXPECT_GT(deepest, 0);
    // A triangle's corners lie within half the diagonal of a square of 2 pi / 28 to each side.
    EXPECT_LT(deepest, (1 - std::cos(2 * M_PI / 28 / std::sqrt(2))) * sphere.radius);
}

TEST(Mesh, TheUnitSphereHasThePlacesOfTextures) {
    const Mesh mesh = unit_sphere();
    ASSERT_EQ(mesh.positions.size(), mesh.places.size());
    for (std::size_t i = 0; i < mesh.places.size(); ++i) {
        // From render/texture/ball_texture.h: columns are the longitude from -pi, rows the
        // latitude, the pole of z on top.
        const double longitude = 2 * M_PI * mesh.places[i].x() - M_PI;
        const double latitude = M_PI * (0.5 - mesh.places[i].y());
        const Vec3 p(std::cos(latitude) * std::cos(longitude),
                     std::cos(latitude) * std::sin(longitude), std::sin(latitude));
        EXPECT_LT((p - mesh.positions[i]).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace carom
