// What a right scene reads as.
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "core/failure.h"
#include "scene/catalogue.h"
#include "scene/virtual_body.h"
#include "scene_testing.h"

namespace carom {
namespace {

/// The contract's example, with the method that there is.
const char* const kContract = R"(carom: 1
title: Basketball rebound test
simulation:
  duration: 4.0
  gravity: [0, 0, -9.81]
  restitution_constant: 4.0
  method: fixed
  step: 0.00025
  solver: world
  iterations: 20
materials:
  steel:  {restitution: 1.0}
  rubber: {virtual_body: {distance: 0.42, velocity: 5.0}, friction: 0.6}
pairs:
  - {between: [rubber, steel], restitution: 0.8, friction: 0.5}
looks:
  red: {color: "#c8102e", style: striped}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: steel}
  - {name: plate, box: {position: [0, 0, 1], size: [1, 1, 0.001], rotation_deg: [0, 30, 0]}, material: steel}
  - {name: bump,  sphere: {position: [0, 0, 0], radius: 0.5}, material: steel}
  - {name: rail,  capsule: {from: [0, 0, 0], to: [1, 0, 0], radius: 0.05}, material: steel}
  - {name: drum,  cylinder: {from: [5, 0, 0], to: [5, 0, 1], radius: 0.25}, material: steel}
  - {name: hoop,  ring: {position: [5, 5, 3], axis: [0, 2, 0], radius: 0.25, tube_radius: 0.01}, material: steel}
  - {name: dish,  bowl: {position: [7, 0, 1], radius: 0.5, opening: [0, 0, 2]}, material: steel}
  - {name: tube,  pipe: {from: [9, 0, 0], to: [9, 0, 1], radius: 0.5, angle_deg: 360}, material: steel}
  - {name: gutter,  pipe: {from: [9, 5, 0], to: [9, 6, 1], radius: 0.5, angle_deg: 90}, material: steel}
defaults: {ball: {mass: 1.0}}
balls:
  - {name: a, radius: 0.12, mass: 0.6, inertia: shell, material: rubber, look: red,
     position: [0, 0, 1.92], velocity: [0, 0, 0], spin: [0, 0, 0]}
  - {name: b, preset: basketball, drop_height: 1.8, at: [1, 0]}
  - {name: c, radius: 0.05, position: [0, 0, 3], repeat: {count: [10, 10, 2], spacing: 0.11, jitter: 0.001, seed: 1}}
camera: {from: [0, -6, 1.5], to: [0, 0, 1], up: [0, 0, 1], fov_deg: 40}
film:   {size: [1280, 720], fps: 60, start: 0, speed: 1, stills: [0.5, 1.2]}
overlay: {ruler: true, clock: true, trail: true, labels: true}
)";

