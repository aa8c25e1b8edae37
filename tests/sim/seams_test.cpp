// Surfaces that touch each other are one surface to a ball: a seam costs and shows nothing.
#include <cmath>

#include "curved_scenes.h"

namespace carom::testing {
namespace {

constexpr double kG = kGravity, kSeamR = 0.1;

/// Of places [m] after a second of motion at a few m/s.
constexpr double kSeam = 1e-11;

Surface& add_box(Scene& scene, const Vec3& centre, const Vec3& size,
                 const Quat& turned = Quat::Identity()) {
    return add_surface(scene, ("box" + std::to_string(scene.surfaces.size())).c_str(),
                       BoxShape{centre, size, turned});
}

/// Boxes `length` long with their tops in z = 0, from x = -length / 2 on, each `apart` from the
/// next.
void add_row(Scene& scene, int boxes, double length, double apart = 0) {
    for (int i = 0; i < boxes; ++i) add_box(scene, {i * (length + apart), 0, -0.5}, {length, 2, 1});
}

std::vector<Event> other_than_impacts(const Motion& motion) {
    std::vector<Event> rows;
    for (const Event& e : motion.events)
        if (e.kind != EventKind::kImpact) rows.push_back(e);
    return rows;
}

TEST(Seams, ABallSlidesOnOverFlushBoxesAsOnOne) {
    for (const double restitution : {0.0, 0.5, 1.0})
        for (const double apart : {0.0, 1e-16, 1e-12, 1e-9, -1e-9})
            for (const double speed : {0.3, 0.99, 3.7, 5.0, 20.0}) {
                Scene scene = exact_scene(restitution, 0, kG);
                scene.simulation.duration = 1;
                add_row(scene, 25, 1, apart);
                add_ball(scene, {0, 0, kSeamR}, {speed, 0, 0}, kSeamR);
                const Motion motion = simulate(scene).motion;
                const BallState s = motion.balls[0].at(1);
                EXPECT_NEAR(s.position.x(), speed, kSeam) << speed << " " << apart;
                EXPECT_NEAR(s.position.z(), kSeamR, kSeam) << speed << " " << apart;
                EXPECT_NEAR(s.velocity.x(), speed, kSeam) << speed << " " << apart;
                EXPECT_EQ(motion.events.size(), 0u) << speed << " " << apart;
            }
}

TEST(Seams, ABallRollsDiagonallyOverTiles) {
    for (const double friction : {0.0, 0.4})
        for (const double angle : {0.1, 0.5, M_PI / 4, 1.3}) {
            Scene scene = exact_scene(0.5, friction, kG);
            scene.simulation.duration = 1;
            for (int i = 0; i < 6; ++i)
                for (int j = 0; j < 6; ++j)
                    add_box(scene, {0.5 * i, 0.5 * j, -0.1}, {0.5, 0.5, 0.2});
            const Vec3 v = 2 * Vec3(std::cos(angle), std::sin(angle), 0);
            Ball& ball = add_ball(scene, {0, 0, kSeamR}, v, kSeamR);
            ball.spin = Vec3::UnitZ().cross(v) / kSeamR;
            const Motion motion = simulate(scene).motion;
            const BallState s = motion.balls[0].at(1);
            EXPECT_LE((s.position - Vec3(v.x(), v.y(), kSeamR)).norm(), kSeam) << angle;
            EXPECT_LE((s.velocity - v).norm(), kSeam) << angle;
            EXPECT_EQ(motion.events.size(), 0u) << angle;
        }
}

/// Slides with a slip, then rolls: the same on one long sloping box and on flush ones.
TEST(Seams, ASlopeOfPlatesIsAsOneLongPlate) {
    for (const double degrees : {3.0, 20.0, 41.0})
        for (const double friction : {0.0, 0.1, 0.7})
            for (const double across : {0.0, 0.8}) {
                const Quat turned(Eigen::AngleAxisd(degrees * M_PI / 180, Vec3::UnitY()));
                const Vec3 down = turned * Vec3::UnitX(), up = turned * Vec3::UnitZ();
                const auto run = [&](int plates) {
                    Scene scene = exact_scene(0.5, friction, kG);
                    scene.simulation.duration = 1;
                    const double length = 6.0 / plates;
                    for (int i = 0; i < plates; ++i)
                        add_box(scene, ((i + 0.5) * length) * down - 0.05 * up, {length, 4, 0.1},
                                turned);
                    Ball& ball = add_ball(scene, 0.05 * down + kSeamR * up,
                                          0.7 * down + across * Vec3::UnitY(), kSeamR);
                    ball.spin = Vec3(1, 2, 3);
                    return simulate(scene).motion;
                };
                const Motion one = run(1), many = run(13);
                const BallState a = one.balls[0].at(1), b = many.balls[0].at(1);
                EXPECT_GT((a.position - one.balls[0].at(0).position).norm(), 0.6);
                EXPECT_LE((a.position - b.position).norm(), kSeam) << degrees << " " << friction;
                EXPECT_LE((a.velocity - b.velocity).norm(), kSeam) << degrees << " " << friction;
                EXPECT_LE(kSeamR * (a.spin - b.spin).norm(), kSeam) << degrees << " " << friction;
                EXPECT_EQ(one.events.size(), many.events.size()) << degrees << " " << friction;
            }
}

TEST(Seams, CapsulesInLineAreOne) {
    for (const double restitution : {0.4, 1.0})
        for (const double friction : {0.0, 0.5})
            for (const double speed : {0.4, 2.0, 6.0}) {
                Scene scene = exact_scene(restitution, friction, kG);
                scene.simulation.duration = 0.5;
                for (int i = 0; i < 4; ++i)
                    add_surface(scene, ("rail" + std::to_string(i)).c_str(),
                                CapsuleShape{Vec3(i, 0, -0.1), Vec3(i + 1, 0, -0.1), 0.1});
                Ball& ball = add_ball(scene, {0.9, 0, kSeamR}, {speed, 0, 0}, kSeamR);
                if (friction > 0) ball.spin = Vec3(0, speed / kSeamR, 0);
                const Motion motion = simulate(scene).motion;
                const BallState s = motion.balls[0].at(0.5);
                EXPECT_LE((s.position - Vec3(0.9 + 0.5 * speed, 0, kSeamR)).norm(), kSeam) << speed;
                EXPECT_EQ(motion.events.size(), 0u) << speed;
            }
}

/// H1's peaks, over the very seam, within what rounding can tell of it and beside it.
TEST(Seams, ABounceOnASeamIsABounce) {
    for (const double beside : {0.0, 1e-16, -1e-13, 1e-9, -1e-7, 1e-3})
        for (const bool four : {false, true}) {
            Scene scene = exact_scene(0.8, 0, kG);
            scene.simulation.duration = 3;
            add_box(scene, {-1, four ? 1.0 : 0.0, -0.5}, {2, 2, 1});
            add_box(scene, {1, four ? 1.0 : 0.0, -0.5}, {2, 2, 1});
            if (four) {
                add_box(scene, {-1, -1, -0.5}, {2, 2, 1});
                add_box(scene, {1, -1, -0.5}, {2, 2, 1});
            }
            add_ball(scene, {beside, 0, kSeamR + 2}, {0.01, 0, 0}, kSeamR);
            const Motion motion = simulate(scene).motion;
            const std::vector<Event> impacts = impacts_of(motion);
            ASSERT_EQ(impacts.size(), 3u) << beside;
            double speed = std::sqrt(2 * kG * 2), t = speed / kG;
            for (const Event& e : impacts) {
                EXPECT_NEAR(e.time, t, 1e-13) << beside;
                EXPECT_NEAR(e.separation_speed, 0.8 * speed, 1e-13) << beside;
                speed *= 0.8;
                t += 2 * speed / kG;
            }
            EXPECT_LE(std::abs(motion.balls[0].at(3).position.x() - beside - 0.03), 1e-13);
            EXPECT_TRUE(other_than_impacts(motion).empty());
        }
}

/// Along the seam of two boxes and over the edge that both end in: as off one box.
TEST(Seams, ABallRollsOffTheEndOfASeam) {
    for (int turn = 0; turn < 12; ++turn) {
        const Quat turned = Quat(Eigen::AngleAxisd(0.5 * turn, Vec3::UnitZ())) *
                            Quat(Eigen::AngleAxisd(0.12 + 0.02 * turn, Vec3::UnitY()));
        const Vec3 down = turned * Vec3::UnitX(), side = turned * Vec3::UnitY(),
                   up = turned * Vec3::UnitZ();
        const auto run = [&](bool two) {
            Scene scene = exact_scene(0.4, 0.3, kG);
            scene.simulation.duration = 1.2;
            if (two)
                for (const double at : {-0.2, 0.2})
                    add_box(scene, at * side - 0.25 * up, {1, 0.4, 0.5}, turned);
            else
                add_box(scene, -0.25 * up, {1, 0.8, 0.5}, turned);
            add_ball(scene, 0.3 * down + kSeamR * up, Vec3::Zero(), kSeamR);
            return simulate(scene).motion;
        };
        const Motion one = run(false), two = run(true);
        EXPECT_EQ(events_of(two, EventKind::kLeave).size(), 1u) << turn;
        EXPECT_LE((one.balls[0].at(1.2).position - two.balls[0].at(1.2).position).norm(), 1e-9)
            << turn;
    }
}

TEST(Seams, ABallRestsOverASeam) {
    for (const double beside : {0.0, 1e-12, 1e-9, -1e-3}) {
        Scene scene = exact_scene(0.3, 0.5, kG);
        scene.simulation.duration = 10;
        add_row(scene, 2, 1);
        add_ball(scene, {0.5 + beside, 0, kSeamR + 0.5}, Vec3::Zero(), kSeamR);
        const Motion motion = simulate(scene).motion;
        const BallState s = motion.balls[0].at(10);
        EXPECT_LE((s.position - Vec3(0.5 + beside, 0, kSeamR)).norm(), 1e-12) << beside;
        EXPECT_TRUE(s.velocity.isZero(0)) << beside;
        EXPECT_EQ(events_of(motion, EventKind::kRest).size(), 1u) << beside;
        EXPECT_EQ(other_than_impacts(motion).size(), 1u) << beside;
    }
}

TEST(Seams, APlaneGoesOnInTheTopOfABox) {
    for (const double speed : {0.5, 4.0}) {
        Scene scene = exact_scene(0.6, 0, kG);
        scene.simulation.duration = 1;
        add_plane(scene);
        add_box(scene, {1.2, 0, -0.5}, {1, 1, 1});  // its top is in the plane
        add_ball(scene, {0, 0, kSeamR}, {speed, 0, 0}, kSeamR);
        const Motion motion = simulate(scene).motion;
        EXPECT_LE((motion.balls[0].at(1).position - Vec3(speed, 0, kSeamR)).norm(), kSeam);
        EXPECT_EQ(motion.events.size(), 0u);
    }
}

/// In a concave corner the ball meets both surfaces: it comes back from a wall on a tiled floor.
TEST(Seams, AWallOnTilesIsMetAsOnAPlane) {
    Scene scene = exact_scene(0.5, 0, kG);
    scene.simulation.duration = 1;
    add_row(scene, 4, 1);
    add_box(scene, {2.75, 0, 0.5}, {0.5, 2, 1});  // stands on a tile
    add_ball(scene, {0, 0, kSeamR}, {4, 0, 0}, kSeamR);
    const Motion motion = simulate(scene).motion;
    const std::vector<Event> impacts = impacts_of(motion);
    ASSERT_EQ(impacts.size(), 1u);
    EXPECT_NEAR(impacts[0].time, 2.4 / 4, 1e-13);
    EXPECT_NEAR(motion.balls[0].at(1).position.x(), 2.4 - 0.4 * 2, kSeam);
    EXPECT_NEAR(motion.balls[0].at(1).position.z(), kSeamR, kSeam);
}

// ---- Convex joints
// -----------------------------------------------------------------------------

/// Two plates that share an edge at the origin, sloping down to +x by a and by b [degrees].
void add_joint(Scene& scene, double a, double b) {
    for (const auto& [degrees, side] : {std::pair{a, -1.0}, std::pair{b, 1.0}}) {
        const Quat turned(Eigen::AngleAxisd(degrees * M_PI / 180, Vec3::UnitY()));
        add_box(scene, turned * Vec3(side * 2, 0, -0.05), {4, 2, 0.1}, turned);
    }
}

struct JointRun {
    Motion motion;
    Scene scene;
    double speed = 0;  ///< on arrival at the edge, m/s
};

/// A ball that slides down the first plate from `way` before the edge.
JointRun over_joint(double a, double b, double speed, double way, double friction = 0) {
    JointRun run;
    run.scene = exact_scene(0, friction, kG);
    run.scene.simulation.duration = 0.8;
    add_joint(run.scene, a, b);
    const Quat turned(Eigen::AngleAxisd(a * M_PI / 180, Vec3::UnitY()));
    const Vec3 v = turned * Vec3(speed, 0, 0);
    Ball& ball = add_ball(run.scene, turned * Vec3(-way, 0, kSeamR), v, kSeamR);
    double pull = kG * std::sin(a * M_PI / 180);
    if (friction > 0) {
        ball.spin = Vec3::UnitY() * speed / kSeamR;
        pull *= 5.0 / 7;
    }
    run.speed = std::sqrt(speed * speed + 2 * pull * way);
    run.motion = simulate(run.scene).motion;
    return run;
}

/// H30: above v^2 = g R cos(a) it leaves at the edge itself, and lands on the second plate where
/// the parabola does; with e = 0 it loses the part of its speed along the normal there, and no
/// more.
TEST(Joints, AFastBallLeavesAtTheEdgeAndLandsAsAParabolaDoes) {
    for (const auto& [a, b] : {std::pair{12.0, 14.0}, std::pair{15.0, 20.0}, std::pair{0.0, 30.0},
                               std::pair{5.0, 5.5}}) {
        const JointRun run = over_joint(a, b, 1.2, 0.1);
        const double alpha = a * M_PI / 180, turn = (b - a) * M_PI / 180;
        ASSERT_GT(run.speed * run.speed, kG * kSeamR * std::cos(alpha));
        const Event leave = only(run.motion, EventKind::kLeave);
        const double pull = kG * std::sin(alpha);
        const double at = pull > 0 ? (run.speed - 1.2) / pull : 0.1 / 1.2;
        EXPECT_NEAR(leave.time, at, 1e-12);
        // Over the second plate the centre falls from v sin(turn) t - g cos(b) t^2 / 2 to where it
        // has R less than it began with, R cos(turn).
        const double up = run.speed * std::sin(turn), fall = kG * std::cos(b * M_PI / 180);
        const double rise = kSeamR * (std::cos(turn) - 1);
        const double flight = (up + std::sqrt(up * up + 2 * fall * rise)) / fall;
        const std::vector<Event> impacts = impacts_of(run.motion);
        ASSERT_EQ(impacts.size(), 1u) << a << " " << b;
        EXPECT_NEAR(impacts[0].time, at + flight, 1e-9) << a << " " << b;
        const double lost = up - fall * flight;
        const double before = energy(run.scene, run.motion.balls[0].at(0));
        for (const double t : {0.3, 0.5, 0.8}) {
            if (t < impacts[0].time) continue;
            EXPECT_NEAR(before - energy(run.scene, run.motion.balls[0].at(t)), 0.5 * lost * lost,
                        1e-11)
                << a << " " << b << " at " << t;
        }
    }
}

/// Over a joint of two rails the centre goes around it at the distance from their plane that it has
/// between them; above v^2 = g times that it flies, and lands where the parabola meets the line
/// that the centre has between the next rails.
TEST(Joints, AFastBallFliesOverAJointOfRails) {
    constexpr double kApart = 0.09, kRail = 0.06;
    const double distance = kSeamR + kRail;
    const double height = std::sqrt(distance * distance - kApart * kApart);
    for (const double degrees : {2.0, 10.0, 25.0})
        for (const double speed : {1.4, 2.0}) {
            ASSERT_GT(speed * speed, kG * height);
            const double angle = degrees * M_PI / 180;
            Scene scene = exact_scene(0, 0, kG);
            for (const double y : {-kApart, kApart}) {
                add_surface(scene, "level", CapsuleShape{Vec3(-1, y, 0), Vec3(0, y, 0), kRail});
                add_surface(
                    scene, "steep",
                    CapsuleShape{Vec3(0, y, 0), Vec3(2 * std::cos(angle), y, -2 * std::sin(angle)),
                                 kRail});
            }
            add_ball(scene, Vec3(-0.14, 0, height), Vec3(speed, 0, 0), kSeamR);
            const double begin = 0.14 / speed;
            const double up = speed * std::sin(angle), fall = kG * std::cos(angle);
            const double rise = height * (std::cos(angle) - 1);
            const double flight = (up + std::sqrt(up * up + 2 * fall * rise)) / fall;
            scene.simulation.duration = begin + flight + 0.02;
            const SimulationResult r = simulate(scene);
            EXPECT_EQ(r.report.steps, 0) << degrees;
            const std::vector<Event> impacts = impacts_of(r.motion);
            ASSERT_EQ(impacts.size(), 2u) << degrees << ", " << speed;
            for (const Event& e : impacts) EXPECT_NEAR(e.time, begin + flight, 1e-11) << degrees;
            const double lost = up - fall * flight;
            EXPECT_NEAR(energy(scene, r.motion.balls[0].at(0)) -
                            energy(scene, r.motion.balls[0].at(*scene.simulation.duration)),
                        0.5 * lost * lost, 1e-11);
        }
}

TEST(Joints, ASlowBallPivotsOverTheEdgeAndKeepsItsEnergy) {
    for (const auto& [a, b] : {std::pair{12.0, 14.0}, std::pair{0.0, 3.0}, std::pair{2.0, 2.5}})
        for (const double friction : {0.0, 0.9}) {
            const JointRun run = over_joint(a, b, 0.3, 0.02, friction);
            ASSERT_LT(run.speed * run.speed, 0.8 * kG * kSeamR);
            const double before = energy(run.scene, run.motion.balls[0].at(0));
            for (const double t : {0.1, 0.3, 0.8})
                EXPECT_NEAR(energy(run.scene, run.motion.balls[0].at(t)), before, 1e-11)
                    << a << " " << b << " at " << t;
            EXPECT_TRUE(impacts_of(run.motion).empty()) << a << " " << b;
            EXPECT_TRUE(events_of(run.motion, EventKind::kLeave).empty()) << a << " " << b;
            // On the second plate in the end.
            const BallState s = run.motion.balls[0].at(0.8);
            const Vec3 normal(std::sin(b * M_PI / 180), 0, std::cos(b * M_PI / 180));
            EXPECT_NEAR(s.position.dot(normal), kSeamR, 1e-12);
        }
}

TEST(Joints, NoPlaceJumps) {
    const JointRun run = over_joint(15, 20, 0.5, 0.05);
    const std::vector<Piece>& pieces = run.motion.balls[0].pieces();
    ASSERT_GT(pieces.size(), 2u);
    for (std::size_t i = 1; i < pieces.size(); ++i)
        EXPECT_LE((pieces[i].position - pieces[i - 1].position_at(pieces[i].start)).norm(), 1e-13)
            << i;
}

/// Two walls of two plates each: the ball has two contacts all the time.
TEST(Seams, AGrooveOfPlatesIsAsOneGroove) {
    for (const double friction : {0.0, 0.5}) {
        const auto run = [&](int plates) {
            Scene scene = exact_scene(0.5, friction, kG);
            scene.simulation.duration = 1;
            for (const double side : {-1.0, 1.0}) {
                const Quat turned(Eigen::AngleAxisd(side * M_PI / 4, Vec3::UnitX()));
                const double length = 6.0 / plates;
                for (int i = 0; i < plates; ++i)
                    add_box(scene, turned * Vec3((i + 0.5) * length, 0, -0.05), {length, 2, 0.1},
                            turned);
            }
            add_ball(scene, {0.3, 0, kSeamR * std::sqrt(2.0)}, {2, 0, 0}, kSeamR);
            return simulate(scene).motion;
        };
        const Motion one = run(1), many = run(7);
        const BallState a = one.balls[0].at(1), b = many.balls[0].at(1);
        EXPECT_LE((a.position - b.position).norm(), kSeam) << friction;
        EXPECT_LE((a.velocity - b.velocity).norm(), kSeam) << friction;
        EXPECT_EQ(one.events.size(), many.events.size()) << friction;
    }
}

}  // namespace
}  // namespace carom::testing
