// Scenes of runs, and what is measured of them, against closed forms.
#include <cmath>

#include "geometry/nearest.h"
#include "sim/simulate.h"
#include "sweep/file/measured.h"
#include "sweep/file/results.h"
#include "sweep/runs/run_maker.h"
#include "sweep/runs/run_record.h"
#include "sweep_testing.h"

namespace carom {
namespace {

constexpr double kTight = 1e-12;

std::vector<std::optional<double>> results_of(const std::vector<ResultSpec>& specs) {
    const Sweep sweep = SweepFiles("base: base.yaml\n").sweep();
    const RunScene made = make_run_scene(sweep, {}, 0);
    const SimulationResult simulated = simulate(made.scene.value());
    return ResultTable(specs).evaluate(*made.scene, simulated.motion);
}

/// Fall of 1 m at 10 m/s^2: 1/sqrt(5) s, 2 sqrt(5) m/s; each rebound keeps 0.64 of the height.
TEST(Results, OfABounceAreItsClosedForm) {
    const double fall = 1 / std::sqrt(5.0), speed = 2 * std::sqrt(5.0);
    const auto values = results_of({{"t", "impact_time(\"a\", 1)"},
                                    {"h", "peak(\"a\", 1)"},
                                    {"h2", "peak(\"a\", 2)"},
                                    {"at", "peak_time(\"a\", 1)"},
                                    {"v", "approach_speed(\"a/floor\", 1)"},
                                    {"u", "separation_speed(\"floor/a\", 1)"},
                                    {"i", "impulse(\"*\", 1)"},
                                    {"e0", "energy(\"a\", 0)"},
                                    {"e1", "energy(\"*\", 0.5)"},
                                    {"k", "kinetic_energy(\"a\", 0.2)"},
                                    {"z", "z(\"a\", 0.2)"},
                                    {"vz", "vz(\"a\", 0.2)"},
                                    {"sum", "duration + 2 * balls"}});
    const double expected[] = {fall,
                               0.64,
                               0.4096,
                               fall + 0.8 * speed / 10,
                               speed,
                               0.8 * speed,
                               2 * 1.8 * speed,
                               2 * 10 * 1.1,
                               2 * 10 * (0.1 + 0.64),
                               0.5 * 2 * 4,
                               0.9,
                               -2,
                               4};
    ASSERT_EQ(values.size(), std::size(expected));
    for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_TRUE(values[i]) << i;
        EXPECT_NEAR(*values[i], expected[i], kTight * 100) << i;
    }
}

TEST(Results, OfEachFunctionInTheDocumentsCanBeEvaluated) {
    const ResultNames kNames = {{"a"}, {"floor"}, {}};
    std::vector<ResultSpec> specs;
    for (const ResultFunction& one : result_functions()) specs.push_back({"r", one.example});
    ASSERT_GT(specs.size(), 15U);
    EXPECT_EQ(results_of(specs).size(), specs.size());
    for (const ResultSpec& spec : specs)
        EXPECT_EQ(wrong_expression(spec.expression, kNames), "") << spec.expression;
    EXPECT_NE(wrong_expression("peek(\"a\", 1)", kNames), "");
    EXPECT_NE(wrong_expression("peak(\"b\", 1)", kNames), "");
}

TEST(Results, AreOfWhatTheirFunctionsAreOf) {
    const ResultNames names = {{"a"}, {"floor"}, {"marble_"}};
    const auto wrong = [&](const char* expression) { return wrong_expression(expression, names); };
    for (const char* right :
         {"impacts(\"floor\")", "impacts(\"*/floor\")", "energy(\"*\", 0)", "peaks(\"marble_3\")",
          "duration == 2", "duration >= 2 && balls != 3 ? 1 : peak( \"a\" , -1)", "duration <= 2"})
        EXPECT_EQ(wrong(right), "") << right;
    EXPECT_EQ(wrong("energy(\"floor\", 0)"), "there is no ball 'floor'; known here: a");
    EXPECT_EQ(wrong("balls > 9 ? peak( \"floor\", 1) : 0"),
              "there is no ball 'floor'; known here: a");
    EXPECT_EQ(wrong("peak(\"a/floor\", 1)"), "peak() is of one ball, not of 'a/floor'");
    EXPECT_EQ(wrong("speed(\"*\", 1)"), "speed() is of one ball, not of '*'");
    EXPECT_EQ(wrong("energy(\"a/floor\", 1)"), "energy() is of one ball, not of 'a/floor'");
    EXPECT_EQ(wrong("duration = 3"), "not an expression: '=' sets nothing here; '==' compares");
    EXPECT_EQ(wrong("balls == (duration = 2)"), wrong("duration = 3"));
    EXPECT_EQ(wrong("1, 2"), "not an expression: these are 2");
}

TEST(Results, ThatAreNotThereAreNone) {
    const auto values = results_of({{"a", "peak(\"a\", 1000)"},
                                    {"b", "impact_time(\"a\", 0)"},
                                    {"c", "z(\"a\", 5)"},
                                    {"d", "1 / 0"},
                                    {"e", "rest_time(\"a\")"},
                                    {"last", "impact_time(\"a\", -1) > impact_time(\"a\", 1)"}});
    for (std::size_t i = 0; i < 5; ++i) EXPECT_FALSE(values[i]) << i;
    EXPECT_EQ(values[5], 1.0);
}

constexpr const char* kRandom =
    "base: base.yaml\nmode: random\ncount: 40\nseed: 2\nrandom:\n  balls:\n"
    "    - name: m\n      count: {integer: [1, 30]}\n"
    "      region: {from: [-0.5, -0.5, 0], to: [0.5, 0.5, 1.5]}\n      gap: 0.01\n"
    "      each: {radius: {uniform: [0.02, 0.1]}, mass: {uniform: [1, 2]}, \"velocity[1]\": "
    "{normal: "
    "[0, 1]}}\n  camera: {to: [0, 0, 1], distance: {uniform: [2, 3]}, azimuth_deg: {uniform: [0, "
    "360]}, elevation_deg: {uniform: [10, 50]}, fov_deg: 45}\n";

TEST(RandomScenes, HaveBallsInTheirRegionAndClearOfAllElse) {
    const Sweep sweep = SweepFiles(kRandom).sweep();
    std::size_t most = 0, fewest = 100;
    for (std::int64_t run = 0; run < 40; ++run) {
        const RunScene made = make_run_scene(sweep, {}, run);
        ASSERT_TRUE(made.scene) << made.wrong;
        const std::vector<Ball>& balls = made.scene->balls;
        most = std::max(most, balls.size());
        fewest = std::min(fewest, balls.size());
        for (std::size_t i = 1; i < balls.size(); ++i) {
            const Ball& ball = balls[i];
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(ball.position[axis], (axis == 2 ? 0 : -0.5) + ball.radius);
                EXPECT_LE(ball.position[axis], (axis == 2 ? 1.5 : 0.5) - ball.radius);
            }
            EXPECT_GE(ball.position.z() - ball.radius, 0.01);
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GE((ball.position - balls[j].position).norm(),
                          ball.radius + balls[j].radius + 0.01);
        }
    }
    EXPECT_GE(fewest, 2U);  // one and the base's
    EXPECT_LE(fewest, 4U);
    EXPECT_GT(most, 25U);
}

