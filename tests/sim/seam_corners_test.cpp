// Balls exactly over seams and corners of flush surfaces, where rounding says on which side.
#include <cmath>

#include "curved_scenes.h"

namespace carom::testing {
namespace {

constexpr double kCornerG = kGravity, kCornerR = 0.05;

/// As of other seams, m and m/s.
constexpr double kCornerSeam = 1e-11;

/// A floor turned about z by `angle` [rad], in two rows that meet in the line through the origin,
/// or in one piece.
void add_floor(Scene& scene, double angle, bool in_parts) {
    const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
    const double ends[] = {-1.1, 0.2, 0.7, 2.4};
    if (!in_parts) {
        add_surface(scene, "floor",
                    BoxShape{turn * Vec3(0.65, 0, -0.25), Vec3(3.5, 1.4, 0.5), turn});
        return;
    }
    for (int i = 0; i < 3; ++i)
        for (const double y : {-0.35, 0.35})
            add_surface(scene, "tile",
                        BoxShape{turn * Vec3(0.5 * (ends[i] + ends[i + 1]), y, -0.25),
                                 Vec3(ends[i + 1] - ends[i], 0.7, 0.5), turn});
}

TEST(SeamCorners, ABallDroppedOnASeamComesToRestThere) {
    for (const double restitution : {0.0, 0.5})
        for (const double along : {0.05, 0.2})
            for (int i = 0; i < 24; ++i) {
                const double angle = 0.27 * i;
                const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
                const Vec3 start = turn * Vec3(along, 0, 0) + Vec3(0, 0, 0.1);
                Scene scene = exact_scene(restitution, 0.3, kCornerG);
                scene.simulation.duration = 1.5;
                add_floor(scene, angle, true);
                add_ball(scene, start, Vec3(0, 0, -0.5), kCornerR);
                const Motion motion = simulate(scene).motion;
                const BallState s = motion.balls[0].at(1.5);
                EXPECT_LE((s.position - Vec3(start.x(), start.y(), kCornerR)).norm(), kCornerSeam)
                    << angle;
                EXPECT_LE(s.velocity.norm() + kCornerR * s.spin.norm(), kCornerSeam) << angle;
                only(motion, EventKind::kRest);
            }
}

/// Along the seam, then away from it by the friction of a slip across it: as on one floor.
TEST(SeamCorners, ABallDriftsAwayFromTheSeamItGoesAlong) {
    for (int i = 0; i < 12; ++i)
        for (const double across : {-6.0, 6.0}) {
            const double angle = 0.53 * i;
            const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
            Motion motions[2];
            for (const bool in_parts : {false, true}) {
                Scene scene = exact_scene(0, 0.01, kCornerG);
                scene.simulation.duration = 0.35;
                add_floor(scene, angle, in_parts);
                Ball& ball = add_ball(scene, Vec3(0, 0, kCornerR), turn * Vec3(6, 0, 0), kCornerR);
                ball.spin = turn * Vec3(across, 30, 20);
                const SimulationResult r = simulate(scene);
                EXPECT_EQ(r.report.steps, 0) << angle;
                motions[in_parts] = r.motion;
            }
            const BallState one = motions[0].balls[0].at(0.35),
                            parts = motions[1].balls[0].at(0.35);
            EXPECT_GT(std::abs((turn.conjugate() * one.position).y()), 1e-5);
            EXPECT_LE((one.position - parts.position).norm(), kCornerSeam)
                << angle << " " << across;
            EXPECT_LE((one.velocity - parts.velocity).norm(), kCornerSeam)
                << angle << " " << across;
            EXPECT_EQ(motions[0].events.size(), motions[1].events.size()) << angle;
        }
}

}  // namespace
}  // namespace carom::testing
