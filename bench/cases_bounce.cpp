// Balls that bounce, fall or lie still: H1 - H4, H21, H24, H26, H27.
#include <fmt/core.h>

#include <cmath>

#include "case.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

constexpr double kG = 9.81;  // m/s^2, as in the scenes
constexpr double kRadius = 0.1;
const Vec3 kUp = Vec3::UnitZ();

/// Impact n = 1, 2, ... of a drop from h.
double impact_time(double h, double e, int n) {
    double flights = 1;
    for (int k = 1; k < n; ++k) flights += 2 * std::pow(e, k);
    return std::sqrt(2 * h / kG) * flights;
}

Measures peaks_and_times(const Motion& motion, double h, double e, double radius) {
    const std::vector<double> times = bounce_times(motion, 0, kUp);
    const std::vector<double> tops = top_heights(motion, 0, kUp);
    Measures m;
    for (int n = 1; n <= 6; ++n) {
        const auto i = static_cast<std::size_t>(n - 1);
        m.push_back(relative(fmt::format("drop of {:g} m: peak {}, m", h, n),
                             at_or_nan(tops, i) - radius, std::pow(e, 2 * n) * h));
        m.push_back(relative(fmt::format("drop of {:g} m: impact {}, s", h, n), at_or_nan(times, i),
                             impact_time(h, e, n)));
    }
    return m;
}

Run drop(double h, double e, double radius) {
    Run run;
    run.overrides = {set("materials.rubber.restitution", e), set("balls.ball.radius", radius),
                     set("balls.ball.position", Vec3(0, 0, h + radius)),
                     set("simulation.duration", 1.001 * impact_time(h, e, 7))};
    run.measure = [=](const Scene&, const Motion& motion) {
        return peaks_and_times(motion, h, e, radius);
    };
    return run;
}

Case peaks() {
    return {"H1",
            "peaks of a drop",
            "h01_peaks",
            "h_n = e^2n h, t_n = √(2h/g)(1 + 2Σe^k)",
            {drop(2, 0.8, kRadius), drop(2, 0.5, kRadius), drop(1.8, 0.85, kRadius)}};
}

/// The last time at which the gap is above `gap`: on the way down of the last flight that gets
/// there.
double last_time_above_gap(double h, double e, double gap) {
    const double v = std::sqrt(2 * kG * h);
    int n = 1;
    while (std::pow(e, 2 * (n + 1)) * h > gap) ++n;
    const double vn = std::pow(e, n) * v;
    return impact_time(h, e, n) + (vn + std::sqrt(vn * vn - 2 * kG * gap)) / kG;
}

/// When the motion's own events say that it rests, if it has events.
void add_rest_event(const Motion& motion, double reference, Measures& measures) {
    for (const Event& event : motion.events)
        if (event.kind == EventKind::kRest)
            measures.push_back(relative("event 'rest', s", event.time, reference));
}

Run zeno(double e) {
    const double h = 2, gap = 1e-6 * h;
    const double end = std::sqrt(2 * h / kG) * (1 + e) / (1 - e);
    Run run;
    run.overrides = {set("materials.rubber.restitution", e), set("simulation.duration", 1.1 * end)};
    run.measure = [=](const Scene&, const Motion& motion) {
        const BallState last = motion.balls[0].at(motion.duration);
        Measures m{relative("path, m", path_length(motion, 0, kUp), h * (1 + e * e) / (1 - e * e)),
                   relative(fmt::format("e = {}: last above 1e-6 h, s", e),
                            last_time_above(motion, 0, kUp, kRadius + gap),
                            last_time_above_gap(h, e, gap)),
                   scaled("height in the end, m", last.position.z(), kRadius, kRadius),
                   scaled("speed in the end, m/s", last.velocity.norm(), 0, 1)};
        add_rest_event(motion, end, m);
        return m;
    };
    return run;
}

Case zeno_series() {
    return {"H2",
            "bounces end in finite time",
            "h01_peaks",
            "T = √(2h/g)(1+e)/(1−e), path h(1+e²)/(1−e²), then rest",
            {zeno(0.5), zeno(0.8), zeno(0.9), zeno(0.99)}};
}

Case lossless() {
    Run run;
    run.measure = [](const Scene&, const Motion& motion) {
        const std::vector<double> tops = top_heights(motion, 0, kUp);
        double worst = tops.size() < 999 ? NAN : 0;
        for (const double top : tops) worst = std::max(worst, std::abs(top - kRadius - 1));
        Measure drift = scaled("peak drift in 1000 bounces, m", worst, 0, 1);
        drift.how = fmt::format("loses bounces: {} peaks of 999", tops.size());
        return Measures{drift,
                        relative("impact 1000, s", at_or_nan(bounce_times(motion, 0, kUp), 999),
                                 1999 * std::sqrt(2 / kG))};
    };
    run.quick = false;
    return {
        "H3", "1000 bounces without loss", "h03_lossless", "h = 1 m, t_n = (2n−1)√(2h/g)", {run}};
}

