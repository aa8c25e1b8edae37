// No motion gives energy, to the rounding of its numbers: along integrated pieces, where slips and
// bouncing series end, and within steps of ODE.
#include <algorithm>
#include <cmath>

#include "curved_scenes.h"
#include "scene/reader.h"
#include "sim/law/single_contact.h"
#include "sim/world/energy_account.h"

namespace carom::testing {
namespace {

constexpr double kG = kGravity;

/// How far the energy [J] rises above what it had been before, at the starts of all pieces and at
/// instants between, on both sides of each, up to `end` [s].
double rise_of_energy(const Scene& scene, const Motion& motion, double end) {
    std::vector<double> times;
    for (const Trajectory& ball : motion.balls)
        for (std::size_t i = 0; i < ball.pieces().size(); ++i) {
            const double begin = ball.pieces()[i].start;
            const bool last = i + 1 == ball.pieces().size();
            const double next = last ? motion.duration : ball.pieces()[i + 1].start;
            for (int k = 0; k < 16; ++k) times.push_back(begin + (next - begin) * k / 16);
        }
    std::sort(times.begin(), times.end());
    double least = INFINITY, rise = 0;
    for (const double t : times)
        for (const bool before : {true, false}) {
            if (t > end) continue;
            double sum = 0;
            for (std::size_t b = 0; b < scene.balls.size(); ++b) {
                const Ball& ball = scene.balls[b];
                const Trajectory& path = motion.balls[b];
                const BallState s =
                    path.pieces()[path.piece_index(before ? std::nextafter(t, -1) : t)].at(t);
                sum += ball.mass * (0.5 * s.velocity.squaredNorm() +
                                    0.5 * ball.inertia_factor * ball.radius * ball.radius *
                                        s.spin.squaredNorm() -
                                    scene.simulation.gravity.dot(s.position - ball.position));
            }
            rise = std::max(rise, sum - least);
            least = std::min(least, sum);
        }
    return rise;
}

/// A ball slides over the edge of a box without friction, and leaves it: 0.5 v^2 + g R = 1.1 J.
TEST(Energy, OverAnEdgeItIsKept) {
    double worst = 0;
    for (const double speed : {0.2, 0.3, 0.45, 0.6, 0.8}) {
        Scene scene = exact_scene(0, 0, kG);
        scene.simulation.duration = 2;
        add_surface(scene, "box", BoxShape{Vec3(-1, 0, -0.5), Vec3(2, 2, 1), Quat::Identity()});
        add_ball(scene, Vec3(-0.2, 0, 0.1), Vec3(speed, 0, 0), 0.1);
        const Motion motion = simulate(scene).motion;
        const Event leaves = only(motion, EventKind::kLeave);
        worst = std::max(worst, rise_of_energy(scene, motion, leaves.time));
    }
    std::printf("energy rises by %.2g J at most (6e-13)\n", worst);
    EXPECT_LE(worst, 6e-13);
}

/// It rolls down over a joint of two rails.
TEST(Energy, OverAJointOfRailsItIsKept) {
    double worst = 0;
    for (const double speed : {0.7, 0.8, 1.0}) {
        Scene scene = exact_scene(0, 1, kG);
        scene.simulation.duration = 0.6;
        for (const double y : {-0.1, 0.1}) {
            add_surface(scene, "level", CapsuleShape{Vec3(-1, y, 0), Vec3(0, y, 0), 0.125});
            add_surface(scene, "steep", CapsuleShape{Vec3(0, y, 0), Vec3(0.8, y, -0.4), 0.125});
        }
        add_ball(scene, Vec3(-0.1, 0, std::sqrt(0.185 * 0.185 - 0.01)), Vec3(speed, 0, 0), 0.06);
        worst = std::max(worst, rise_of_energy(scene, simulate(scene).motion, 0.6));
    }
    std::printf("energy rises by %.2g J at most (1e-12)\n", worst);
    EXPECT_LE(worst, 1e-12);
}

/// An impulse of friction that stops a slip s takes m s^2 / (2 (1 + 1/k)), and leaves the angular
/// momentum about the contact point: n x v + k R w.
TEST(Energy, TheEndOfASlipTakesItsEnergy) {
    SingleContact contact;
    contact.distance = contact.radius = 0.1;
    contact.inertia_factor = 2.0 / 3;
    contact.across = Vec3::UnitZ() * Vec3::UnitZ().transpose();
    const ContactState before{Vec3(0, 0, 0.1), Vec3(1, 0.2, 0), Vec3(3, 11, -2)};
    ContactState after = before;
    end_slip(contact, after);
    const Vec3 n = Vec3::UnitZ();
    const auto slip = [&](const ContactState& s) -> Vec3 { return s.v - 0.1 * s.w.cross(n); };
    const auto about_contact = [&](const ContactState& s) -> Vec3 {
        return n.cross(s.v) + (2.0 / 3) * 0.1 * s.w;
    };
    EXPECT_LE(slip(after).norm(), 1e-15);
    EXPECT_LE((about_contact(after) - about_contact(before)).norm(), 1e-15);
    EXPECT_EQ(after.w.z(), before.w.z());
    const double lost = energy_difference(before, after, 0.1, 2.0 / 3, Vec3::Zero());
    EXPECT_NEAR(lost, slip(before).squaredNorm() / (2 * 2.5), 1e-15);
}

/// A slip that turns across a slope ends in rolling.
TEST(Energy, WhereASlipTurnsIntoRollingItDoesNotRise) {
    Scene scene = exact_scene(0, 1, kG);
    scene.simulation.duration = 0.3;
    const Vec3 n = Vec3(0.12343085506718862, -0.021521650881630442, 0.9921197722859433);
    add_plane(scene, n);
    Ball& ball = add_ball(scene, 0.1 * n, Vec3(1.9, -0.33, 0), 0.1);
    ball.inertia_factor = 2.0 / 3;
    ball.spin = Vec3(1.8, 7.4, -4.9);
    const Motion motion = simulate(scene).motion;
    ASSERT_EQ(events_of(motion, EventKind::kRoll).size(), 1u);
    const double rise = rise_of_energy(scene, motion, 0.3);
    std::printf("energy rises by %.2g J (1e-13)\n", rise);
    EXPECT_LE(rise, 1e-13);
}

/// A ball that rolls along a groove of two planes hops on one of them: its impacts grip, and the
/// end of their series has no friction to give back.
TEST(Energy, BouncesThatGripEndWithoutAGain) {
    const char* text = R"(carom: 1
simulation: {duration: 1.25, gravity: [0, 0, -9.81]}
materials:
  m1: {restitution: 0.41, friction: 3.076182951417199}
  m2: {restitution: 0.41, friction: 0.5425341197553754}
surfaces:
  - name: s2
    plane: {normal: [-0.7600784401359856, -0.35682826614165364, 0.5430970017619211], offset: -1.5}
    material: m2
  - name: s3
    plane: {normal: [0.5331144447355779, 0.13548476979834626, 0.8351244613630746], offset: -1.5}
    material: m1
balls:
  - name: b0
    radius: 0.09686743677910879
    mass: 9.58215242490688
    material: m2
    position: [0.10857023568935786, 1.0165210763310846, -0.8801678669384401]
    spin: [7.4512105684403185, 32.118178908911624, -42.67962918768723]
)";
    const SceneResult read = read_scene(text, "groove.yaml");
    ASSERT_TRUE(read.scene.has_value());
    const Motion motion = simulate(*read.scene).motion;
    ASSERT_GE(impacts_of(motion).size(), 20u);
    const double rise = rise_of_energy(*read.scene, motion, 1.25);
    std::printf("energy rises by %.2g J (1e-12)\n", rise);
    EXPECT_LE(rise, 1e-12);
}

/// e(u) = -L u + 4 B u (1 - u): its rise, found by looking, is (4 |B| - L)^2 / (16 |B|).
TEST(Energy, TheRiseOfAParabola) {
    for (const double loss : {0.0, 0.3, 1.0, 4.1})
        for (const double bulge : {-1.0, -0.2, 0.2, 1.0}) {
            double least = 0, rise = 0;
            for (int i = 0; i <= 100000; ++i) {
                const double u = i / 100000.0, e = -loss * u + 4 * bulge * u * (1 - u);
                least = std::min(least, e);
                rise = std::max(rise, e - least);
            }
            EXPECT_NEAR(rise_of_parabola(loss, bulge), rise, 1e-9) << loss << " " << bulge;
        }
}

/// What an account takes from speeds is the energy that was asked for, from the motion relative to
/// the centre of mass as long as there is some.
TEST(Energy, AnAccountTakesWhatItIsAskedFor) {
    EnergyAccount account;
    const Vec3 pull(0, 0, -10);
    account.add(2, 0.01, 0.1, Vec3(1, 0, 0), pull);
    account.add(3, 0.02, 0.2, Vec3(2, 0, 0), pull);
    const std::vector<Vec3> places = {Vec3(1, 0, 0.5), Vec3(2, 1, 0)};
    std::vector<Velocities> velocities = {{Vec3(1, 2, 0), Vec3(0, 0, 4)},
                                          {Vec3(-1, 0, 0), Vec3::Zero()}};
    const double before = account.total(places, velocities);
    EXPECT_NEAR(before, 5 + 0.08 + 1.5 + 2 * 10 * 0.5, 1e-14);
    const Vec3 momentum = 2 * velocities[0].linear + 3 * velocities[1].linear;
    EXPECT_TRUE(account.take_away(1, velocities));
    EXPECT_NEAR(account.total(places, velocities), before - 1, 1e-14);
    EXPECT_LE((2 * velocities[0].linear + 3 * velocities[1].linear - momentum).norm(), 1e-14);
    EXPECT_TRUE(account.take_away(5, velocities));
    EXPECT_NEAR(account.total(places, velocities), before - 6, 1e-14);
    EXPECT_FALSE(account.take_away(0, velocities));
}

constexpr const char* kCorner = R"(carom: 1
simulation: {duration: 0.6, gravity: [18.99695779666596, -13.951651541006468, 3.781646092500417]}
materials:
  m1: {restitution: {viscoelastic: {gamma: 0.013428782218579382}}, rolling: 0.0018875520750200913, pivoting: 0.004866324294965823, tangential_restitution: -0.6549935947164471}
  m2: {virtual_body: {distance: 0.9643041448477085, velocity: 1}, rolling: 0.0014271253722302208}
surfaces:
  - {name: s0, plane: {normal: [1, 0, 0], offset: -1.5}, material: m1}
  - {name: s1, plane: {normal: [-1, 0, 0], offset: -1.5}, material: m2}
  - {name: s2, plane: {normal: [0, 1, 0], offset: -1.5}, material: m1}
  - {name: s3, plane: {normal: [0, -1, 0], offset: -1.5}, material: m2}
  - {name: s4, plane: {normal: [0, 0, 1], offset: -1.5}, material: m2}
  - {name: s5, plane: {normal: [0, 0, -1], offset: -1.5}, material: m2}
balls:
  - {name: b0, radius: 0.2706131127849789, mass: 0.47974955959044696, inertia: 0.4, material: m2, position: [0.017067950929708253, -0.9242854151687967, 0.3302234047020862], velocity: [-2.101987527346337, -7.235052742219175, 2.5409948134857583]}
)";