TEST(Reader, ReadsTheContractsExample) {
    const Scene scene = scene_of(kContract);
    EXPECT_EQ(scene.file, "t.yaml");
    EXPECT_EQ(scene.title, "Basketball rebound test");
    EXPECT_EQ(scene.simulation.duration, 4.0);
    EXPECT_EQ(scene.simulation.gravity, Vec3(0, 0, -9.81));
    EXPECT_EQ(scene.simulation.step, 0.00025);

    ASSERT_EQ(scene.materials.size(), 4U);  // default, steel, rubber, and basketball by its preset
    EXPECT_EQ(scene.materials[0].name, "");
    EXPECT_EQ(scene.materials[1].virtual_body.distance_m, 0);
    EXPECT_EQ(scene.materials[2].virtual_body.distance_m, 0.42);
    EXPECT_EQ(scene.materials[2].virtual_body.velocity_m_s, 5);
    EXPECT_EQ(scene.materials[2].friction, 0.6);
    EXPECT_EQ(scene.materials[2].mark.line, 13);
    EXPECT_EQ(scene.materials[3].name, "basketball");
    ASSERT_EQ(scene.pairs.size(), 1U);
    EXPECT_EQ(scene.pairs[0].between, (std::array{2, 1}));
    EXPECT_EQ(scene.pairs[0].restitution, 0.8);
    EXPECT_EQ(scene.pairs[0].friction, 0.5);

    ASSERT_EQ(scene.surfaces.size(), 9U);
    EXPECT_EQ(std::get<PlaneShape>(scene.surfaces[0].shape).normal, Vec3(0, 0, 1));
    const BoxShape& plate = std::get<BoxShape>(scene.surfaces[1].shape);
    EXPECT_EQ(plate.size, Vec3(1, 1, 0.001));
    // 30 degrees about y turn x towards -z.
    EXPECT_TRUE(
        (plate.orientation * Vec3::UnitX()).isApprox(Vec3(std::sqrt(0.75), 0, -0.5), 1e-15));
    EXPECT_EQ(std::get<SphereShape>(scene.surfaces[2].shape).radius, 0.5);
    EXPECT_EQ(std::get<CapsuleShape>(scene.surfaces[3].shape).to, Vec3(1, 0, 0));
    EXPECT_EQ(scene.surfaces[3].material, 1);
    EXPECT_EQ(std::get<CylinderShape>(scene.surfaces[4].shape),
              (CylinderShape{Vec3(5, 0, 0), Vec3(5, 0, 1), 0.25}));
    EXPECT_EQ(std::get<RingShape>(scene.surfaces[5].shape),
              (RingShape{Vec3(5, 5, 3), Vec3::UnitY(), 0.25, 0.01}));
    EXPECT_EQ(std::get<BowlShape>(scene.surfaces[6].shape),
              (BowlShape{Vec3(7, 0, 1), 0.5, Vec3::UnitZ(), 0.5}));
    EXPECT_TRUE(std::get<PipeShape>(scene.surfaces[7].shape).is_tube());
    const PipeShape& gutter = std::get<PipeShape>(scene.surfaces[8].shape);
    EXPECT_LT((gutter.opening - Vec3(0, -1, 1).normalized()).norm(), 1e-15);
    EXPECT_NEAR(gutter.angle, std::numbers::pi / 2, 1e-15);

    ASSERT_EQ(scene.balls.size(), 202U);
    const Ball& a = scene.balls[0];
    EXPECT_EQ(a.radius, 0.12);
    EXPECT_EQ(a.mass, 0.6);
    EXPECT_EQ(a.inertia_factor, 2.0 / 3.0);
    EXPECT_EQ(a.material, 2);
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(a.look)].style, LookStyle::kStriped);
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(a.look)].color.r, 0xc8 / 255.0);
    EXPECT_EQ(a.mark.line, 30);
    const Ball& b = scene.balls[1];
    EXPECT_EQ(b.preset, "basketball");
    EXPECT_EQ(b.position, Vec3(1, 0, 1.8 + b.radius));
    EXPECT_EQ(b.mass, find_preset("basketball")->mass) << "a preset comes before defaults";
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(b.look)].style, LookStyle::kBasketball);
    EXPECT_EQ(scene.balls[2].name, "c_0_0_0");
    EXPECT_EQ(scene.balls[3].name, "c_0_0_1");
    EXPECT_EQ(scene.balls[201].name, "c_9_9_1");

    ASSERT_TRUE(scene.camera);
    EXPECT_EQ(scene.camera->from, Vec3(0, -6, 1.5));
    EXPECT_EQ(scene.film.stills, (std::vector<double>{0.5, 1.2}));
    EXPECT_TRUE(scene.overlay.ruler && scene.overlay.clock && scene.overlay.trail &&
                scene.overlay.labels);
}

