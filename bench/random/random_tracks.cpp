#include "random_tracks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "draw.h"
#include "scene_parts.h"

namespace carom::bench {

namespace {

constexpr double kDegree = M_PI / 180;

/// Where a ball may start: on a straight line of contact points, with the normal there.
struct Ground {
    Vec3 from, along, normal;  ///< along and normal: unit
    double length = 1;         ///< m
    double rise = 0;           ///< of a ball's centre over the line, in radii of the ball ...
    double extra = 0;          ///< ... and in m
};

Scene track_scene(Draw& draw) { return empty_scene(draw.uniform(0.8, 2), Vec3(0, 0, -9.81)); }

double restitution(Draw& draw) {
    return draw.chance(0.6) ? draw.pick({0, 0.5, 0.9, 1}) : draw.unit();
}

std::optional<double> friction(Draw& draw) {
    if (draw.chance(0.35)) return std::nullopt;
    return draw.chance(0.3) ? draw.pick({0.1, 1}) : draw.unit();
}

/// Materials [1] of the balls and [2] of the track: a pair has the balls' numbers.
void add_materials(Scene& scene, Draw& draw) {
    const std::optional<double> mu = friction(draw);
    add_material(scene, restitution(draw), mu);
    add_material(scene, 1, mu ? std::optional<double>(1) : std::nullopt);
}

/// Sometimes another one for one part of the track.
int track_material(Scene& scene, Draw& draw) {
    if (!draw.chance(0.1)) return 2;
    return add_material(scene, restitution(draw), friction(draw));
}

/// A box whose top has the edges' middles `from` and `to`.
BoxShape plank(const Vec3& from, const Vec3& to, double width, double thickness) {
    const Vec3 along = (to - from).normalized();
    const Vec3 level(along.x(), along.y(), 0);
    const double slope = std::atan2(-along.z(), level.norm());
    const Quat turn = Quat(Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Vec3::UnitZ())) *
                      Quat(Eigen::AngleAxisd(slope, Vec3::UnitY()));
    BoxShape box;
    box.orientation = slope == 0 && along.y() == 0 && along.x() > 0 ? Quat::Identity() : turn;
    box.size = Vec3((to - from).norm(), width, thickness);
    box.center = 0.5 * (from + to) - 0.5 * thickness * (box.orientation * Vec3::UnitZ());
    return box;
}

/// Points of a line in a plane upright over `azimuth` that begins at the origin.
std::vector<Vec3> profile(Draw& draw, double azimuth, double flush) {
    double slope = draw.chance(0.3) ? 0 : draw.uniform(0, 25) * kDegree;
    std::vector<Vec3> points{Vec3::Zero()};
    const int parts = draw.integer(2, 7);
    const bool even = draw.chance(0.5);
    for (int i = 0; i < parts; ++i) {
        const double length = even ? 0.5 : draw.uniform(0.2, 1.2);
        const Vec3 along(std::cos(slope) * std::cos(azimuth), std::cos(slope) * std::sin(azimuth),
                         -std::sin(slope));
        points.push_back(points.back() + length * along);
        if (!draw.chance(flush)) slope += draw.uniform(-30, 30) * kDegree;
        slope = std::clamp(slope, -40 * kDegree, 40 * kDegree);
    }
    return points;
}

double azimuth_of(Draw& draw) { return draw.chance(0.4) ? 0 : draw.uniform(-M_PI, M_PI); }

Vec3 upward(const Vec3& along) {
    const Vec3 across = Vec3::UnitZ().cross(along).normalized();
    return along.cross(across).normalized();
}

Ground ground_of(const Vec3& from, const Vec3& to) {
    const Vec3 along = (to - from).normalized();
    return {from, along, upward(along), (to - from).norm(), 1, 0};
}

Ground planks(Scene& scene, Draw& draw) {
    const std::vector<Vec3> points = profile(draw, azimuth_of(draw), 0.5);
    const double width = draw.uniform(0.4, 2), thickness = draw.pick({0.1, 0.3, 1});
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        add_surface(scene, plank(points[i], points[i + 1], width, thickness),
                    track_material(scene, draw));
    if (draw.chance(0.3)) {  // a wall at the end
        const Vec3 along = (points.back() - points[points.size() - 2]).normalized();
        const Vec3 level = Vec3(along.x(), along.y(), 0).normalized();
        const Vec3 foot = points.back() - 0.5 * Vec3::UnitZ();
        BoxShape wall = plank(foot, foot + 0.3 * level, width, 2);
        wall.center.z() = points.back().z();
        add_surface(scene, wall, 2);
    }
    return ground_of(points[0], points[1]);
}

/// Tiles of one floor, level or not.
Ground tiles(Scene& scene, Draw& draw) {
    const double tilt = draw.chance(0.4) ? 0 : draw.uniform(0, 20) * kDegree;
    const Quat turn = Quat(Eigen::AngleAxisd(azimuth_of(draw), Vec3::UnitZ())) *
                      Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()));
    const Vec3 size(draw.pick({0.25, 0.5, 1 / 3.0}), draw.pick({0.25, 0.5, 0.7}), 0.2);
    const int nx = draw.integer(2, 4), ny = draw.integer(2, 4);
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j) {
            BoxShape box{turn * Vec3((i + 0.5) * size.x(), (j + 0.5) * size.y(), -0.1), size, turn};
            add_surface(scene, box, track_material(scene, draw));
        }
    // From a corner along the diagonal, or from anywhere in any direction.
    Vec3 from(0, 0, 0), to(nx * size.x(), ny * size.y(), 0);
    if (draw.chance(0.5)) {
        from = Vec3(draw.uniform(0, to.x()), draw.uniform(0, to.y()), 0);
        to = Vec3(draw.uniform(0, to.x()), draw.uniform(0, to.y()), 0);
    }
    Ground ground = ground_of(turn * from, turn * to);
    ground.normal = turn * Vec3::UnitZ();
    return ground;
}