TEST(RandomScenes, HaveACameraOnItsSphere) {
    const Sweep sweep = SweepFiles(kRandom).sweep();
    const Scene a = make_run_scene(sweep, {}, 0).scene.value();
    const Scene b = make_run_scene(sweep, {}, 1).scene.value();
    for (const Scene* scene : {&a, &b}) {
        const Vec3 arm = scene->camera->from - Vec3(0, 0, 1);
        EXPECT_GE(arm.norm(), 2 - kTight);
        EXPECT_LE(arm.norm(), 3 + kTight);
        const double elevation = std::asin(arm.z() / arm.norm()) * 180 / M_PI;
        EXPECT_GE(elevation, 10 - 1e-9);
        EXPECT_LE(elevation, 50 + 1e-9);
        EXPECT_EQ(scene->camera->fov_deg, 45);
    }
    EXPECT_NE(a.camera->from, b.camera->from);
}

TEST(RandomScenes, DependOnSeedAndRunAlone) {
    const Sweep sweep = SweepFiles(kRandom).sweep();
    std::string more = kRandom;
    more.replace(more.find("count: 40"), 9, "count: 90");
    const Sweep longer = SweepFiles(more).sweep();
    const auto print = [](const Sweep& s, std::int64_t run) {
        return make_run_scene(s, {}, run).scene.value().fingerprint;
    };
    const std::uint64_t late_first = print(sweep, 39);
    EXPECT_EQ(print(sweep, 0), print(longer, 0));
    EXPECT_EQ(late_first, print(longer, 39));
    EXPECT_NE(print(sweep, 0), print(sweep, 1));
}

TEST(RandomScenes, WithoutRoomSaySoAndEnd) {
    std::string full = kRandom;
    full.replace(full.find("{integer: [1, 30]}"), 18, "5000");
    const RunScene made = make_run_scene(SweepFiles(full).sweep(), {}, 0);
    EXPECT_FALSE(made.scene);
    EXPECT_NE(made.wrong.find("no place for ball"), std::string::npos) << made.wrong;
    EXPECT_NE(made.wrong.find("after 1000 attempts"), std::string::npos) << made.wrong;
}

TEST(Records, ReadBackAndAreSettledOnlyAsTheyWereWritten) {
    const SweepFiles files(
        "base: base.yaml\naxes: {balls.a.mass: [1, 2]}\nresults: {t: duration}\n"
        "outputs: {motion: true}\n");
    const Sweep sweep = files.sweep();
    const Plan plan(sweep);
    const std::string dir = files.folder() + "/out";
    RunMaker maker(sweep, plan, dir);
    const RunRecord made = maker.make(1, {});
    EXPECT_EQ(made.status, RunStatus::kDone);
    const RunRecord read = read_record(sweep, dir, 1);
    EXPECT_EQ(read.fingerprint, made.fingerprint);
    EXPECT_EQ(read.results, made.results);
    EXPECT_EQ(read.files, made.files);
    EXPECT_EQ(read.files.size(), 1U);
    EXPECT_TRUE(is_settled(read, dir, run_fingerprint(sweep, 1, plan.values(1))));
    EXPECT_FALSE(is_settled(read, dir, run_fingerprint(sweep, 1, plan.values(0))));
    std::filesystem::resize_file(dir + "/runs/000/000001/motion.csv", 10);
    EXPECT_FALSE(is_settled(read, dir, made.fingerprint));
    EXPECT_EQ(read_record(sweep, dir, 0).status, RunStatus::kMissing);
}

}  // namespace
}  // namespace carom