TEST(Reader, FillsInTheDefaultsOfTheStructs) {
    const Scene read =
        scene_of("carom: 1\noverlay: {ruler: true, clock: true, trail: true, labels: true}");
    const Scene made;
    EXPECT_EQ(read.simulation.duration, made.simulation.duration);
    EXPECT_EQ(read.simulation.max_duration, made.simulation.max_duration);
    EXPECT_EQ(read.simulation.gravity, made.simulation.gravity);
    EXPECT_EQ(read.simulation.restitution_constant, made.simulation.restitution_constant);
    EXPECT_EQ(read.simulation.method, made.simulation.method);
    EXPECT_EQ(read.simulation.step, made.simulation.step);
    EXPECT_EQ(read.simulation.solver, made.simulation.solver);
    EXPECT_EQ(read.simulation.iterations, made.simulation.iterations);
    EXPECT_EQ(read.film.width_px, made.film.width_px);
    EXPECT_EQ(read.film.height_px, made.film.height_px);
    EXPECT_EQ(read.film.fps.numerator, made.film.fps.numerator);
    EXPECT_EQ(read.film.fps.denominator, made.film.fps.denominator);
    EXPECT_EQ(read.film.start, made.film.start);
    EXPECT_EQ(read.film.speed, made.film.speed);
    EXPECT_EQ(read.film.stills, made.film.stills);
    EXPECT_FALSE(read.camera);
    EXPECT_EQ(read.overlay.ruler->from, RulerOptions{}.from);
    EXPECT_FALSE(read.overlay.ruler->at || read.overlay.ruler->to);
    EXPECT_EQ(read.overlay.clock->corner, ClockOptions{}.corner);
    EXPECT_EQ(read.overlay.clock->digits, ClockOptions{}.digits);
    EXPECT_EQ(read.overlay.trail->seconds, TrailOptions{}.seconds);
    EXPECT_EQ(read.overlay.trail->width_px, TrailOptions{}.width_px);
    EXPECT_EQ(read.overlay.labels->size_px, LabelOptions{}.size_px);
    const Overlay none = scene_of("carom: 1\noverlay: {ruler: false}").overlay;
    EXPECT_FALSE(none.ruler || none.clock || none.trail || none.labels);
}

TEST(Reader, FillsInTheDefaultsOfBodies) {
    const Scene scene = scene_of(
        "carom: 1\n"
        "looks: {x: {}}\n"
        "surfaces: [{name: p, plane: {}}, {name: s, sphere: {position: [9, 9, 9], radius: 1}}]\n"
        "balls: [{name: a, radius: 0.5, position: [0, 0, 0.5]}]\n"
        "camera: {from: [0, -6, 1.5], to: [0, 0, 1]}");
    const Ball made;
    const Ball& read = scene.balls.at(0);
    EXPECT_EQ(read.mass, made.mass);
    EXPECT_EQ(read.inertia_factor, made.inertia_factor);
    EXPECT_EQ(read.velocity, made.velocity);
    EXPECT_EQ(read.spin, made.spin);
    EXPECT_EQ(read.material, 0);
    EXPECT_EQ(scene.materials.at(0).virtual_body.distance_m, 0);
    EXPECT_FALSE(scene.materials[0].friction);
    EXPECT_EQ(scene.camera->fov_deg, Camera{}.fov_deg);
    EXPECT_EQ(scene.camera->up, Camera{}.up);
    EXPECT_EQ(std::get<PlaneShape>(scene.surfaces[0].shape).normal, PlaneShape{}.normal);
    EXPECT_EQ(std::get<PlaneShape>(scene.surfaces[0].shape).offset_m, PlaneShape{}.offset_m);
    EXPECT_EQ(scene.looks[0].tile_m, Look{}.tile_m);
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(scene.surfaces[0].look)].style,
              LookStyle::kChecker);
    EXPECT_EQ(scene.looks[static_cast<std::size_t>(scene.surfaces[1].look)].style,
              LookStyle::kPlain);
}

