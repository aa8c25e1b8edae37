// Single impacts: H5, H6, H9, H10, H23, H25.
#include <fmt/core.h>

#include <cmath>

#include "case.h"
#include "trajectory_measures.h"

namespace carom::bench {

namespace {

Vec3 end_velocity(const Motion& motion, std::size_t ball) {
    return motion.balls[ball].at(motion.duration).velocity;
}

Run head_on(double m1, double m2, double v1, double v2, double e) {
    Run run;
    run.overrides = {set("balls.a.mass", m1), set("balls.b.mass", m2),
                     set("balls.a.velocity", Vec3(v1, 0, 0)),
                     set("balls.b.velocity", Vec3(v2, 0, 0)), set("pairs[0].restitution", e)};
    run.measure = [=](const Scene& scene, const Motion& motion) {
        const double impulse = (1 + e) * (v1 - v2) * m1 * m2 / (m1 + m2);
        const double before = kinetic_energy(scene, motion, 0);
        const double lost = 0.5 * (1 - e * e) * (v1 - v2) * (v1 - v2) * m1 * m2 / (m1 + m2);
        return Measures{
            scaled("speed of a, m/s", end_velocity(motion, 0).x(), v1 - impulse / m1, v1 - v2),
            scaled("speed of b, m/s", end_velocity(motion, 1).x(), v2 + impulse / m2, v1 - v2),
            scaled("energy lost, J", before - kinetic_energy(scene, motion, motion.duration), lost,
                   before),
            scaled("momentum, kg m/s", momentum(scene, motion, motion.duration).x(),
                   m1 * v1 + m2 * v2, m1 * std::abs(v1) + m2 * std::abs(v2))};
    };
    return run;
}

Run oblique(double e) {
    Run run;
    run.overrides = {set("pairs[0].restitution", e)};
    run.measure = [=](const Scene&, const Motion& motion) {
        const double a = M_PI / 6;
        const Vec3 target = 0.5 * (1 + e) * std::cos(a) * Vec3(std::cos(a), std::sin(a), 0);
        return Measures{vector_measure("velocity of the target, off by m/s",
                                       end_velocity(motion, 1), target, 1),
                        vector_measure("velocity of the cue, off by m/s", end_velocity(motion, 0),
                                       Vec3::UnitX() - target, 1)};
    };
    return run;
}

Run cue_on_two(double e) {
    Run run;
    run.overrides = {set("pairs[0].restitution", e)};
    run.measure = [=](const Scene&, const Motion& motion) {
        const double speed = (1 + e) * (std::sqrt(3) / 2) / 2.5;
        const Vec3 upper = end_velocity(motion, 1), lower = end_velocity(motion, 2);
        const Vec3 expected = speed * Vec3(std::sqrt(3) / 2, 0.5, 0);
        const Vec3 mirrored(lower.x(), -lower.y(), lower.z());
        return Measures{vector_measure("velocity of a target, off by m/s", upper, expected, 1),
                        scaled("speed of the cue, m/s", end_velocity(motion, 0).x(),
                               1 - std::sqrt(3) * speed, 1),
                        vector_measure("mirror error, m/s", upper, mirrored, 1, 1e-12)};
    };
    return run;
}

/// Row i of the rack holds balls 1 + i (i + 1) / 2 ...; ball j of a row mirrors ball i - j.
Run rack() {
    Run run;
    run.measure = [](const Scene& scene, const Motion& motion) {
        double worst = 0;
        const double t = motion.duration;
        for (std::size_t i = 0; i < 5; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                const std::size_t first = 1 + i * (i + 1) / 2;
                const Vec3 a = motion.balls[first + j].at(t).position;
                const Vec3 b = motion.balls[first + i - j].at(t).position;
                worst = std::max(worst, (a - Vec3(b.x(), -b.y(), b.z())).norm());
            }
        return Measures{scaled("rack: mirror error, m", worst, 0, 1, 1e-12),
                        scaled("rack: momentum, kg m/s", momentum(scene, motion, t).x(), 3, 3)};
    };
    return run;
}

Run thin_plate() {
    Run run;
    run.prepare = [](Scene& scene) {
        for (std::size_t i = 0; i < scene.balls.size(); ++i)
            scene.balls[i].position.z() += 1e-3 * static_cast<double>(i);
    };
    run.measure = [](const Scene& scene, const Motion& motion) {
        const double v = 1000, e = 0.9, half = 0.0005;
        double passed = 0, worst_speed = NAN, worst_time = NAN;
        for (std::size_t i = 0; i < scene.balls.size(); ++i) {
            const Ball& b = scene.balls[i];
            if (motion.balls[i].at(motion.duration).position.z() < 0) {
                ++passed;
                continue;
            }
            const double exit = end_velocity(motion, i).z();
            worst_speed = std::fmax(worst_speed, std::abs(exit - e * v));
            const double at = (b.position.z() - b.radius - half) / v;
            const double hit = at_or_nan(bounce_times(motion, i, Vec3::UnitZ()), 0);
            worst_time = std::fmax(worst_time, std::abs(hit - at));
        }
        Measure passing = scaled("passed through", passed, 0, 1000, 0);
        passing.how = fmt::format("{:.0f} of 1000 pass through", passed);
        return Measures{passing, scaled("exit speed, off by m/s", worst_speed, 0, e * v),
                        scaled("impact time, off by s", worst_time, 0, 1)};
    };
    return run;
}

Run overlapping() {
    Run run;
    run.overrides = {set("balls.b.position", Vec3(0.19, 0, 0))};
    run.refused = true;
    run.prepare = [](Scene& scene) { scene.balls[1].position.x() = 0.19; };
    run.measure = [](const Scene& scene, const Motion& motion) {
        const double speed = (end_velocity(motion, 1) - end_velocity(motion, 0)).norm();
        Measure apart = scaled("speed from nothing, m/s", speed, 0, 1);
        apart.how = fmt::format("popped apart at {:.2g} m/s", speed);
        const double depth = deepest_overlap(scene, motion, motion.duration);
        Measure left = scaled("overlap in the end, m", depth, 0, 0.1);
        left.how = fmt::format("left overlapping by {:.2g} m", depth);
        return Measures{apart, left};
    };
    return run;
}

Run grazing(double offset) {
    Run run;
    const double path = 0.25 + offset, sum = 0.25;
    run.overrides = {set("balls.passing.position", Vec3(-4, path, 0))};
    run.measure = [=](const Scene&, const Motion& motion) {
        // At the impact the line of centres has the sine path / sum to the path.
        const double cosine = offset < 0 ? std::sqrt((sum - path) * (sum + path)) / sum : 0;
        const Vec3 expected = cosine * Vec3(cosine, -path / sum, 0);
        return Measures{vector_measure(fmt::format("target at offset {:g} m, off by m/s", offset),
                                       end_velocity(motion, 1), expected, 1)};
    };
    return run;
}

}  // namespace

std::vector<Case> impact_cases() {
    return {{"H5",
             "head-on, masses 1 : 3 and others",
             "h05_head_on",
             "v' = v ∓ (1+e)(v₁−v₂) m/(m₁+m₂)",
             {head_on(1, 3, 2, -1, 0.5), head_on(1, 1000, 1, 0, 0.3), head_on(1000, 1, 1, 0, 1),
              head_on(1, 1, 1, -1, 0)}},
            {"H6",
             "oblique at 30°",
             "h06_oblique",
             "(1+e)/2 cos 30° along the line of centres",
             {oblique(1), oblique(0.9), oblique(0.2)}},
            {"H9",
             "cue on two touching balls",
             "h09_cue",
             "targets (1+e)(√3/2)/2.5 at ±30°",
             {cue_on_two(1), cue_on_two(0.9), cue_on_two(0.5)}},
            {"H9", "break of a rack of 15", "h09_rack", "mirror-symmetric to 1e-12", {rack()}},
            {"H10",
             "1000 m/s at a plate of 1 mm",
             "h10_plate",
             "none passes, exit e v",
             {thin_plate()}},
            {"H23",
             "overlap at the start",
             "h23_overlap",
             "refused, never popped apart",
             {overlapping()}},
            {"H25",
             "grazing by ±1e-9 m and 0",
             "h25_grazing",
             "hits or misses as the sign says",
             {grazing(-1e-9), grazing(0), grazing(1e-9)}}};
}

}  // namespace carom::bench
