// One small wrong scene per rule, with the message and the place that it must give.
#include "scene_testing.h"

namespace carom {
namespace {

struct Wrong {
    std::string body;      ///< what follows "carom: 1" and a line end
    std::string expected;  ///< without "t.yaml:" and the last line end; one line per message
};

void expect_errors(const std::vector<Wrong>& cases) {
    ASSERT_FALSE(cases.empty());
    for (const Wrong& wrong : cases) {
        std::string expected = "t.yaml:" + wrong.expected + "\n";
        for (std::size_t i = expected.find('\n'); i + 1 < expected.size();
             i = expected.find('\n', i + 1))
            expected.insert(i + 1, "t.yaml:");
        EXPECT_EQ(errors_of("carom: 1\n" + wrong.body), expected) << wrong.body;
    }
}

TEST(Errors, Top) {
    EXPECT_EQ(errors_of("title: x"),
              "t.yaml:1:1: error: the key 'carom' is missing, such as 'carom: 1'\n");
    EXPECT_EQ(errors_of("carom: 2"), "t.yaml:1:8: error: 'carom' must be 1, not 2\n");
    EXPECT_EQ(errors_of("[]"),
              "t.yaml:1:1: error: a scene must be a mapping of keys, such as 'carom: 1'\n");
    expect_errors({
        {"titel: x", "2:1: error: unknown key 'titel'; did you mean 'title'?"},
        {"title: 7",
         "2:8: error: 'title' must be text (in quotes if it looks like a number), not 7"},
        {"title:1", "2:1: error: unknown key 'title:1'; a space must follow the ':'"},
        {"title:",
         "2:1: error: 'title' has no value; it must be text (in quotes if it looks like a "
         "number), or left out"},
        {"title: a\ntitle: b",
         "3:1: error: the key 'title' stands twice in this mapping; it stands in line 2 already"},
        {"balls: {}", "2:8: error: 'balls' must be a list of mappings, not a mapping"},
        {"balls: [1]", "2:9: error: an entry of 'balls' must be a mapping, not 1"},
        {"film: []", "2:7: error: 'film' must be a mapping, not a list of 0"},
    });
}

TEST(Errors, Simulation) {
    expect_errors({
        {"simulation: {duration: 0}", "2:24: error: 'duration' must be above 0 s, not 0"},
        {"simulation: {duration: rset}",
         "2:24: error: 'duration' must be a number (s) or 'rest', "
         "not the text 'rset'; did you mean 'rest'?"},
        {"simulation: {max_duration: -1}", "2:28: error: 'max_duration' must be above 0 s, not -1"},
        {"simulation: {gravity: [0, 0]}",
         "2:23: error: 'gravity' must be a list of 3 numbers (m/s^2), not a list of 2"},
        {"simulation: {gravity: [0, x, 0]}",
         "2:27: error: 'gravity' must be a number (m/s^2), not the text 'x'"},
        {"simulation: {gravity: [0, .inf, 0]}",
         "2:27: error: 'gravity' must be a finite number, not .inf"},
        {"simulation: {restitution_constant: 0}",
         "2:36: error: 'restitution_constant' must be above 0 1/s, not 0"},
        {"simulation: {step: 0}", "2:20: error: 'step' must be above 0 s, not 0"},
        {"simulation: {step: 1_000}",
         "2:20: error: 'step' must be a number (s), not the text '1_000'"},
        {"simulation: {step: \"1\"}", "2:20: error: 'step' must be a number (s), not the text '1'"},
        {"simulation: {step: .NaN}", "2:20: error: 'step' must be a finite number, not .NaN"},
        {"simulation: {step: 1e400}", "2:20: error: 'step' must be a finite number, not 1e400"},
        {"simulation: {method: exat}",
         "2:22: error: 'method' must be one of exact, fixed, not the "
         "text 'exat'; did you mean 'exact'?"},
        {"simulation: {solver: quik}",
         "2:22: error: 'solver' must be one of world, quick, not the "
         "text 'quik'; did you mean 'quick'?"},
        {"simulation: {iterations: 0}", "2:26: error: 'iterations' must be at least 1, not 0"},
        {"simulation: {iterations: 2.5}",
         "2:26: error: 'iterations' must be a whole number, not 2.5"},
    });
}

TEST(Errors, MaterialsPairsAndLooks) {
    expect_errors({
        {"materials: {a: {restitution: 1.01}}",
         "2:30: error: 'restitution' must be between 0 and 1, not 1.01"},
        {"materials: {a: {restitution: -0.1}}",
         "2:30: error: 'restitution' must be between 0 and 1, not -0.1"},
        {"materials: {a: {restitution: 1, virtual_body: {distance: 1, velocity: 1}}}",
         "2:33: error: 'restitution' and 'virtual_body' cannot stand together"},
        {"materials: {a: {virtual_body: {distance: 1, velocity: 0}}}",
         "2:55: error: 'velocity' must be above 0 where 'distance' is, not 0"},
        {"materials: {a: {virtual_body: {distance: -1, velocity: 1}}}",
         "2:42: error: 'distance' must be at least 0 m, not -1"},
        {"materials: {a: {virtual_body: {distance: 1}}}",
         "2:31: error: the key 'velocity' is missing, such as 'velocity: 5.0'"},
        {"materials: {a: {friction: -1}}", "2:27: error: 'friction' must be at least 0, not -1"},
        {"materials: {a: 1}", "2:16: error: 'a' must be a mapping, not 1"},
        {"materials: {1a: {}}",
         "2:13: error: '1a' is not a name: a name is a letter or '_' and then letters, digits, '_' "
         "or '-', at most 64 characters"},
        {"materials: {a: {}, a: {}}",
         "2:20: error: the key 'a' stands twice in this mapping; it stands in line 2 already"},
        {"looks: {a: {}, a: {}}",
         "2:16: error: the key 'a' stands twice in this mapping; it stands in line 2 already"},
        {"materials: {aa: {}, bb: {}}\npairs: [{between: [aa, bc], friction: 1}]",
         "3:24: error: there is no material 'bc'; did you mean 'bb'?"},
        {"materials: {aa: {}, bb: {}}\npairs: [{between: [aa, bb]}]",
         "3:9: error: at least one of 'restitution', 'friction', 'rolling', 'pivoting', "
         "'tangential_restitution' must stand here"},
        {"materials: {aa: {}, bb: {}}\npairs:\n  - {between: [aa, bb], friction: 1}\n  - {between: "
         "[bb, aa], friction: 2}",
         "5:15: error: the pair of 'bb' and 'aa' stands twice"},
        {"pairs: [{friction: 1}]",
         "2:9: error: the key 'between' is missing, such as 'between: [rubber, steel]'"},
        {"looks: {a: {color: red}}",
         "2:20: error: 'color' must be a colour such as \"#c8102e\", in quotes, not the text "
         "'red'"},
        {"looks: {a: {second_color: \"#12345g\"}}",
         "2:27: error: 'second_color' must be a colour such as \"#c8102e\", in quotes, not the "
         "text "
         "'#12345g'"},
        {"looks: {a: {tile: 0}}", "2:19: error: 'tile' must be above 0 m, not 0"},
        {"looks: {a: {reflection: 1.5}}",
         "2:25: error: 'reflection' must be between 0 and 1, not 1.5"},
        {"looks: {a: {style: stripes}}",
         "2:20: error: 'style' must be one of plain, striped, basketball, volleyball, football, "
         "tennis, table_tennis, checker, grid, wood, court, not the text 'stripes'; did you mean "
         "'striped'?"},
    });
}

TEST(Errors, Surfaces) {
    expect_errors({
        {"surfaces: [{plane: {}}]",
         "2:12: error: the key 'name' is missing, such as 'name: floor'"},
        {"surfaces: [{name: a}]",
         "2:12: error: one of 'plane', 'box', 'sphere', 'capsule', 'cylinder', 'ring', "
         "'bowl', 'pipe' must stand here"},
        {"surfaces: [{name: a, plane: {}, sphere: {radius: 1}}]",
         "2:33: error: 'plane' and 'sphere' cannot stand together"},
        {"surfaces: [{name: a, plane: {normal: [0, 0, 0]}}]",
         "2:38: error: the plane's normal has length 0"},
        {"surfaces: [{name: a, box: {size: [1, 0, 1]}}]",
         "2:38: error: 'size' must be above 0 m, not 0"},
        {"surfaces: [{name: a, box: {position: [0, 0, 0]}}]",
         "2:27: error: the key 'size' is missing, such as 'size: [1, 1, 0.001]'"},
        {"surfaces: [{name: a, box: {size: [1, 1, 1], quaternion: [0, 0, 0, 0]}}]",
         "2:57: error: the box's quaternion has length 0"},
        {"surfaces: [{name: a, box: {size: [1, 1, 1], quaternion: [1, 0, 0, 0], rotation_deg: [0, "
         "0, 1]}}]",
         "2:71: error: 'quaternion' and 'rotation_deg' cannot stand together"},
        {"surfaces: [{name: a, sphere: {radius: -1}}]",
         "2:39: error: 'radius' must be above 0 m, not -1"},
        {"surfaces: [{name: a, capsule: {from: [1, 1, 1], to: [1, 1, 1], radius: 1}}]",
         "2:53: error: the capsule's 'from' and 'to' are the same point; a sphere is written "
         "'sphere: {position: [...], radius: ...}'"},
        {"surfaces: [{name: a, cylinder: {from: [1, 1, 1], to: [1, 1, 1], radius: 1}}]",
         "2:54: error: the cylinder's 'from' and 'to' are the same point"},
        {"surfaces: [{name: a, cylinder: {from: [1, 1, 1], to: [1, 1, 2], radius: 0}}]",
         "2:73: error: 'radius' must be above 0 m, not 0"},
        {"surfaces: [{name: a, ring: {radius: 1, tube_radius: 1}}]",
         "2:53: error: the ring's tube_radius must be below its radius, which is that of the "
         "tube's middle: else there is no hole"},
        {"surfaces: [{name: a, ring: {axis: [0, 0, 0], radius: 1, tube_radius: 0.1}}]",
         "2:35: error: the ring's axis has length 0"},
        {"surfaces: [{name: a, bowl: {radius: 1, depth: 2.5}}]",
         "2:47: error: the bowl's depth must be at most twice its radius"},
        {"surfaces: [{name: a, bowl: {radius: 1, opening: [0, 0, 0]}}]",
         "2:49: error: the bowl's opening has length 0"},
        {"surfaces: [{name: a, pipe: {from: [0, 0, 0], to: [0, 0, 0], radius: 1}}]",
         "2:50: error: the pipe's 'from' and 'to' are the same point"},
        {"surfaces: [{name: a, pipe: {from: [0, 0, 0], to: [0, 0, 2], radius: 1}}]",
         "2:28: error: the pipe's opening must not lie along its axis"},
        {"surfaces: [{name: a, pipe: {from: [0, 0, 0], to: [1, 0, 0], radius: 1, angle_deg: 400}}]",
         "2:83: error: 'angle_deg' must be above 0 and at most 360 degrees, not 400"},
        {"surfaces: [{name: a, ring: {radius: 1}}]",
         "2:28: error: the key 'tube_radius' is missing, such as 'tube_radius: 0.009'"},
        {"surfaces: [{name: a, plane: {}, material: steel}]",
         "2:43: error: there is no material 'steel'; known here: basketball, football, "
         "table_tennis, tennis, volleyball"},
        {"surfaces: [{name: a, plane: {}, look: red}]",
         "2:39: error: there is no look 'red'; the file declares none under 'looks'"},
        {"looks: {red: {}}\nsurfaces: [{name: a, plane: {}, look: rde}]",
         "3:39: error: there is no look 'rde'; did you mean 'red'?"},
        {"surfaces: [{name: a, plane: {}, velocity: [0, 0, 1]}]",
         "2:33: error: unknown key 'velocity'; known here: name, plane, box, sphere, capsule, "
         "cylinder, ring, bowl, pipe, material, look"},
        {"surfaces:\n  - {name: a, plane: {}}\n  - {name: a, plane: {}}",
         "4:12: error: the name 'a' is taken already, by the surface in line 3"},
    });
}

TEST(Errors, Balls) {
    const auto ball = [](const std::string& keys) { return "balls:\n  - {name: a, " + keys + "}"; };
    const std::string place = "position: [0, 0, 1], ";
    expect_errors({
        {ball(place + "radius: 0"), "3:44: error: 'radius' must be above 0 m, not 0"},
        {ball(place + "radius: -0.1"), "3:44: error: 'radius' must be above 0 m, not -0.1"},
        {ball(place + "radius: 0.1, mass: 0"), "3:55: error: 'mass' must be above 0 kg, not 0"},
        {ball(place + "radius: .inf"), "3:44: error: 'radius' must be a finite number, not .inf"},
        {ball(place + "radius: 0.1, inertia: 0.67"),
         "3:58: error: 'inertia' must be above 0 and at most 0.6666666666666666, not 0.67"},
        {ball(place + "radius: 0.1, inertia: 0"),
         "3:58: error: 'inertia' must be above 0 and at most 0.6666666666666666, not 0"},
        {ball(place + "radius: 0.1, inertia: shel"),
         "3:58: error: 'inertia' must be a number or one of solid, shell, not the text 'shel'; did "
         "you mean 'shell'?"},
        {ball("position: [0, 0, 1]"),
         "3:5: error: the ball has no radius; give it 'radius' or 'preset'"},
        {ball("radius: 1"),
         "3:5: error: the ball has no place; give it 'position' or 'drop_height'"},
        {ball("radius: 1, at: [1, 1]"),
         "3:5: error: the ball has no place; give it 'position' or 'drop_height'"},
        {ball(place + "radius: 1, drop_height: 1"),
         "3:47: error: 'position' and 'drop_height' cannot stand together"},
        {ball(place + "radius: 1, at: [1, 1]"),
         "3:47: error: 'position' and 'at' cannot stand together"},
        {ball("position: [0, 0, 2e9], radius: 1"),
         "3:32: error: 'position' must be between -1e9 and 1e9 m, not 2e9"},
        {ball("preset: basket_ball, drop_height: 1"),
         "3:23: error: there is no preset 'basket_ball'; did you mean 'basketball'?"},
        {ball(place + "radius: 1, velocty: [0, 0, 0]"),
         "3:47: error: unknown key 'velocty'; did you mean 'velocity'?"},
        {"balls: [{name: 1a, radius: 1, position: [0, 0, 0]}]",
         "2:16: error: 'name' must be a name: a letter or '_' and then letters, digits, '_' or "
         "'-', "
         "at most 64 characters, not the text '1a'"},
        {"balls: [{name: " + std::string(65, 'a') + ", radius: 1, position: [0, 0, 0]}]",
         "2:16: error: 'name' must be a name: a letter or '_' and then letters, digits, '_' or "
         "'-', "
         "at most 64 characters, not the text '" +
             std::string(65, 'a') + "'"},
        {"surfaces: [{name: a, sphere: {radius: 1}}]\n" + ball("position: [0, 0, 9], radius: 1"),
         "4:12: error: the name 'a' is taken already, by the surface in line 2"},
        {"defaults: {ball: {radius: 0}}\n" + ball("position: [0, 0, 9]"),
         "2:27: error: 'radius' must be above 0 m, not 0"},
        {"defaults: {ball: {material: x}}\n" + ball("position: [0, 0, 9], radius: 1"),
         "2:29: error: there is no material 'x'; known here: basketball, football, table_tennis, "
         "tennis, volleyball"},
        {"defaults: {ball: {name: x}}",
         "2:19: error: unknown key 'name'; known here: preset, radius, mass, inertia, material, "
         "look, drop_height, velocity, spin, drag, lift, spin_decay_s"},
    });
    EXPECT_EQ(errors_of("carom: 1\nballs: [{name: " + std::string(64, 'a') +
                        ", radius: 1, position: [0, 0, 0]}]"),
              "");
}

TEST(Errors, Picture) {
    const std::string view = "camera: {from: [0, 0, 1], to: [0, 0, 5]";
    expect_errors({
        {"camera: {to: [0, 0, 0]}", "2:9: error: one of 'from', 'path' must stand here"},
        {"camera: {from: [0, 0, 1], to: [0, 0, 1]}",
         "2:31: error: the camera's 'from' and 'to' are the same point"},
        {view + "}",
         "2:9: error: the camera looks along 'up' ([0, 0, 1]); give it another 'up', "
         "such as [0, 1, 0]"},
        {view + ", up: [0, 0, -2]}",
         "2:46: error: the camera looks along 'up' (from the file); "
         "give it another 'up', such as [0, 1, 0]"},
        {view + ", up: [0, 0, 0]}", "2:46: error: the camera's 'up' has length 0"},
        {view + ", up: [0, 1, 0], fov_deg: 180}",
         "2:66: error: 'fov_deg' must be between 1 and 170 degrees, not 180"},
        {"film: {size: [1281, 720]}",
         "2:15: error: 'size' must be an even number of pixels, not 1281"},
        {"film: {size: [14, 720]}",
         "2:15: error: 'size' must be between 16 and 16384 pixels, not 14"},
        {"film: {size: [20000, 720]}",
         "2:15: error: 'size' must be between 16 and 16384 pixels, not 20000"},
        {"film: {size: [10002, 10000]}",
         "2:14: error: a frame of 10002 x 10000 has 100 million pixels; at most 100 million are "
         "possible"},
        {"film: {size: 720}",
         "2:14: error: 'size' must be a list of 2 whole numbers (pixels), not 720"},
        {"film: {fps: 0}", "2:13: error: 'fps' must be above 0 1/s, not 0"},
        {"film: {fps: -25}", "2:13: error: 'fps' must be above 0 1/s, not -25"},
        {"film: {fps: \"30/0\"}",
         "2:13: error: 'fps' must be a number (1/s) or a fraction such as "
         "\"30000/1001\", not the text '30/0'"},
        {"film: {speed: 0}", "2:15: error: 'speed' must be above 0, not 0"},
        {"film: {start: -1}", "2:15: error: 'start' must be at least 0 s, not -1"},
        {"simulation: {duration: 4}\nfilm: {start: 4}",
         "3:15: error: the film starts at 4 s, but the motion lasts 4 s: there would be no frames"},
        {"simulation: {duration: 4}\nfilm: {stills: [4, 4.5]}",
         "3:20: error: the still at 4.5 s is outside the motion, which lasts 4 s"},
        {"film: {stills: [-1]}", "2:17: error: 'stills' must be at least 0 s, not -1"},
        {"film: {speed: 1e-9}",
         "2:7: error: the film would have 6e+11 frames; at most 1000000000 are possible"},
        {"overlay: {ruler: 1}", "2:18: error: 'ruler' must be true or false or a mapping, not 1"},
        {"overlay: {ruler: {from: 2, to: 1}}",
         "2:32: error: the ruler's 'to' (1 m) must lie above its 'from' (2 m)"},
        {"overlay: {clock: {corner: left}}",
         "2:27: error: 'corner' must be one of top_left, top_right, bottom_left, bottom_right, not "
         "the text 'left'"},
        {"overlay: {clock: {digits: 10}}", "2:27: error: 'digits' must be between 0 and 9, not 10"},
        {"overlay: {trail: {seconds: 0}}", "2:28: error: 'seconds' must be above 0 s, not 0"},
        {"overlay: {labels: {size_px: 0}}",
         "2:29: error: 'size_px' must be above 0 and at most 200 pixels, not 0"},
        {"overlay: {title: true}",
         "2:18: error: the overlay shows a title, but the scene has no 'title'"},
        {"overlay: {caption: true}",
         "2:20: error: 'caption' must be text (in quotes if it looks like a number), not true"},
        {"overlay: {caption: " + std::string(401, 'x') + "}",
         "2:20: error: the caption has 401 characters; a picture has room for 400"},
        {"overlay: {velocity: {scale: 0}}",
         "2:29: error: 'scale' must be above 0 m per m/s, not 0"},
        {"overlay: {plot: {ball: nobody}}", "2:24: error: there is no ball 'nobody'"},
        {"overlay: {plot: {ball: []}}", "2:24: error: the plot's 'ball' names no ball"},
        {"overlay: {plot: {size: [0, 1]}}", "2:25: error: 'size' must be between 0.1 and 1, not 0"},
        {"overlay: {theme: drak}",
         "2:18: error: 'theme' must be one of light, dark, not the text 'drak'; did you mean "
         "'dark'?"},
    });
}

TEST(Errors, AllInOneRunInTheFilesOrder) {
    EXPECT_EQ(errors_of("carom: 1\n"
                        "film: {fps: 0, size: [3, 3]}\n"
                        "balls:\n"
                        "  - {name: a, radius: 1, mass: -1, position: [0, 0, 0]}\n"
                        "  - {name: a, radius: 1, position: [0, 0, 1.5], material: none}\n"
                        "tilte: x\n"),
              "t.yaml:2:13: error: 'fps' must be above 0 1/s, not 0\n"
              "t.yaml:2:23: error: 'size' must be between 16 and 16384 pixels, not 3\n"
              "t.yaml:2:26: error: 'size' must be between 16 and 16384 pixels, not 3\n"
              "t.yaml:4:32: error: 'mass' must be above 0 kg, not -1\n"
              "t.yaml:5:5: error: the balls 'a' and 'a' overlap by 0.5 m at the start\n"
              "t.yaml:5:12: error: the name 'a' is taken already, by the ball in line 4\n"
              "t.yaml:5:59: error: there is no material 'none'; known here: basketball, football, "
              "table_tennis, tennis, volleyball\n"
              "t.yaml:6:1: error: unknown key 'tilte'; did you mean 'title'?\n");
}

TEST(Errors, ColumnsCountCharacters) {
    EXPECT_EQ(
        errors_of("carom: 1\ntitle: \"\xC3\xA9\xE2\x82\xAC\"\nfilm: {\"\xC3\xA9\": 1, fps: 0}"),
        "t.yaml:3:8: error: unknown key '\xC3\xA9'; known here: size, fps, start, speed, "
        "stills, shutter_deg, sound\n"
        "t.yaml:3:21: error: 'fps' must be above 0 1/s, not 0\n");
}

TEST(Warnings, FrictionThatOnlyOnePartnerNames) {
    const std::string head = "carom: 1\nmaterials:\n  rough: {friction: 0.5}\n  smooth: {}\n";
    const std::string floor = "surfaces: [{name: f, plane: {}, material: rough}]\n";
    const auto ball = [](const char* material, const char* name = "a", int x = 0) {
        return "  - {name: " + std::string(name) + ", radius: 0.1, position: [" +
               std::to_string(x) + ", 0, 1], material: " + material + "}\n";
    };
    const std::string warning =
        "t.yaml:3:21: warning: material 'rough' names friction, but it may meet what names none "
        "('smooth'), and between them there will be none; give both a friction, or name it in "
        "'pairs'\n";
    EXPECT_EQ(errors_of(head + floor + "balls:\n" + ball("smooth")), warning);
    EXPECT_EQ(errors_of(head + floor + "balls:\n" + ball("rough")), "");
    EXPECT_EQ(errors_of(head + "balls:\n" + ball("smooth") + ball("rough", "b", 1)), warning);
    EXPECT_EQ(errors_of(head + floor + "pairs: [{between: [smooth, rough], friction: 0.1}]\n" +
                        "balls:\n" + ball("smooth")),
              "");
    // Surfaces do not meet each other.
    EXPECT_EQ(errors_of(head + "surfaces: [{name: f, plane: {}, material: rough}, {name: g, plane: "
                               "{offset: -1}, material: smooth}]\n"),
              "");
}

TEST(Warnings, KeysThatTheMethodDoesNotRead) {
    const auto warnings = [](const std::string& simulation) {
        return errors_of("carom: 1\nsimulation: {" + simulation + "}\n");
    };
    EXPECT_EQ(
        warnings("step: 0.001"),
        "t.yaml:2:20: warning: 'step' is read by the method 'fixed' only, and this scene's is "
        "'exact'\n");
    EXPECT_EQ(warnings("method: exact, solver: quick"),
              "t.yaml:2:37: warning: 'solver' is read by the method 'fixed' only, and this scene's "
              "is 'exact'\n");
    EXPECT_EQ(warnings("method: fixed, iterations: 7"),
              "t.yaml:2:41: warning: 'iterations' is read by the solver 'quick' only, and this "
              "scene's is 'world'\n");
    // The defaults, written out, say nothing of their own.
    EXPECT_EQ(warnings("method: exact, step: 0.00025, solver: world, iterations: 20"), "");
    EXPECT_EQ(warnings("method: fixed, step: 0.001, solver: quick, iterations: 7"), "");
}

}  // namespace
}  // namespace carom