/// A virtual body of the material `m`, read with K.
VirtualBody body_of(const std::string& material, double constant = 4) {
    const Scene scene =
        scene_of("carom: 1\nsimulation: {restitution_constant: " + std::to_string(constant) +
                 "}\nmaterials: {m: " + material + "}");
    return scene.materials.at(1).virtual_body;
}

TEST(Reader, RestitutionIsShorthandForAVirtualBody) {
    EXPECT_EQ(body_of("{restitution: 1}").distance_m, 0);
    EXPECT_FALSE(std::signbit(body_of("{restitution: 1.0}").distance_m));
    EXPECT_TRUE(std::isinf(body_of("{restitution: 0}").distance_m));
    EXPECT_EQ(body_of("{restitution: 0.5}").distance_m, 2 * std::numbers::ln2 / 4);
    EXPECT_EQ(body_of("{restitution: 0.5}").velocity_m_s, 1);
    for (const double constant : {4.0, 0.5, 100.0})
        for (const double e : {1e-9, 0.1, 0.5, 0.845354, 0.999999}) {
            const double back = rigid_restitution(virtual_body_for(e, constant), constant);
            EXPECT_NEAR(back, e, 1e-14 * e) << "K = " << constant;
        }
    EXPECT_EQ(rigid_restitution(virtual_body_for(0, 4), 4), 0);
    EXPECT_EQ(rigid_restitution({0, 0}, 4), 1) << "x = 0 loses nothing, whatever v";
    EXPECT_EQ(body_of("{virtual_body: {distance: 0, velocity: 0}}").distance_m, 0);
}

TEST(Reader, NormalisesPlanesAndQuaternions) {
    const Scene scene = scene_of(
        "carom: 1\nsurfaces:\n"
        "  - {name: p, plane: {normal: [0, 3, 4], offset: 10}}\n"
        "  - {name: q, box: {size: [1, 1, 1], quaternion: [2, 0, 0, 2]}}\n"
        "  - {name: r, box: {size: [1, 1, 1], rotation_deg: [90, 0, 90]}}");
    const PlaneShape& plane = std::get<PlaneShape>(scene.surfaces[0].shape);
    EXPECT_TRUE(plane.normal.isApprox(Vec3(0, 0.6, 0.8), 1e-15));
    EXPECT_DOUBLE_EQ(plane.offset_m, 2) << "points with (0,3,4).p = 10 are 2 m away";
    const Quat about_z = std::get<BoxShape>(scene.surfaces[1].shape).orientation;
    EXPECT_TRUE((about_z * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-15));
    // About x first: y goes to z, which the turn about z leaves; x goes to y.
    const Quat both = std::get<BoxShape>(scene.surfaces[2].shape).orientation;
    EXPECT_TRUE((both * Vec3::UnitY()).isApprox(Vec3::UnitZ(), 1e-15));
    EXPECT_TRUE((both * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-15));
}

FrameRate fps_of(const std::string& text) {
    return scene_of("carom: 1\nfilm: {fps: " + text + "}").film.fps;
}

TEST(Reader, FrameRatesAreExactFractions) {
    const auto expect = [](const std::string& text, int numerator, int denominator) {
        const FrameRate rate = fps_of(text);
        EXPECT_EQ(rate.numerator, numerator) << text;
        EXPECT_EQ(rate.denominator, denominator) << text;
    };
    expect("60", 60, 1);
    expect("\"30000/1001\"", 30000, 1001);
    expect("30000/1001", 30000, 1001);
    expect("\"120/2\"", 60, 1);
    expect("23.976", 2997, 125);
    expect("29.97", 2997, 100);
    expect("12.5", 25, 2);
    expect("0.1", 1, 10);
    expect("1e-3", 1, 1000);
    expect("100000", 100000, 1);
}

TEST(Reader, ReadsDurationUntilRest) {
    const Scene scene = scene_of("carom: 1\nsimulation: {duration: rest, max_duration: 30}");
    EXPECT_FALSE(scene.simulation.duration);
    EXPECT_EQ(scene.simulation.max_duration, 30);
}

