// Surfaces that touch each other: flush (H32), and with a convex joint (H33).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "case.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

constexpr double kG = 9.81;
const Vec3 kUp = Vec3::UnitZ();

/// The largest of |z - r| over the motion, m.
double off_the_floor(const Scene& scene, const Motion& motion) {
    constexpr int kSamples = 1000;
    double off = 0;
    for (int i = 0; i <= kSamples; ++i) {
        const double t = motion.duration * i / kSamples;
        off = std::max(off, std::abs(motion.balls[0].at(t).position.z() - scene.balls[0].radius));
    }
    return off;
}

/// Goes on at its velocity, over all seams, and its speed never jumps.
Run straight_on(const std::string& how, double e, double mu, double v, bool rolls) {
    Run run;
    run.overrides = {set("materials.rubber.restitution", e), set("materials.rubber.friction", mu),
                     set("balls.ball.velocity", Vec3(v, 0, 0)),
                     set("balls.ball.spin", Vec3(0, rolls ? v / 0.1 : 0, 0))};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const BallState s = motion.balls[0].at(motion.duration);
        return Measures{
            vector_measure(how + ": place in the end, off by m", s.position,
                           scene.balls[0].position + motion.duration * Vec3(v, 0, 0), 1),
            vector_measure("velocity in the end, off by m/s", s.velocity, Vec3(v, 0, 0), v),
            vector_measure("spin in the end, off by 1/s", s.spin, scene.balls[0].spin, v / 0.1),
            scaled("off the floor, m", off_the_floor(scene, motion), 0, 0.1),
            scaled("jumps of the velocity", velocity_jumps(motion, 0, 1e-12 * v), 0, 1, 0)};
    };
    return run;
}

/// H14 on flush boxes: slides, and rolls from 2 v / (7 mu g) on.
Run slides_and_rolls() {
    const double v0 = 6, mu = 0.2;
    Run run;
    run.overrides = {set("materials.rubber.friction", mu),
                     set("balls.ball.velocity", Vec3(v0, 0, 0))};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const double t = 2 * v0 / (7 * mu * kG), v = 5.0 / 7 * v0, T = motion.duration;
        const BallState s = motion.balls[0].at(T);
        const double way = v0 * t - 0.5 * mu * kG * t * t + v * (T - t);
        return Measures{relative("slides, then rolls: way, m", s.position.x(), way),
                        relative("speed, m/s", s.velocity.x(), v),
                        relative("R w, m/s", 0.1 * s.spin.y(), v),
                        scaled("off the floor, m", off_the_floor(scene, motion), 0, 0.1)};
    };
    return run;
}

/// H1 with bounces on the seams at 1, 3 ... m where the coefficient is 1: all of them.
Run bounces(double e) {
    const double h = 0.5, first = std::sqrt(2 * h / kG), v = 1 / first;
    Run run;
    run.overrides = {set("materials.rubber.restitution", e),
                     set("balls.ball.position", Vec3(0, 0, 0.1 + h)),
                     set("balls.ball.velocity", Vec3(v, 0, 0))};
    run.measure = [=](const Scene&, const Motion& motion) {
        const std::vector<double> times = bounce_times(motion, 0, kUp);
        const std::vector<double> tops = top_heights(motion, 0, kUp);
        double at = first;
        Measures m;
        for (int n = 1; n <= 3; ++n) {
            const auto i = static_cast<std::size_t>(n - 1);
            m.push_back(
                relative(fmt::format("e = {}: impact {}, s", e, n), at_or_nan(times, i), at));
            m.push_back(relative(fmt::format("peak {}, m", n), at_or_nan(tops, i) - 0.1,
                                 std::pow(e, 2 * n) * h));
            at += 2 * std::pow(e, n) * first;
        }
        const BallState s = motion.balls[0].at(motion.duration);
        m.push_back(relative("way, m", s.position.x(), v * motion.duration));
        return m;
    };
    return run;
}

