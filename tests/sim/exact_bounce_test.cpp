// One ball and what it bounces on, against closed forms: heights, times, ends.
#include <gtest/gtest.h>

#include <cmath>

#include "exact_scenes.h"

namespace carom::testing {
namespace {

Scene drop(double height, double restitution, double gravity = kGravity, double radius = 0.1) {
    Scene scene = exact_scene(restitution, 0, gravity);
    add_plane(scene);
    add_ball(scene, Vec3(0, 0, height + radius), Vec3::Zero(), radius);
    return scene;
}

/// All bounces of a drop are over by then.
double zeno_time(double height, double e, double g) {
    return std::sqrt(2 * height / g) * (1 + e) / (1 - e);
}

/// The worst relative error of peaks and impact times against h_n = e^(2n) h0, over the first 40
/// bounces and all of at least 1e-9 h0.
struct PeakErrors {
    double height = 0;
    double time = 0;
    std::size_t compared = 0;
};

PeakErrors peak_errors(const Scene& scene, const SimulationResult& result, double h0, double e) {
    const double g = scene.simulation.gravity.norm();
    const std::vector<Peak>& peaks = result.motion.peaks[0];
    PeakErrors worst;
    const double first = std::sqrt(2 * h0 / g);
    double time = first, power = 1;
    for (std::size_t n = 0; n < peaks.size(); ++n) {
        power *= e;
        const double height = power * power * h0;
        if (n >= 40 && height < 1e-9 * h0) break;
        const double at = time + power * first;
        worst.height = std::max(worst.height, relative_error(peaks[n].height, height));
        worst.time = std::max(worst.time, relative_error(peaks[n].time, at));
        time += 2 * power * first;
        ++worst.compared;
    }
    return worst;
}

TEST(ExactBounce, PeaksToTheLastDigits) {
    for (const double e : {0.3, 0.5, 0.64, 0.8, 0.845354, 0.9, 0.95, 0.99, 1.0})
        for (const double h0 : {0.01, 2.0, 37.0})
            for (const double radius : {0.02, 0.1}) {
                Scene scene = drop(h0, e, kGravity, radius);
                const double end =
                    e < 1 ? zeno_time(h0, e, kGravity) + 1 : 101 * std::sqrt(2 * h0 / kGravity);
                const SimulationResult result = run(scene, end);
                const PeakErrors worst = peak_errors(scene, result, h0, e);
                // All hops down to the tail's are there: 1e-12 of the radius or of the height.
                const double lowest = std::max(1e-9, 1.01e-12 * (h0 + radius) / h0);
                const double expected =
                    e < 1 ? std::min(std::floor(std::log(lowest) / (2 * std::log(e))), 1000.0)
                          : 49.0;
                EXPECT_GE(static_cast<double>(worst.compared), expected) << "e " << e;
                EXPECT_LE(worst.height, 1e-12) << "e " << e << ", h0 " << h0 << ", r " << radius;
                EXPECT_LE(worst.time, 1e-12) << "e " << e << ", h0 " << h0 << ", r " << radius;
            }
}

TEST(ExactBounce, HardCase1) {
    Scene scene = drop(2, 0.8);
    const SimulationResult result = run(scene, 5);
    const std::vector<Event> impacts = impacts_of(result.motion);
    ASSERT_GE(impacts.size(), 5u);
    const double times[] = {0.638550857, 1.660232228, 2.477577324, 3.131453402, 3.654554264};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(impacts[i].time, times[i], 5e-10);
    const double heights[] = {1.28, 0.8192, 0.524288};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LE(relative_error(result.motion.peaks[0][i].height, heights[i]), 1e-12);
}

TEST(ExactBounce, ZenoSeriesRestsOnTime) {
    for (const double e : {0.0, 0.1, 0.5, 0.8, 0.9, 0.99}) {
        const double end = zeno_time(2, e, kGravity);
        Scene scene = drop(2, e);
        const SimulationResult result = run(scene, end + 5);
        const std::vector<Event> rests = events_of(result.motion, EventKind::kRest);
        ASSERT_EQ(rests.size(), 1u) << "e " << e;
        std::printf("e %g: rests %.3g s off, after %zu impacts\n", e, rests[0].time - end,
                    impacts_of(result.motion).size());
        EXPECT_LE(relative_error(rests[0].time, end), 1e-9) << "e " << e;
        const BallState last = result.motion.balls[0].at(end + 5);
        EXPECT_EQ(last.velocity, Vec3::Zero());
        EXPECT_NEAR(last.position.z(), 0.1, 1e-10);
        EXPECT_EQ(result.motion.events.back().kind, EventKind::kRest);
    }
}

TEST(ExactBounce, PathOfTheZenoSeries) {
    const double e = 0.8, h0 = 2;
    Scene scene = drop(h0, e);
    const SimulationResult result = run(scene, 8);
    double path = h0;
    for (const Peak& p : result.motion.peaks[0]) path += 2 * p.height;
    EXPECT_LE(relative_error(path, h0 * (1 + e * e) / (1 - e * e)), 1e-9);
}

TEST(ExactBounce, UntilRestEndsWhenItRests) {
    Scene scene = drop(2, 0.5);
    scene.simulation.duration.reset();
    const SimulationResult result = simulate(scene);
    EXPECT_LE(relative_error(result.motion.duration, zeno_time(2, 0.5, kGravity)), 1e-9);
}

TEST(ExactBounce, LosslessKeepsItsPeriod) {
    Scene scene = drop(1, 1);
    const SimulationResult result = run(scene, 903);
    const std::vector<Event> impacts = impacts_of(result.motion);
    ASSERT_EQ(impacts.size(), 1000u);
    EXPECT_LE(relative_error(impacts.back().time, 902.5957583305), 1e-12);
    double worst = 0;
    for (const Peak& p : result.motion.peaks[0]) worst = std::max(worst, std::abs(p.height - 1));
    std::printf("peak drift after 1000 bounces %.3g\n", worst);
    EXPECT_LE(worst, 1e-12);
}

TEST(ExactBounce, DownAnIncline) {
    for (const double degrees : {10.0, 30.0, 55.0})
        for (const double azimuth : {0.0, 90.0, 211.0}) {
            const double e = 0.8, alpha = degrees * M_PI / 180;
            const Vec3 n = incline(degrees, azimuth);
            Scene scene = exact_scene(e, 0, kGravity);
            add_plane(scene, n);
            // The contact point is a drop of 1 m below: the ball's gap is measured along gravity.
            add_ball(scene, 0.1 * n + Vec3(0, 0, 1));
            const SimulationResult result = run(scene, 5);
            const std::vector<Event> impacts = impacts_of(result.motion);
            ASSERT_GE(impacts.size(), 6u);
            const double v = std::sqrt(2 * kGravity);
            double worst = 0, along = v * std::sin(alpha), e_n = 1;
            for (std::size_t k = 0; k < 5; ++k) {
                e_n *= e;
                const double flight = 2 * e_n * v / kGravity;
                const double hop =
                    along * flight + 0.5 * kGravity * std::sin(alpha) * flight * flight;
                along += kGravity * std::sin(alpha) * flight;
                worst =
                    std::max(worst, relative_error(impacts[k + 1].time - impacts[k].time, flight));
                worst = std::max(
                    worst, relative_error((impacts[k + 1].point - impacts[k].point).norm(), hop));
            }
            EXPECT_LE(worst, 1e-12) << degrees << " degrees, azimuth " << azimuth;
        }
}

TEST(ExactBounce, HopsOfHardCase4) {
    const Vec3 n = incline(30);
    Scene scene = exact_scene(0.8, 0, kGravity);
    add_plane(scene, n);
    add_ball(scene, 0.1 * n + Vec3(0, 0, 1));
    const std::vector<Event> impacts = impacts_of(run(scene, 5).motion);
    ASSERT_GE(impacts.size(), 6u);
    const double hops[] = {2.88, 4.1472, 4.497408, 4.352901120, 3.965504717};
    for (std::size_t k = 0; k < 5; ++k)
        EXPECT_NEAR((impacts[k + 1].point - impacts[k].point).norm(), hops[k], 1e-9);
}

TEST(ExactBounce, NoPlateIsTooThin) {
    const double v = 1000, e = 0.9, r = 0.1, thickness = 0.001;
    double worst_speed = 0, worst_time = 0;
    for (int phase = 0; phase < 1000; ++phase) {
        const double z0 = 3 + 1.0 * phase / 1000;
        Scene scene = exact_scene(e, 0, 0);
        Surface plate;
        plate.name = "plate";
        plate.shape = BoxShape{Vec3::Zero(), Vec3(1, 1, thickness), Quat::Identity()};
        plate.material = 2;
        scene.surfaces.push_back(plate);
        add_ball(scene, Vec3(0.123, -0.2, z0), Vec3(0, 0, -v), r);
        const SimulationResult result = run(scene, 0.05);
        const std::vector<Event> impacts = impacts_of(result.motion);
        ASSERT_EQ(impacts.size(), 1u) << "phase " << phase;
        worst_time = std::max(worst_time, std::abs(impacts[0].time - (z0 - r - thickness / 2) / v));
        worst_speed = std::max(worst_speed,
                               relative_error(result.motion.balls[0].at(0.05).velocity.z(), e * v));
    }
    std::printf("1000 phases: times within %.3g s, exit speeds within %.3g\n", worst_time,
                worst_speed);
    EXPECT_LE(worst_time, 1e-12);
    EXPECT_LE(worst_speed, 1e-12);
}

TEST(ExactBounce, FreeFall) {
    Scene scene = exact_scene(1, 0, kGravity);
    add_ball(scene, Vec3(0, 0, 10), Vec3(1, 2, 3));
    const SimulationResult result = run(scene, 1);
    const Vec3 expected(1, 2, 10 + 3 - kGravity / 2);
    EXPECT_LE((result.motion.balls[0].at(1).position - expected).norm(), 1e-12);
}

TEST(ExactBounce, FromVeryHighAndVeryLow) {
    for (const auto& [height, radius] :
         {std::pair{1e4, 1e-3}, {1e-6, 0.1}, {1e-6, 1e-3}, {100.0, 1.0}})
        for (const double e : {0.5, 0.8}) {
            Scene scene = drop(height, e, kGravity, radius);
            const SimulationResult result = run(scene, zeno_time(height, e, kGravity));
            const std::vector<Peak>& peaks = result.motion.peaks[0];
            ASSERT_GE(peaks.size(), 5u);
            double worst = 0;
            // A drop of 1e-6 m from a height that is rounded to 1e-17 m.
            for (std::size_t n = 0; n < 5; ++n)
                worst = std::max(worst, relative_error(peaks[n].height,
                                                       std::pow(e, 2 * (double(n) + 1)) * height));
            std::printf("drop of %g m, r %g: %.3g\n", height, radius, worst);
            EXPECT_LE(worst, 1e-9);
        }
}

TEST(ExactBounce, RestStaysAtRest) {
    for (const double e : {0.0, 0.5, 1.0}) {
        Scene scene = drop(0, e);
        const SimulationResult result = run(scene, 3600);
        EXPECT_TRUE(result.motion.events.empty());
        EXPECT_EQ(result.motion.balls[0].pieces().size(), 1u);
        for (const double t : {0.0, 1.0, 60.0, 3600.0}) {
            EXPECT_NEAR(result.motion.balls[0].at(t).position.z(), 0.1, 1e-10);
            EXPECT_EQ(result.motion.balls[0].at(t).velocity, Vec3::Zero());
        }
    }
}

TEST(ExactBounce, FilmRateChangesNothing) {
    Scene scene = drop(2, 0.8);
    const std::uint64_t hash = run(scene, 4).motion.hash();
    scene.film.fps = {25, 1};
    EXPECT_EQ(run(scene, 4).motion.hash(), hash);
    EXPECT_EQ(run(scene, 4).motion.hash(), hash);
}

}  // namespace
}  // namespace carom::testing