TEST(Reader, ReadsOverlayOptions) {
    const Overlay overlay =
        scene_of(
            "carom: 1\noverlay: {ruler: {at: [1, 2], from: 0.5, to: 2}, clock: {corner: "
            "bottom_right, digits: 3}, trail: {seconds: 2, width_px: 4}, labels: {size_px: 9}}")
            .overlay;
    EXPECT_EQ(overlay.ruler->at, Vec2(1, 2));
    EXPECT_EQ(overlay.ruler->from, 0.5);
    EXPECT_EQ(overlay.ruler->to, 2);
    EXPECT_EQ(overlay.clock->corner, Corner::kBottomRight);
    EXPECT_EQ(overlay.clock->digits, 3);
    EXPECT_EQ(overlay.trail->seconds, 2);
    EXPECT_EQ(overlay.trail->width_px, 4);
    EXPECT_EQ(overlay.labels->size_px, 9);
}

TEST(Reader, ReadsTextPeaksArrowsPlotAndTheme) {
    const std::string balls =
        "carom: 1\ntitle: T\nballs:\n  - {name: a, radius: 0.1, position: [0, 0, 1]}\n"
        "  - {name: b, radius: 0.1, position: [1, 0, 1]}\n";
    const Overlay none = scene_of(balls).overlay;
    EXPECT_FALSE(none.title || none.peaks || none.velocity || none.plot);
    EXPECT_EQ(none.caption, "");
    EXPECT_EQ(none.theme, Theme::kLight);

    const Overlay plain =
        scene_of(balls + "overlay: {title: true, peaks: true, velocity: true, plot: true}").overlay;
    EXPECT_EQ(plain.title->size_px, TitleOptions{}.size_px);
    EXPECT_EQ(plain.peaks->size_px, PeakOptions{}.size_px);
    EXPECT_FALSE(plain.velocity->scale_s);
    EXPECT_EQ(plain.plot->balls, (std::vector{0, 1}));
    EXPECT_EQ(plain.plot->corner, PlotOptions{}.corner);
    EXPECT_EQ(plain.plot->size, PlotOptions{}.size);

    const Overlay said =
        scene_of(balls +
                 "overlay: {title: {size_px: 30}, caption: Two balls, peaks: {size_px: 20}, "
                 "velocity: {scale: 0.2}, plot: {ball: [b], size: [0.5, 0.25], corner: "
                 "bottom_left}, theme: dark}")
            .overlay;
    EXPECT_EQ(said.title->size_px, 30);
    EXPECT_EQ(said.caption, "Two balls");
    EXPECT_EQ(said.peaks->size_px, 20);
    EXPECT_EQ(said.velocity->scale_s, 0.2);
    EXPECT_EQ(said.plot->balls, std::vector{1});
    EXPECT_EQ(said.plot->size, (std::array{0.5, 0.25}));
    EXPECT_EQ(said.plot->corner, Corner::kBottomLeft);
    EXPECT_EQ(said.theme, Theme::kDark);
}

TEST(Reader, APlotShowsAtMostTwelveBallsEachOnce) {
    const std::string many =
        "carom: 1\nballs: [{name: c, radius: 0.1, position: [0, 0, 1], repeat: {count: [13, 1, 1], "
        "spacing: "
        "1}}]\n";
    EXPECT_EQ(errors_of(many + "overlay: {plot: true}"),
              "t.yaml:3:17: error: a plot shows at most 12 balls, and the scene has 13; name them, "
              "such as 'plot: {ball: c_0_0_0}'\n");
    EXPECT_EQ(scene_of(many + "overlay: {plot: {ball: c_12_0_0}}").overlay.plot->balls,
              std::vector{12});
    EXPECT_EQ(errors_of(many + "overlay: {plot: {ball: [c_1_0_0, c_1_0_0]}}"),
              "t.yaml:3:34: error: the plot names the ball 'c_1_0_0' twice\n");
}