/// Along the slope and across: flights of 2 e^n v / g, on which g sin a is gained along the slope.
Measures hops(const Motion& motion) {
    const double a = M_PI / 6, e = 0.8, v = std::sqrt(2 * kG);
    const Vec3 normal(std::sin(a), 0, std::cos(a)), along(std::cos(a), 0, -std::sin(a));
    const std::vector<double> times = bounce_times(motion, 0, normal);
    Measures m;
    double speed = v * std::sin(a);
    for (std::size_t n = 1; n <= 5; ++n) {
        const double flight = 2 * std::pow(e, n) * v / kG;
        const double hop = speed * flight + 0.5 * kG * std::sin(a) * flight * flight;
        speed += kG * std::sin(a) * flight;
        const double from = at_or_nan(times, n - 1), to = at_or_nan(times, n);
        const bool there = std::isfinite(to);
        const Trajectory& ball = motion.balls[0];
        const double way = there ? (ball.at(to).position - ball.at(from).position).dot(along) : NAN;
        m.push_back(relative(fmt::format("flight {}, s", n), to - from, flight));
        m.push_back(relative(fmt::format("hop {}, m", n), way, hop));
    }
    return m;
}

Case incline() {
    Run run;
    run.measure = [](const Scene&, const Motion& motion) { return hops(motion); };
    return {"H4",
            "bounces down an incline",
            "h04_incline",
            "flights 2eⁿv/g, hops u T + ½ g sin α T²",
            {run}};
}

Run rest(double seconds) {
    Run run;
    run.overrides = {set("simulation.duration", seconds)};
    run.measure = [=](const Scene&, const Motion& motion) {
        double height = 0, speed = 0;
        for (int i = 0; i <= 1000; ++i) {
            const BallState s = motion.balls[0].at(seconds * i / 1000);
            height = std::max(height, std::abs(s.position.z() - kRadius));
            speed = std::max(speed, s.velocity.norm());
        }
        return Measures{scaled("off its height, m", height, 0, kRadius),
                        scaled("speed, m/s", speed, 0, 1)};
    };
    return run;
}

Case free_fall() {
    Run run;
    run.measure = [](const Scene& scene, const Motion& motion) {
        const Ball& b = scene.balls[0];
        Measures m;
        for (const double t : {0.25, 1.0}) {
            const Vec3 expected =
                b.position + t * b.velocity + 0.5 * t * t * scene.simulation.gravity;
            m.push_back(vector_measure(fmt::format("place at {} s, off by m", t),
                                       motion.balls[0].at(t).position, expected, 1, 1e-12));
        }
        return m;
    };
    return {"H24", "free fall", "h24_free_fall", "p + v t + ½ g t², to 1e-12 m", {run}};
}

Run unequal_radii() {
    const double v1 = 2, v2 = -1, m1 = 1, m2 = 3, e = 0.5;
    const double impulse = (1 + e) * (v1 - v2) * m1 * m2 / (m1 + m2);
    Run run;
    run.prepare = [=](Scene& scene) {
        scene.balls.resize(2);
        for (Ball& ball : scene.balls) ball.material = 0;
        PairRule rule;
        rule.restitution = e;
        scene.pairs = {rule};
        scene.surfaces.clear();
        scene.simulation.gravity.setZero();
        scene.simulation.duration = 1;
        scene.balls[0].radius = 1;
        scene.balls[1].radius = 1e-4;
        scene.balls[1].name = "small";
        scene.balls[0].mass = m1;
        scene.balls[1].mass = m2;
        scene.balls[0].position = Vec3(-1.5, 0, 0);
        scene.balls[1].position = Vec3(0.1, 0, 0);
        scene.balls[0].velocity = Vec3(v1, 0, 0);
        scene.balls[1].velocity = Vec3(v2, 0, 0);
    };
    run.measure = [=](const Scene&, const Motion& motion) {
        return Measures{scaled("speed of r = 1 m", motion.balls[0].at(1).velocity.x(),
                               v1 - impulse / m1, v1 - v2),
                        scaled("speed of r = 0.1 mm", motion.balls[1].at(1).velocity.x(),
                               v2 + impulse / m2, v1 - v2)};
    };
    return run;
}

}  // namespace

std::vector<Case> bounce_cases() {
    return {peaks(),
            zeno_series(),
            lossless(),
            incline(),
            free_fall(),
            {"H21", "at rest for 60 s", "h21_rest", "z = r, v = 0", {rest(60)}},
            {"H26",
             "10 km, 1 µm, radii 1 : 1e-4",
             "h01_peaks",
             "H1's and H5's formulas",
             {drop(1e4, 0.8, 1e-3), drop(1e-6, 0.8, kRadius), unequal_radii()}},
            {"H27", "an hour at rest", "h21_rest", "z = r, v = 0", {rest(3600)}}};
}

}  // namespace carom::bench