/// Falls on a seam and comes to rest on it.
Run rests() {
    const double h = 0.2, e = 0.5;
    Run run;
    run.overrides = {set("materials.rubber.restitution", e), set("materials.rubber.friction", 0.5),
                     set("balls.ball.position", Vec3(1, 0, 0.1 + h)),
                     set("balls.ball.velocity", Vec3(0, 0, 0))};
    run.measure = [=](const Scene&, const Motion& motion) {
        const double end = std::sqrt(2 * h / kG) * (1 + e) / (1 - e);
        const BallState s = motion.balls[0].at(motion.duration);
        Measures m{vector_measure("rests on the seam, off by m", s.position, Vec3(1, 0, 0.1), 0.1),
                   scaled("speed in the end, m/s", s.velocity.norm(), 0, 1)};
        for (const Event& event : motion.events)
            if (event.kind == EventKind::kRest)
                m.push_back(relative("event 'rest', s", event.time, end));
        return m;
    };
    return run;
}

/// Over four tiles, from the middle of one, at `degrees` to x.
Run over_tiles(double degrees) {
    const double a = degrees * M_PI / 180;
    const Vec3 v = 2 * Vec3(std::cos(a), std::sin(a), 0);
    Run run;
    run.overrides = {set("balls.ball.velocity", v)};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const BallState s = motion.balls[0].at(motion.duration);
        return Measures{
            vector_measure(fmt::format("{:g}°: place in the end, off by m", degrees), s.position,
                           scene.balls[0].position + motion.duration * v, 1),
            vector_measure("velocity in the end, off by m/s", s.velocity, v, 2),
            scaled("off the floor, m", off_the_floor(scene, motion), 0, 0.1)};
    };
    return run;
}

// ---- The joint
// ----------------------------------------------------------------------------------------

/// The plates' edge is the origin; slopes in rad. k = 0 without friction.
struct Joint {
    double first = 0, second = 0;  ///< slopes
    double start = 0.5;            ///< m before the edge
    double v0 = 0.5;               ///< m/s there
    double k = 0;                  ///< of I = k m R^2 where the ball rolls
    double R = 0.08;
};

Vec3 along(double slope) { return {std::cos(slope), 0, -std::sin(slope)}; }
Vec3 normal(double slope) { return {std::sin(slope), 0, std::cos(slope)}; }

/// Where the ball is on the second plate, and how it comes there.
struct Course {
    double way = 0, speed = 0;  ///< m along the plate from the edge, m/s
    double leaves_at = 0;  ///< angle of the normal to the vertical where it leaves the edge ...
    bool flies = false;    ///< ... if it does
};

/// The time to turn from angle a to b about the edge, by Simpson's rule; v is smooth and above 0.
double turning_time(const Joint& j, double v_squared, double a, double b) {
    constexpr int kParts = 2000;
    double sum = 0;
    for (int i = 0; i <= kParts; ++i) {
        const double angle = a + (b - a) * i / kParts;
        const double v2 = v_squared + 2 * kG * j.R / (1 + j.k) * (std::cos(a) - std::cos(angle));
        sum += (i == 0 || i == kParts ? 1 : i % 2 == 1 ? 4 : 2) * j.R / std::sqrt(v2);
    }
    return sum * (b - a) / kParts / 3;
}

/// Slides or rolls down the first plate, turns about the edge from where the second one's normal
/// force would be met, flies where that force would pull, lands with e = 0 and goes on.
Course course(const Joint& j, double duration) {
    Course c;
    const double g1 = kG * std::sin(j.first) / (1 + j.k);
    const double v2 = j.v0 * j.v0 + 2 * g1 * j.start, v = std::sqrt(v2);
    double t = 2 * j.start / (j.v0 + v), speed = v;
    // m g cos = m v^2 / R with v^2 as it grows.
    const double cosine = ((1 + j.k) * v2 / (kG * j.R) + 2 * std::cos(j.first)) / (3 + j.k);
    c.leaves_at = cosine >= std::cos(j.first) ? j.first : std::acos(cosine);
    c.flies = c.leaves_at < j.second;
    const double turned = std::min(c.leaves_at, j.second);
    if (turned > j.first) {
        t += turning_time(j, v2, j.first, turned);
        speed = std::sqrt(v2 + 2 * kG * j.R / (1 + j.k) * (std::cos(j.first) - std::cos(turned)));
    }
    if (c.flies) {
        // Distance to the second plate: the later root is the landing.
        const double s = speed * std::sin(j.second - turned), g = kG * std::cos(j.second);
        const double lift = 2 * j.R * std::pow(std::sin(0.5 * (j.second - turned)), 2);
        const double flight = (s + std::sqrt(s * s - 2 * g * lift)) / g;
        c.way = j.R * std::sin(turned - j.second) + speed * std::cos(j.second - turned) * flight +
                0.5 * kG * std::sin(j.second) * flight * flight;
        const double spin = j.k > 0 ? speed : 0;  // R w, as it rolled
        const double slip_free =
            speed * std::cos(j.second - turned) + kG * std::sin(j.second) * flight;
        speed = (slip_free + j.k * spin) / (1 + j.k);
        t += flight;
    }
    const double rest = duration - t, g2 = kG * std::sin(j.second) / (1 + j.k);
    c.way += speed * rest + 0.5 * g2 * rest * rest;
    c.speed = speed + g2 * rest;
    return c;
}