/// Capsules end to end: a ball on their top, or in the groove of two such lines.
Ground capsules(Scene& scene, Draw& draw, bool rails) {
    const std::vector<Vec3> points = profile(draw, azimuth_of(draw), 0.6);
    const double radius = draw.uniform(0.03, 0.2);
    const Vec3 along = (points[1] - points[0]).normalized();
    const Vec3 across = Vec3::UnitZ().cross(along).normalized();
    // With the largest ball, 0.1 m, between the rails and the smallest, 0.05 m, on them.
    const double half = rails ? draw.uniform(0.5, 0.9) * (0.05 + radius) : 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        for (const double side : {-1.0, 1.0}) {
            if (!rails && side > 0) continue;
            add_surface(scene,
                        CapsuleShape{points[i] + side * half * across,
                                     points[i + 1] + side * half * across, radius},
                        2);
        }
    Ground ground = ground_of(points[0], points[1]);
    ground.rise = -1;  // by what the groove leaves: see place()
    ground.extra = half;
    return ground;
}

/// Boxes that stand in a plane: flush with it, sloping into it, or across the way.
Ground boxes_in_plane(Scene& scene, Draw& draw) {
    const double tilt = draw.chance(0.5) ? 0 : draw.uniform(0, 15) * kDegree;
    const Quat turn = Quat(Eigen::AngleAxisd(azimuth_of(draw), Vec3::UnitZ())) *
                      Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()));
    const Vec3 normal = turn * Vec3::UnitZ();
    add_surface(scene, PlaneShape{normal, 0}, 2);
    const int boxes = draw.integer(1, 4);
    for (int i = 0; i < boxes; ++i) {
        const double x = 0.6 + 0.5 * i, slope = draw.uniform(-25, 25) * kDegree;
        BoxShape box{turn * Vec3(x + 0.25, 0, -0.1), Vec3(0.5, 1, 0.2), turn};
        if (draw.chance(0.5)) {
            box.orientation = turn * Quat(Eigen::AngleAxisd(slope, Vec3::UnitY()));
            box.size.x() = 0.4;
        }
        add_surface(scene, box, track_material(scene, draw));
    }
    Ground ground = ground_of(turn * Vec3(-0.4, 0, 0), turn * Vec3(0.3, 0, 0));
    ground.normal = normal;
    return ground;
}

