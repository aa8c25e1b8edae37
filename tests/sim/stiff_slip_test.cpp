// Slips that friction ends within microseconds, and contacts that cannot be integrated.
#include <fmt/core.h>

#include <cmath>

#include "curved_scenes.h"

namespace carom::testing {
namespace {

/// On a plane v + k R w x n grows by g_t t under any friction, since friction changes v and the
/// spin together. When the slip is over, v = R w x n: so the state after it is known.
TEST(StiffSlip, ATurningSlipEndsInTheKnownRollingForAnyFriction) {
    double worst = 0;
    for (const double mu : {0.8, 3.0, 5.0, 12.0, 25.0, 100.0, 200.0, 1000.0})
        for (const double k : {kSolid, kShell})
            for (const Vec3& spin : {Vec3(0, 0, 10), Vec3(3, -2, 1)}) {
                Scene scene = exact_scene(0.3, mu, kGravity);
                scene.simulation.gravity = Vec3(4.905, 0, -8.4957);
                scene.simulation.duration = 0.7;
                add_plane(scene);
                Ball& ball = add_ball(scene, {0, 0, 0.1}, {0, 1, 0}, 0.1);
                ball.inertia_factor = k;
                ball.spin = spin;
                const SimulationResult result = simulate(scene);
                const BallState s = result.motion.balls[0].at(0.7);
                const Vec3 n = Vec3::UnitZ();
                const Vec3 g_t(4.905, 0, 0);
                const Vec3 kept = Vec3(0, 1, 0) + k * 0.1 * spin.cross(n) + 0.7 * g_t;
                const Vec3 v = kept / (1 + k);
                worst = std::max(worst, (s.velocity - v).norm());
                EXPECT_LE((s.velocity - v).norm(), 1e-10) << "mu " << mu << ", k " << k;
                EXPECT_LE(slip_of(ball, s, n).norm(), 1e-10) << "mu " << mu << ", k " << k;
                EXPECT_FALSE(result.report.effects.at("last_resort").on) << mu;
            }
    fmt::print("rolls on within {:.1e} m/s\n", worst);
}

/// Energy never rises, and the run ends, on round surfaces as well.
TEST(StiffSlip, EndsOnSpheresAndCapsulesToo) {
    for (const double mu : {5.0, 12.0, 60.0, 200.0})
        for (const bool sphere : {true, false}) {
            Scene scene = exact_scene(0, mu, kGravity);
            scene.simulation.duration = 0.5;
            if (sphere)
                add_surface(scene, "s", SphereShape{Vec3(0, 0, -1), 1});
            else
                add_surface(scene, "s", CapsuleShape{Vec3(-2, 0, -1), Vec3(2, 0, -1), 1});
            Ball& ball = add_ball(scene, {0, 0, 0.1}, {0.3, 0.2, 0}, 0.1);
            ball.spin = Vec3(5, -8, 20);
            const Motion motion = simulate(scene).motion;
            double least = energy(scene, motion.balls[0].at(0));
            for (int i = 1; i <= 100; ++i) {
                const double now = energy(scene, motion.balls[0].at(0.005 * i));
                EXPECT_LE(now, least + 1e-10) << mu << " at " << 0.005 * i;
                least = std::min(least, now);
            }
        }
}

/// One shell in the corner of two walls, found among random scenes: grip and slip change at once.
TEST(StiffSlip, AShellInACornerComesToItsEnd) {
    Scene scene = exact_scene(1, 0, 0);
    scene.simulation.gravity = Vec3(6.35270619355428, 6.45985091760508, 3.7615887788766873);
    scene.simulation.duration = 1.801;
    scene.simulation.restitution_constant = 4.920764257930452;
    scene.materials[1].virtual_body = {1.1773902268942036, 2.5007559575239835};
    scene.materials[1].friction = 5;
    scene.materials[2].virtual_body = virtual_body(1);
    scene.materials[2].friction = 0.11591076542474617;
    add_plane(scene, Vec3(-1, 0, 0), -3.475301774398923);
    add_plane(scene, Vec3(0, -1, 0), -0.730994151982081);
    scene.surfaces[1].material = 1;
    Ball& ball = add_ball(scene, {3.1289756366746366, -0.39426466210950173, -1.284425566490277},
                          Vec3::Zero(), 0.026871598072789576);
    ball.mass = 0.8726625424008146;
    ball.inertia_factor = kShell;
    ball.spin = Vec3(31.068068813108823, -47.2075641953409, -34.46209428356054);
    const SimulationResult result = simulate(scene);
    const BallState s = result.motion.balls[0].at(1.801);
    EXPECT_TRUE(s.position.allFinite());
    EXPECT_LE(energy(scene, s), energy(scene, result.motion.balls[0].at(0)) * (1 + 1e-9));
    EXPECT_GE(3.475301774398923 - s.position.x(), ball.radius - 1e-9);
    EXPECT_GE(0.730994151982081 - s.position.y(), ball.radius - 1e-9);
}

/// Friction at a wall lifts the ball off the floor, whose friction throws it at the wall: impacts
/// that get smaller without end, and a contact that begins and ends at once where they have come to
/// it. The run goes on, and energy does not rise.
TEST(StiffSlip, ImpactsWithoutEndInACornerComeToOne) {
    int given_up = 0;
    for (const double mu : {1.0, 4.0, 3.55566674908603 * 3.55566674908603})
        for (const double more : {0.0, 0.1}) {
            Scene scene = exact_scene(0, mu, kGravity);
            scene.simulation.duration = 1.4;
            add_plane(scene, Vec3::UnitZ(), -1.5);
            add_plane(scene, -Vec3::UnitX(), -1.5);
            const Vec3 at(0.5927809247424802, 0.3530294387304651, -0.29347438253622843);
            const Vec3 v(0.9019196629265838, -0.07511405660473429, 0.1815726630886795);
            add_ball(scene, at, (1 + more) * v, 0.06988184327889294).mass = 1.725720321578972;
            const SimulationResult result = simulate(scene);
            given_up += static_cast<int>(result.report.given_up);
            double least = energy(scene, result.motion.balls[0].at(0));
            for (int i = 1; i <= 400; ++i) {
                const double now = energy(scene, result.motion.balls[0].at(0.0035 * i));
                EXPECT_LE(now, least + 1e-9) << mu << " at " << 0.0035 * i;
                least = std::min(least, now);
            }
        }
    fmt::print("{} times the last resort\n", given_up);
    EXPECT_GE(given_up, 1);
}

}  // namespace
}  // namespace carom::testing