constexpr const char* kFiveBalls = R"(carom: 1
simulation: {duration: 0.92, gravity: [9.50242301562637, -14.068898178961073, 7.522266500412829]}
materials:
  m1: {virtual_body: {distance: 0.25541281188299536, velocity: 1}, friction: 4.7052788331418585}
surfaces:
  - {name: s1, plane: {normal: [-1, 0, 0], offset: -1.5}, material: m1}
  - {name: s2, plane: {normal: [0, 1, 0], offset: -1.5}, material: m1}
  - {name: s5, plane: {normal: [0, 0, -1], offset: -1.5}, material: m1}
balls:
  - {name: b0, radius: 0.2262964162329692, mass: 1, inertia: 0.4, material: m1, position: [0.9785232106051618, -1.2737035837670307, 1.2588434002973128], velocity: [0.08938062687003029, 0.1010625615723642, 0.06257690348235229], spin: [-2.29202340462841, -3.664386337047089, 9.205238103893342]}
  - {name: b1, radius: 0.08768716193973751, mass: 1, inertia: 0.15300497976230246, material: m1, position: [1.1246080598826884, 0.6100880630813919, -1.3534805233437028], velocity: [0.09127514628387079, 1.6145754056427186, 2.038658385748853]}
  - {name: b2, radius: 0.03978146192799954, mass: 0.34751084127030096, inertia: 0.3407192650818287, material: m1, position: [-0.2228911607169759, -1.4602185380720005, 1.2668299132669967], velocity: [1.8776675177974982, 2.4510297350114114, -1.6131186527738095]}
  - {name: b3, radius: 0.02175928962102957, mass: 1, inertia: 0.4, material: m1, position: [0.8515854409043884, -1.0857647229051444, 1.1583574788552746], velocity: [-0.1319716600947055, 0.3909602657332707, -0.07736199661384995], spin: [-169.0781300102682, 66.80642284186168, 132.3756259777323]}
  - {name: b4, radius: 0.12946486369595003, mass: 0.42388381721887064, inertia: 0.6666666666666666, material: m1, position: [0.25964267449381073, 1.3175694709647203, 1.3705351363040499], velocity: [0.11530219091776404, -0.026112131643534847, 0.8871721306566983]}
)";

/// Found by random scenes. In the first a step let a ball that came to a wall go through it by its
/// gap, which gave 1.2e-6 J; in the second a ball was put on a floor, out of a step's overlap, for
/// nothing: 1.5e-7 J.
TEST(Energy, StepsThatMeetAWallKeepIt) {
    for (const char* text : {kCorner, kFiveBalls}) {
        const SceneResult read = read_scene(text, "steps.yaml");
        ASSERT_TRUE(read.scene);
        const SimulationResult result = simulate(*read.scene);
        EXPECT_GT(result.report.steps, 0);
        const Motion& motion = result.motion;
        double least = INFINITY, rise = 0;
        constexpr int kSamples = 40'000;
        for (int i = 0; i <= kSamples; ++i) {
            const double now = total_energy(*read.scene, motion, motion.duration * i / kSamples);
            rise = std::max(rise, now - least);
            least = std::min(least, now);
        }
        std::printf("energy rises by %.2g J at most (1e-8)\n", rise);
        EXPECT_LE(rise, 1e-8);
    }
}

}  // namespace
}  // namespace carom::testing