/// A ball `gap` above the ground, at speed along it.
void place(Scene& scene, Draw& draw, const Ground& ground, double share) {
    const double radius = draw.pick({0.05, 0.1, draw.uniform(0.05, 0.1)});
    double height = radius;
    if (ground.rise < 0) {  // on capsules
        const double far = radius + std::get<CapsuleShape>(scene.surfaces[0].shape).radius;
        height = std::sqrt(far * far - ground.extra * ground.extra);
    }
    const double gap = draw.chance(0.5) ? 0 : draw.uniform(0, 0.5);
    const double speed = draw.chance(0.15) ? 0 : draw.uniform(0, 10) * draw.pick({0.2, 1});
    const Vec3 across = ground.normal.cross(ground.along);
    Vec3 v = speed * ground.along;
    if (draw.chance(0.3) && ground.rise > 0) v += draw.uniform(-0.3, 0.3) * speed * across;
    if (draw.chance(0.2)) v -= draw.uniform(0, 3) * ground.normal;
    Ball& ball = add_ball(
        scene, radius,
        ground.from + share * ground.length * ground.along + (height + gap) * ground.normal, 1);
    ball.velocity = v;
    if (draw.chance(0.3)) ball.inertia_factor = 2.0 / 3;
    if (draw.chance(0.3)) ball.spin = ground.normal.cross(v) / radius;  // rolling
    if (draw.chance(0.2)) ball.spin = draw.uniform(0, 40) * draw.direction();
}

}  // namespace

Scene random_track(std::uint64_t seed) {
    Draw draw(seed);
    Scene scene = track_scene(draw);
    add_materials(scene, draw);
    Ground ground;
    switch (draw.integer(0, 6)) {
        case 0:
        case 1:
        case 2:
            ground = planks(scene, draw);
            break;
        case 3:
            ground = tiles(scene, draw);
            break;
        case 4:
            ground = capsules(scene, draw, false);
            break;
        case 5:
            ground = capsules(scene, draw, true);
            break;
        default:
            ground = boxes_in_plane(scene, draw);
            break;
    }
    place(scene, draw, ground, draw.uniform(0.05, 0.45));
    if (draw.chance(0.15)) place(scene, draw, ground, draw.uniform(0.7, 0.95));
    return scene;
}

SeamPair random_seams(std::uint64_t seed) {
    Draw draw(seed);
    Scene scene = track_scene(draw);
    add_materials(scene, draw);
    const double slope = draw.chance(0.4) ? 0 : draw.uniform(-15, 15) * kDegree;
    const Quat turn = Quat(Eigen::AngleAxisd(azimuth_of(draw), Vec3::UnitZ())) *
                      Quat(Eigen::AngleAxisd(slope, Vec3::UnitY()));
    const int parts = draw.integer(2, 6), rows = draw.chance(0.3) ? 2 : 1;
    std::vector<double> ends{0};
    for (int i = 0; i < parts; ++i)
        ends.push_back(ends.back() + (draw.chance(0.5) ? 0.5 : draw.uniform(0.2, 1.5)));
    const double width = draw.uniform(0.5, 2), length = ends.back();
    SeamPair pair{scene, scene};
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        for (int j = 0; j < rows; ++j) {
            const double y = ((j + 0.5) / rows - 0.5) * width;
            add_surface(pair.seams,
                        BoxShape{turn * Vec3(0.5 * (ends[i] + ends[i + 1]), y, -0.25),
                                 Vec3(ends[i + 1] - ends[i], width / rows, 0.5), turn},
                        2);
        }
    add_surface(pair.whole,
                BoxShape{turn * Vec3(0.5 * length, 0, -0.25), Vec3(length, width, 0.5), turn}, 2);
    Ground ground = ground_of(Vec3::Zero(), turn * Vec3(length, 0, 0));
    ground.normal = turn * Vec3::UnitZ();
    place(pair.seams, draw, ground, draw.uniform(0.02, 0.3));
    pair.whole.balls = pair.seams.balls;
    return pair;
}

}  // namespace carom::bench
