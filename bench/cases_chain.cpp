// Impacts in chains: H7, H8, H19, H20.
#include <fmt/core.h>

#include <cmath>

#include "case.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

constexpr double kG = 9.81;

double speed_x(const Motion& motion, std::size_t ball, double t) {
    return motion.balls[ball].at(t).velocity.x();
}

/// Five balls, `in` of them arriving at 1 m/s, with gaps between all.
Run cradle(double e, double gap, std::size_t in,
           std::function<Measures(const Scene&, const Motion&)> measure) {
    Run run;
    run.overrides = {set("pairs[0].restitution", e)};
    run.prepare = [=](Scene& scene) {
        for (std::size_t i = 0; i < 5; ++i) {
            scene.balls[i].position.x() = static_cast<double>(i) * (0.2 + gap);
            scene.balls[i].velocity.x() = i < in ? 1 : 0;
        }
    };
    run.measure = std::move(measure);
    return run;
}

Run lossless_cradle(double gap, std::size_t in) {
    return cradle(1, gap, in, [=](const Scene&, const Motion& motion) {
        Measures m;
        for (std::size_t i = 0; i < 5; ++i) {
            const double speed = speed_x(motion, i, motion.duration);
            m.push_back(scaled(fmt::format("{} in, gap {:g} m: speed of ball {}", in, gap, i),
                               speed, i + in >= 5 ? 1 : 0, 1));
            m.back().how = fmt::format("spreads the impulse: {} in, ball {} leaves at {:.2g} m/s",
                                       in, i, speed);
        }
        return m;
    });
}

/// With gaps of 1 mm the first wave is over after 5 ms, and the next impact is at 0.4 s.
Run lossy_wave(double e) {
    return cradle(e, 1e-3, 1, [=](const Scene&, const Motion& motion) {
        Measures m;
        for (std::size_t i = 0; i < 5; ++i) {
            const double passed_on = std::pow((1 + e) / 2, static_cast<double>(i));
            m.push_back(scaled(fmt::format("first wave: speed of ball {}", i),
                               speed_x(motion, i, 0.02),
                               i < 4 ? (1 - e) / 2 * passed_on : passed_on, 1));
        }
        return m;
    });
}

Run touching_lossy(double e) {
    return cradle(e, 0, 1, [=](const Scene& scene, const Motion& motion) {
        const double t = motion.duration;
        Measures m{scaled("momentum, kg m/s", momentum(scene, motion, t).x(), 1, 1, 1e-12)};
        if (e >= 0.5)
            m.push_back(scaled("speed of the last ball", speed_x(motion, 4, t),
                               std::pow((1 + e) / 2, 4), 1));
        for (std::size_t i = 0; i < 5 && e == 0; ++i)
            m.push_back(
                scaled(fmt::format("e = 0: speed of ball {}", i), speed_x(motion, i, t), 0.2, 1));
        return m;
    });
}

Case cradles() {
    Case c{"H7",
           "Newton's cradle, gaps 0 and more",
           "h07_cradle",
           "e = 1: n in, n out; last ball ((1+e)/2)⁴",
           {}};
    for (const double gap : {0.0, 1e-6})
        for (const std::size_t in : {1u, 2u, 3u}) c.runs.push_back(lossless_cradle(gap, in));
    c.runs.push_back(lossy_wave(0.9));
    for (const double e : {0.9, 0.5, 0.3, 0.0}) c.runs.push_back(touching_lossy(e));
    return c;
}

Run cannon(double ratio) {
    Run run;
    run.overrides = {set("balls.bottom.mass", ratio)};
    run.measure = [=](const Scene&, const Motion& motion) {
        const double at = std::sqrt(2 / kG), v = std::sqrt(2 * kG), t = at + 0.005;
        const double top = motion.balls[1].at(t).velocity.z() + kG * (t - at);
        return Measures{relative(fmt::format("{:g} : 1, top ball, m/s", ratio), top,
                                 (3 * ratio - 1) / (ratio + 1) * v)};
    };
    return run;
}

