// Flights through air (method exact), against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "exact_scenes.h"

namespace carom::testing {
namespace {

constexpr double kFlightG = 9.81;  // m/s^2

/// A ball in air of 1.225 kg/m^3 without buoyancy, on a floor of this coefficient.
Scene in_air(double mass, double radius, double drag, double restitution) {
    Scene scene = exact_scene(restitution, 0, kFlightG);
    scene.air = Air{};
    scene.air->buoyancy = false;
    add_plane(scene, Vec3::UnitZ(), 0);
    Ball& ball = add_ball(scene, Vec3(0, 0, radius), Vec3::Zero(), radius);
    ball.mass = mass;
    ball.flight.drag = {Drag::Over::kNothing, drag, nullptr};
    return scene;
}

double terminal_speed(double mass, double radius, double drag) {
    return std::sqrt(2 * mass * kFlightG / (1.225 * std::numbers::pi * radius * radius * drag));
}

struct Bounce {
    double impact, peak;  // s, m
};

/// The closed form: fall speed V sqrt(1 - exp(-h/q)), time V/g arcosh exp(h/2q); rise height
/// q ln(1 + (v/V)^2), time V/g arctan(v/V); q = V^2/2g.
std::vector<Bounce> closed_form(double terminal, double drop, double e, int count) {
    using Number = long double;
    const Number v = terminal, g = kFlightG, q = v * v / (2 * g);
    Number height = drop, time = 0;
    std::vector<Bounce> bounces;
    for (int i = 0; i < count; ++i) {
        time += v / g * std::acosh(std::exp(height / (2 * q)));
        const Number up = e * v * std::sqrt(-std::expm1(-height / q));
        height = q * std::log1p((up / v) * (up / v));
        bounces.push_back({static_cast<double>(time), static_cast<double>(height)});
        time += v / g * std::atan(up / v);
    }
    return bounces;
}

TEST(Flight, BouncesInAirFollowTheClosedForm) {
    struct Case {
        const char* name;
        double mass, radius, drag, drop, e;
    };
    for (const Case& c : {Case{"basketball", 0.6085, 0.121674, 0.50, 1.8, 0.845354},
                          Case{"volleyball", 0.27, 0.105042, 0.47, 1.0, 0.786628},
                          Case{"football", 0.4325, 0.109817, 0.50, 2.0, 0.818731},
                          Case{"tennis", 0.0577, 0.0334975, 0.507, 2.54, 0.744978},
                          Case{"table tennis", 0.0027, 0.02, 0.45, 0.305, 0.9}}) {
        Scene scene = in_air(c.mass, c.radius, c.drag, c.e);
        scene.balls[0].position.z() += c.drop;
        const SimulationResult r = run(scene, 8);
        const double terminal = terminal_speed(c.mass, c.radius, c.drag);
        const std::vector<Bounce> exact = closed_form(terminal, c.drop, c.e, 10);
        const std::vector<Event> impacts = impacts_of(r.motion);
        ASSERT_GE(impacts.size(), 10u);
        ASSERT_GE(r.motion.peaks[0].size(), 10u);
        double time_off = 0, peak_off = 0;
        for (std::size_t i = 0; i < 10; ++i) {
            time_off = std::max(time_off, std::abs(impacts[i].time - exact[i].impact));
            peak_off = std::max(peak_off, std::abs(r.motion.peaks[0][i].height - exact[i].peak));
        }
        std::printf("%s: times within %.2g s, peaks within %.2g m\n", c.name, time_off, peak_off);
        EXPECT_LT(time_off, 1e-12);
        EXPECT_LT(peak_off, 1e-12);
    }
}

/// Numbers of an independent integration in 30 digits.
TEST(Flight, TableTennisBallBouncesTenTimes) {
    Scene scene = in_air(0.0027, 0.02, 0.45, 0.9);
    scene.balls[0].position.z() += 0.305;
    const SimulationResult r = run(scene, 3);
    const std::vector<Event> impacts = impacts_of(r.motion);
    EXPECT_NEAR(impacts.at(0).time, 0.2509913044257485, 1e-13);
    EXPECT_NEAR(impacts.at(0).approach_speed, 2.399157370092497, 1e-12);
    EXPECT_NEAR(r.motion.peaks[0].at(0).height, 0.2306689170379615, 1e-12);
    EXPECT_NEAR(impacts.at(10).time, 2.91444578843316, 1e-12);
}

Scene thrown(const Vec3& velocity, double drag) {
    Scene scene = in_air(0.0577, 0.033497, drag, 0.7);
    scene.surfaces.clear();
    scene.balls[0].position.setZero();
    scene.balls[0].velocity = velocity;
    return scene;
}

/// A throw by Bernoulli's hodograph, its quadrature in 30 digits.
TEST(Flight, ThrowWithDrag) {
    const double angle = 20 * std::numbers::pi / 180;
    Scene scene = thrown(30 * Vec3(std::cos(angle), 0, std::sin(angle)), 0.507);
    const SimulationResult r = run(scene, 2);
    const BallState top = r.motion.balls[0].at(0.8472676482250378);
    EXPECT_NEAR(top.position.x(), 19.58086539858486, 1e-10);
    EXPECT_NEAR(top.position.z(), 4.01051544695244, 1e-10);
    EXPECT_NEAR(top.velocity.z(), 0, 1e-10);
    const BallState down = r.motion.balls[0].at(1.797962353226131);
    EXPECT_NEAR(down.position.x(), 35.25004855230666, 1e-10);
    EXPECT_NEAR(down.position.z(), 0, 1e-10);
    EXPECT_NEAR(down.velocity.norm(), 16.25323269208484, 1e-10);
}

/// After a second without gravity, thrown along x with spin about z.
BallState turned(const Lift& lift, double spin) {
    Scene scene = thrown(Vec3(30, 0, 0), 0.507);
    scene.simulation.gravity.setZero();
    scene.balls[0].flight.lift = lift;
    scene.balls[0].spin = Vec3(0, 0, spin);
    return run(scene, 1).motion.balls[0].at(1);
}

TEST(Flight, ConstantLiftTurnsOnACircle) {
    const BallState s = turned({Lift::Over::kNothing, 0.2, nullptr}, 200);
    EXPECT_NEAR(s.position.x(), 23.62297416755737, 1e-10);
    EXPECT_NEAR(s.position.y(), 2.104723378711842, 1e-10);  // w x u: to the left
}

TEST(Flight, LiftByTheSpinRatioTurnsOnASpiral) {
    const BallState s = turned({Lift::Over::kSpinRatio, 0, nullptr}, 300);
    EXPECT_NEAR(s.position.x(), 23.25248182373246, 1e-10);
    EXPECT_NEAR(s.position.y(), 4.085113995239079, 1e-10);
}

/// Backspin lifts: without drag the path is a cycloid.
TEST(Flight, BackspinLiftsOnACycloid) {
    Scene scene = thrown(Vec3(20, 0, 5), 0);
    const Ball& ball = scene.balls[0];
    const double per_spin = 1.225 * std::numbers::pi * std::pow(ball.radius, 3) / (2 * ball.mass);
    scene.balls[0].flight.lift = {Lift::Over::kSpinRatio, 0, nullptr};
    scene.balls[0].spin = Vec3(0, -0.4 / per_spin, 0);  // moving along x, its lower side ahead
    const BallState s = run(scene, 2).motion.balls[0].at(2);
    EXPECT_NEAR(s.position.x(), 37.14374308853872, 1e-10);
    EXPECT_NEAR(s.position.z(), 5.535945785733843, 1e-10);
}

/// The same motion seen from a carriage that the wind drives.
TEST(Flight, WindIsAChangeOfFrame) {
    const Vec3 wind(3, -2, 1);
    Scene still = thrown(Vec3(12, 4, 9), 0.507), windy = still;
    still.balls[0].spin = windy.balls[0].spin = Vec3(10, 50, -20);
    still.balls[0].flight.lift = windy.balls[0].flight.lift = {Lift::Over::kTennis, 0, nullptr};
    windy.air->wind = wind;
    windy.balls[0].velocity += wind;
    const Motion a = run(still, 2).motion, b = run(windy, 2).motion;
    for (const double t : {0.3, 0.9, 2.0}) {
        EXPECT_LT((a.balls[0].at(t).position + t * wind - b.balls[0].at(t).position).norm(), 1e-12);
        EXPECT_LT((a.balls[0].at(t).velocity + wind - b.balls[0].at(t).velocity).norm(), 5e-12);
    }
}

/// Buoyancy alone: a parabola under less gravity; m (1 - rho V / m) g.
TEST(Flight, BuoyancyIsLessGravity) {
    Scene scene = thrown(Vec3(1, 0, 8), 0);
    scene.air->buoyancy = true;
    const Ball& ball = scene.balls[0];
    const double part = 1.225 * 4 / 3 * std::numbers::pi * std::pow(ball.radius, 3) / ball.mass;
    EXPECT_NEAR(part, 0.0033, 1e-4);
    const BallState s = run(scene, 1.5).motion.balls[0].at(1.5);
    EXPECT_NEAR(s.position.z(), 8 * 1.5 - 0.5 * kFlightG * (1 - part) * 1.5 * 1.5, 1e-13);
}

/// exp(-t / T), and the angle that it makes.
TEST(Flight, SpinDecays) {
    Scene scene = thrown(Vec3(1, 0, 8), 0.507);
    scene.balls[0].spin = Vec3(0, 0, 30);
    scene.balls[0].flight.spin_decay_s = 0.8;
    const BallState s = run(scene, 1.2).motion.balls[0].at(1.2);
    const double angle = 30 * 0.8 * -std::expm1(-1.2 / 0.8);
    EXPECT_NEAR(s.spin.z(), 30 * std::exp(-1.2 / 0.8), 1e-12);
    const Quat turned(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
    EXPECT_LT(s.orientation.angularDistance(turned), 1e-11);
}

/// Two terminal speeds lie within a drag crisis: a fall from rest stays at the lower one, one that
/// begins fast at the upper one.
TEST(Flight, DragCrisisHasTwoTerminalSpeeds) {
    const auto table = std::make_shared<const MonotoneCurve>(
        std::vector<double>{0, 17, 20, 40}, std::vector<double>{0.47, 0.47, 0.15, 0.15});
    for (const auto& [start, end] : {std::pair{0.0, 0.47}, std::pair{30.0, 0.15}}) {
        Scene scene = in_air(0.27, 0.105042, 0, 1);
        scene.surfaces.clear();
        scene.balls[0].velocity = Vec3(0, 0, -start);
        scene.balls[0].flight.drag = {Drag::Over::kSpeed, 0, table};
        const BallState s = run(scene, 60).motion.balls[0].at(60);
        EXPECT_NEAR(-s.velocity.z(), terminal_speed(0.27, 0.105042, end), 1e-9);
    }
}

/// Energy falls all the way, and the ball comes to rest in air as it does without.
TEST(Flight, BouncesComeToRest) {
    Scene scene = in_air(0.0027, 0.02, 0.45, 0.7);
    scene.air->buoyancy = true;
    scene.balls[0].position.z() += 0.5;
    scene.balls[0].velocity = Vec3(0.2, 0, 0);
    const SimulationResult r = run(scene, 6);
    double least = std::numeric_limits<double>::infinity();
    const double pull = kFlightG * (1 - buoyant_part(*scene.air, 0.02, 0.0027));
    for (int k = 0; k <= 6000; ++k) {
        const BallState s = r.motion.balls[0].at(0.001 * k);
        const double energy = 0.5 * s.velocity.squaredNorm() + pull * s.position.z();
        EXPECT_LE(energy, least * (1 + 1e-12));
        least = std::min(least, energy);
        EXPECT_GE(s.position.z(), 0.02 - 1e-12);
    }
    EXPECT_NEAR(r.motion.balls[0].at(6).position.z(), 0.02, 1e-12);
    EXPECT_LT(r.motion.events.size(), 200u);
}

// ---- In contact
// -------------------------------------------------------------------------------------

/// K of the drag K u^2 [1/m].
double drag_per_speed(const Ball& ball, double drag) {
    return 0.5 * 1.225 * drag * std::numbers::pi * ball.radius * ball.radius / ball.mass;
}

/// On a smooth floor v = v0 / (1 + K v0 t); a ball that rolls has 1 + k times the inertia.
TEST(AirOnTheFloor, SlidingAndRollingSlowDown) {
    for (const double friction : {0.0, 0.5}) {
        Scene scene = exact_scene(0.5, friction, kFlightG);
        scene.air = Air{.buoyancy = false};
        add_plane(scene);
        Ball& ball = add_ball(scene, Vec3(0, 0, 0.1), Vec3(4, 0, 0), 0.1);
        ball.mass = 0.2;
        if (friction > 0) ball.spin = Vec3(0, 40, 0);
        ball.flight.drag = {Drag::Over::kNothing, 0.5, nullptr};
        const double inertia = friction > 0 ? 1 + ball.inertia_factor : 1;
        const double rate = drag_per_speed(ball, 0.5) * 4 / inertia;
        const BallState s = run(scene, 5).motion.balls[0].at(5);
        EXPECT_NEAR(s.velocity.x(), 4 / (1 + 5 * rate), 1e-12);
        EXPECT_NEAR(s.position.x(), 4 / rate * std::log1p(5 * rate), 1e-11);
        if (friction > 0) {
            EXPECT_NEAR(s.spin.y(), s.velocity.x() / 0.1, 1e-11);
        }
    }
}

/// Wind sets a ball on a smooth floor in motion: its speed through the air falls as above.
TEST(AirOnTheFloor, WindDrivesABallAtRest) {
    Scene scene = exact_scene(0.5, 0, kFlightG);
    scene.air = Air{.wind = Vec3(6, 0, 0), .buoyancy = false};
    add_plane(scene);
    Ball& ball = add_ball(scene, Vec3(0, 0, 0.1), Vec3::Zero(), 0.1);
    ball.mass = 0.2;
    ball.flight.drag = {Drag::Over::kNothing, 0.5, nullptr};
    const double rate = drag_per_speed(ball, 0.5) * 6;
    const BallState s = run(scene, 3).motion.balls[0].at(3);
    EXPECT_NEAR(s.velocity.x(), 6 - 6 / (1 + 3 * rate), 1e-11);
}

/// Two smooth planes hold the ball: both contacts are integrated together.
TEST(AirOnTheFloor, SlidesAlongAGroove) {
    Scene scene = exact_scene(0.5, 0, kFlightG);
    scene.air = Air{.buoyancy = false};
    const double s45 = std::sqrt(0.5);
    add_plane(scene, Vec3(0, s45, s45), 0);
    add_plane(scene, Vec3(0, -s45, s45), 0);
    Ball& ball = add_ball(scene, Vec3(0, 0, 0.1 / s45), Vec3(4, 0, 0), 0.1);
    ball.mass = 0.2;
    ball.flight.drag = {Drag::Over::kNothing, 0.5, nullptr};
    const double rate = drag_per_speed(ball, 0.5) * 4;
    const BallState s = run(scene, 5).motion.balls[0].at(5);
    EXPECT_NEAR(s.velocity.x(), 4 / (1 + 5 * rate), 1e-10);
    EXPECT_NEAR(s.position.x(), 4 / rate * std::log1p(5 * rate), 1e-9);
}

/// Where half of every ball's weight is carried, all goes as under half of the gravity: a ball that
/// bounces onto a heap of others in a corner, through impacts, rolling and islands. What a step of
/// ODE takes for slow goes by gravity itself: there they part.
TEST(AirOnTheFloor, BuoyancyIsLessGravityInAHeap) {
    const auto heap = [](double gravity, bool buoyancy) {
        Scene scene = exact_scene(0.5, 0.3, gravity);
        if (buoyancy) scene.air = Air{.density = 500, .viscosity = 1};
        add_plane(scene);
        add_plane(scene, Vec3(0.6, 0, 0.8), -0.1);
        for (int i = 0; i < 4; ++i) {
            const Vec3 at(0.03 * i + 0.001 * i * i, 0.002 * (i % 3), 0.06 + 0.105 * i);
            Ball& ball = add_ball(scene, at, Vec3::Zero(), 0.05);
            ball.mass = 1000 * 4.0 / 3 * std::numbers::pi * std::pow(0.05, 3);
            ball.flight.drag = {Drag::Over::kNothing, 0, nullptr};
        }
        return scene;
    };
    Scene light = heap(8, false), carried = heap(16, true);
    const SimulationResult a = run(light, 0.6), b = run(carried, 0.6);
    double apart = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (const double t : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
            apart = std::max(
                apart,
                (a.motion.balls[i].at(t).position - b.motion.balls[i].at(t).position).norm());
    std::printf("%lld and %lld impacts, %lld and %lld pieces integrated, apart by %.2g m\n",
                static_cast<long long>(a.report.impacts), static_cast<long long>(b.report.impacts),
                static_cast<long long>(a.report.integrated),
                static_cast<long long>(b.report.integrated), apart);
    EXPECT_GT(b.report.impacts, 10);
    EXPECT_LT(apart, 1e-9);
}

/// The paper's loop with the air's forces comes to the exact motion as its step does to 0.
TEST(Flight, FixedStepsConverge) {
    Scene scene = in_air(0.0577, 0.033497, 0.507, 0.7);
    scene.balls[0].position = Vec3(0, 0, 1);
    scene.balls[0].velocity = Vec3(20, 0, 3);
    scene.balls[0].spin = Vec3(0, -200, 0);
    scene.balls[0].flight.lift.over = Lift::Over::kTennis;
    scene.balls[0].flight.spin_decay_s = 5;
    const BallState exact = run(scene, 0.6).motion.balls[0].at(0.6);
    scene.simulation.method = Method::kFixed;
    std::vector<double> errors;
    for (const double step : {1e-3, 5e-4, 2.5e-4}) {
        scene.simulation.step = step;
        const BallState s = run(scene, 0.6).motion.balls[0].at(0.6);
        errors.push_back((s.position - exact.position).norm());
        EXPECT_LT((s.spin - exact.spin).norm(), 10 * step * exact.spin.norm());
    }
    EXPECT_LT(errors[0], 0.02);
    EXPECT_NEAR(errors[1] / errors[0], 0.5, 0.05);
    EXPECT_NEAR(errors[2] / errors[1], 0.5, 0.05);
}

/// A ball that spins beside a wall without moving: lift presses it on only once it falls.
TEST(Flight, LiftPressesWhatTouchesWithoutSpeed) {
    Scene scene = exact_scene(0.3, 0, kFlightG);
    scene.air = Air{.density = 9};
    add_plane(scene, Vec3::UnitX(), 0);
    Ball& ball = add_ball(scene, Vec3(0.03, 0, 0), Vec3::Zero(), 0.03);
    ball.mass = 0.8;
    ball.flight.drag = {Drag::Over::kNothing, 0, nullptr};
    ball.flight.lift = {Lift::Over::kSpinRatio, 0, nullptr};
    for (const double side : {1.0, -1.0}) {
        ball.spin = Vec3(0, side * 150, 0);
        const Motion motion = run(scene, 0.2).motion;
        double least = 1, most = 0;
        for (int i = 0; i <= 200; ++i) {
            const double gap = motion.balls[0].at(1e-3 * i).position.x() - 0.03;
            least = std::min(least, gap);
            most = std::max(most, gap);
        }
        EXPECT_GE(least, -1e-13);
        if (side > 0) {
            EXPECT_LT(most, 1e-13);  // held by the wall all along
        } else {
            EXPECT_GT(most, 1e-5);
        }
    }
}

}  // namespace
}  // namespace carom::testing