TEST(Reader, DefaultsFillWhatBallAndPresetLeaveOut) {
    const Scene scene = scene_of(
        "carom: 1\n"
        "materials: {wood: {restitution: 0.5}}\n"
        "defaults: {ball: {radius: 0.2, mass: 3, inertia: 0.5, material: wood, drop_height: 1, "
        "velocity: [1, 0, 0], spin: [0, 2, 0]}}\n"
        "balls:\n"
        "  - {name: a}\n"
        "  - {name: b, mass: 4, at: [1, 0], velocity: [0, 0, 0]}\n"
        "  - {name: c, preset: tennis, at: [2, 0]}\n"
        "  - {name: d, position: [3, 0, 9]}\n");
    const Ball& a = scene.balls[0];
    EXPECT_EQ(a.radius, 0.2);
    EXPECT_EQ(a.mass, 3);
    EXPECT_EQ(a.inertia_factor, 0.5);
    EXPECT_EQ(scene.materials[static_cast<std::size_t>(a.material)].name, "wood");
    EXPECT_EQ(a.position, Vec3(0, 0, 1.2));
    EXPECT_EQ(a.velocity, Vec3(1, 0, 0));
    EXPECT_EQ(a.spin, Vec3(0, 2, 0));
    EXPECT_EQ(scene.balls[1].mass, 4);
    EXPECT_EQ(scene.balls[1].velocity, Vec3(0, 0, 0));
    const Ball& c = scene.balls[2];
    EXPECT_EQ(c.mass, find_preset("tennis")->mass);
    EXPECT_EQ(c.radius, find_preset("tennis")->radius);
    EXPECT_EQ(scene.materials[static_cast<std::size_t>(c.material)].name, "tennis");
    EXPECT_EQ(c.velocity, Vec3(1, 0, 0)) << "presets say nothing about velocities";
    EXPECT_EQ(scene.balls[3].position, Vec3(3, 0, 9));
}

TEST(Reader, ATilesWidthGoesByTheStyleUnlessItIsSaid) {
    const Scene scene = scene_of(
        "carom: 1\nlooks: {a: {style: checker}, b: {style: wood}, c: {style: court},"
        " d: {style: wood, tile: 0.3, reflection: 0.25}}");
    EXPECT_EQ(scene.looks.at(0).tile_m, 0.5);
    EXPECT_EQ(scene.looks.at(1).tile_m, 0.12);
    EXPECT_EQ(scene.looks.at(2).tile_m, 0.07);
    EXPECT_EQ(scene.looks.at(3).tile_m, 0.3);
    EXPECT_EQ(scene.looks.at(0).reflection, 0);
    EXPECT_EQ(scene.looks.at(3).reflection, 0.25);
}

TEST(Reader, PlainBallsCycleThroughColours) {
    std::string text = "carom: 1\nballs:\n";
    for (int i = 0; i < 9; ++i)
        text += "  - {name: b" + std::to_string(i) + ", radius: 0.1, position: [" +
                std::to_string(i) + ", 0, 0]}\n";
    const Scene scene = scene_of(text);
    EXPECT_EQ(scene.looks.size(), 7U);
    EXPECT_NE(scene.balls[0].look, scene.balls[1].look);
    EXPECT_EQ(scene.balls[0].look, scene.balls[7].look);
}

TEST(Reader, ReadsFilesAndRefusesMissingOnes) {
    const std::string path = testing::TempDir() + "carom_reader_test.yaml";
    std::ofstream(path) << kContract;
    EXPECT_TRUE(read_scene_file(path).scene);
    EXPECT_EQ(read_scene_file(path).scene->file, path);
    EXPECT_THROW(read_scene_file(path + ".not_there"), Failure);
    EXPECT_THROW(read_scene_file(testing::TempDir()), Failure);
    std::remove(path.c_str());
}

}  // namespace
}  // namespace carom