/// What stops does so on the floor, and on what stands there: 5 ms later it is still at rest.
Run cannon_of_three() {
    Run run;
    run.measure = [](const Scene&, const Motion& motion) {
        const double at = std::sqrt(2 / kG), v = std::sqrt(2 * kG), t = at + 0.005;
        const auto speed = [&](std::size_t i) { return motion.balls[i].at(t).velocity.z(); };
        return Measures{scaled("bottom ball, m/s", speed(0), 0, v),
                        scaled("middle ball, m/s", speed(1), 0, v),
                        relative("top ball, m/s", speed(2) + kG * (t - at), 3 * v)};
    };
    return run;
}

Run digits_of_pi(int k, int impacts) {
    Run run;
    run.overrides = {set("balls.heavy.mass", std::pow(100, k))};
    run.measure = [=](const Scene&, const Motion& motion) {
        const int found = velocity_jumps(motion, 0, 1e-9);
        Measure count =
            relative(fmt::format("impacts at 100^{}", k), found, impacts, 0.1 / impacts);
        count.how = fmt::format("{} impacts instead of {}", found, impacts);
        return Measures{count};
    };
    run.quick = k < 4;
    return run;
}

Run collapse_in_a_line(double e) {
    Run run;
    run.overrides = {set("pairs[0].restitution", e)};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const double t = motion.duration;
        const double a = speed_x(motion, 0, t), b = speed_x(motion, 1, t),
                     c = speed_x(motion, 2, t);
        Measure apart = scaled(fmt::format("e = {}: relative speed, m/s", e),
                               std::max(std::abs(a - b), std::abs(b - c)), 0, 1);
        apart.how =
            fmt::format("does not collapse: {:.2g} m/s between balls after 10 s", apart.value);
        return Measures{scaled("momentum, kg m/s", momentum(scene, motion, t).x(), 0, 2, 1e-12),
                        apart};
    };
    return run;
}

Run collapse_on_a_wall(double e) {
    Run run;
    run.overrides = {set("materials.clay.restitution", e), set("pairs[0].restitution", e)};
    run.measure = [=](const Scene&, const Motion& motion) {
        Measures m;
        for (std::size_t i = 0; i < 2; ++i) {
            const double speed = speed_x(motion, i, motion.duration);
            m.push_back(scaled(fmt::format("e = {}: speed of ball {}, m/s", e, i), speed, 0, 1.5));
            m.back().how = fmt::format("does not collapse: {:.2g} m/s after 10 s", speed);
        }
        return m;
    };
    return run;
}

}  // namespace

std::vector<Case> chain_cases() {
    return {cradles(),
            {"H8",
             "Galilean cannon 3, 10, 1000 : 1",
             "h08_cannon",
             "top (3M−m)/(M+m) v",
             {cannon(3), cannon(10), cannon(1000)}},
            {"H8", "Galilean cannon 6 : 2 : 1", "h08_three", "0, 0, 3 v", {cannon_of_three()}},
            {"H19",
             "impacts between a wall and 100^k masses",
             "h19_pi",
             "3, 31, 314, 3141, 31415 impacts",
             {digits_of_pi(0, 3), digits_of_pi(1, 31), digits_of_pi(2, 314), digits_of_pi(3, 3141),
              digits_of_pi(4, 31415)}},
            {"H20",
             "collapse of three balls",
             "h20_line",
             "ends, momentum 0, relative speed 0",
             {collapse_in_a_line(0.0718), collapse_in_a_line(0.05), collapse_in_a_line(0)}},
            {"H20",
             "collapse of two balls on a wall",
             "h20_wall",
             "ends at rest",
             {collapse_on_a_wall(0.17), collapse_on_a_wall(0.1), collapse_on_a_wall(0)}}};
}

}  // namespace carom::bench