Run joint(double first, double second, double v0, double k, double duration) {
    const Joint j{first * M_PI / 180, second * M_PI / 180, 0.3, v0, k};
    const Vec3 velocity = v0 * along(j.first);
    Run run;
    run.overrides = {
        set("simulation.duration", duration),
        set("surfaces.p.box.position", -0.5 * along(j.first) - 0.05 * normal(j.first)),
        set("surfaces.p.box.rotation_deg", Vec3(0, first, 0)),
        set("surfaces.q.box.position", 0.5 * along(j.second) - 0.05 * normal(j.second)),
        set("surfaces.q.box.rotation_deg", Vec3(0, second, 0)),
        set("balls.ball.position", -j.start * along(j.first) + j.R * normal(j.first)),
        set("balls.ball.velocity", velocity)};
    if (k > 0) {
        run.overrides.push_back(set("materials.rubber.friction", 5));
        run.overrides.push_back(set("balls.ball.spin", Vec3(0, v0 / j.R, 0)));
    }
    run.measure = [=](const Scene&, const Motion& motion) {
        const Course c = course(j, duration);
        const BallState s = motion.balls[0].at(duration);
        return Measures{relative(fmt::format("{:g}°, {:g}°, {:g} m/s{}: way on the second plate, m",
                                             first, second, v0, k > 0 ? ", rolling" : ""),
                                 s.position.dot(along(j.second)), c.way),
                        relative("speed there, m/s", s.velocity.dot(along(j.second)), c.speed),
                        scaled("off the plate, m", s.position.dot(normal(j.second)), j.R, j.R)};
    };
    return run;
}

}  // namespace

std::vector<Case> seam_cases() {
    constexpr double kSolid = 2.0 / 5;
    return {{"H32",
             "flush boxes",
             "h32_seams",
             "as one floor (H1, H14)",
             {straight_on("slides", 0, 0, 5, false), straight_on("slides, e = 1", 1, 0, 3.7, false),
              straight_on("rolls", 0.5, 0.5, 5, true), straight_on("slowly", 0, 0, 0.9, false),
              slides_and_rolls(), bounces(1), bounces(0.8), rests()}},
            {"H32",
             "capsules in line",
             "h32_capsules",
             "as one rod",
             {straight_on("slides", 0, 0, 2, false), straight_on("slides, e = 1", 1, 0, 2, false)}},
            {"H32",
             "over four tiles",
             "h32_tiles",
             "straight on",
             {over_tiles(45), over_tiles(44.9), over_tiles(10), over_tiles(0)}},
            {"H33",
             "convex joint of two plates",
             "h33_joint",
             "leaves at once if v² ≥ g R cos α, else cos θ = ((1+k)v²/gR + 2 cos α)/(3+k), or lies "
             "down",
             {joint(12, 14, 0.3, 0, 0.5), joint(15, 20, 0.8, 0, 0.4), joint(0, 25, 0.4, 0, 1),
              joint(0, 60, 0.3, 0, 1.25), joint(-5, 5, 1, 0, 0.75), joint(-5, 5, 1.2, 0, 0.6),
              joint(10, 12, 2, 0, 0.3), joint(12, 14, 1, kSolid, 0.35),
              joint(0, 20, 0.3, kSolid, 1.3), joint(5, 15, 0.2, kSolid, 0.9)}}};
}

}  // namespace carom::bench
