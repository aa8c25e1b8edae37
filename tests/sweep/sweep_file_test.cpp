// What a sweep's file gets wrong, with its place.
#include "sweep/file/sweep_file.h"

#include "scene/schema.h"
#include "sweep_testing.h"

namespace carom {
namespace {

struct Wrong {
    const char* text;
    const char* mistake;  ///< beginning of the first line
};

TEST(SweepFile, NamesLineAndColumnOfEveryMistake) {
    const Wrong cases[] = {
        {"axes: {}\n", "1:1: the key 'base' is missing"},
        {"base: base.yaml\naxis: {}\n", "2:1: unknown key 'axis'; did you mean 'axes'?"},
        {"base: base.yaml\nmode: gird\n", "2:7: 'mode' must be one of grid, zip, lhs, random"},
        {"base: base.yaml\nmode: lhs\n", "2:7: mode lhs wants 'count'"},
        {"base: base.yaml\ncount: 4\n", "2:1: 'count' is for the modes lhs and random"},
        {"base: base.yaml\nseed: -1\n", "2:7: 'seed' must be"},
        {"base: base.yaml\naxes: {balls.b.mass: [1]}\n",
         "2:8: 'balls' has no entry named 'b'; did you mean 'a'?"},
        {"base: base.yaml\naxes: {balls.a.mas: [1]}\n",
         "2:8: unknown key 'mas'; did you mean 'mass'?"},
        {"base: base.yaml\naxes: {balls.a.mass: [1, -1]}\n", "2:26: 'mass' must be"},
        {"base: base.yaml\naxes: {balls.a.mass: {uniform: [-1, 1]}}\n", "2:22: 'mass' must be"},
        {"base: base.yaml\naxes: {balls.a.mass: {uniform: [2, 1]}}\n",
         "2:32: the first bound must not be above the second"},
        {"base: base.yaml\naxes: {balls.a.mass: {from: 1, to: 2}}\n",
         "2:23: 'from' wants 'steps' beside it"},
        {"base: base.yaml\naxes: {balls.a.mass: {from: 0, to: 2, steps: 3, scale: log}}\n",
         "2:29: a range of scale log lies above 0"},
        {"base: base.yaml\naxes: {balls.a.mass: {uniform: [1, 2], normal: [1, 1]}}\n",
         "2:40: 'uniform' and 'normal' cannot stand together"},
        {"base: base.yaml\naxes: {balls.a.mass: {choice: [1, 2], weights: [1]}}\n",
         "2:48: 1 weights for 2 values"},
        {"base: base.yaml\naxes: {balls.a.mass: {normal: [1, 0]}}\n",
         "2:35: a standard deviation is above 0"},
        {"base: base.yaml\naxes: {balls.a.mass: {integer: [1, 2.5]}}\n",
         "2:32: the bounds of integer are whole numbers"},
        {"base: base.yaml\nmode: zip\naxes:\n  balls.a.mass: [1, 2]\n  film.fps: [1, 2, 3]\n",
         "4:3: balls.a.mass has 2 values and another axis 3"},
        {"base: base.yaml\nmode: random\ncount: 2\naxes: {balls.a.mass: {uniform: [1, 2], draws: "
         "2}}\n",
         "4:8: 'draws' of balls.a.mass is for the modes grid and zip"},
        {"base: base.yaml\naxes:\n  balls.a.mass: {from: 1, to: 2, steps: 10000}\n"
         "  balls.a.radius: {from: 1, to: 2, steps: 10000}\n",
         "1:1: this makes 100000000 runs or more"},
        {"base: base.yaml\nresults: {r: peak(\"b\" 1)}\n", "2:14: there is no ball 'b'"},
        {"base: base.yaml\nresults: {r: 'impacts(\"b\")'}\n",
         "2:14: there is no ball or surface 'b'"},
        {"base: base.yaml\nresults: {r: 'energy(\"floor\", 0)'}\n",
         "2:14: there is no ball 'floor'"},
        {"base: base.yaml\nresults: {r: duration = 3}\n", "2:14: not an expression: '='"},
        {"base: base.yaml\nresults:\n  r: peak(\"a\", 1\n", "3:6: not an expression: "},
        {"base: base.yaml\nresults:\n  r: pek(\"a\", 1)\n", "3:6: not an expression: "},
        {"base: base.yaml\nresults: {1r: duration}\n", "2:11: '1r' is not a name"},
        {"base: base.yaml\nresults: {status: duration}\n", "2:11: 'status' is a column already"},
        {"base: base.yaml\naxes: {title: [a, b]}\nresults: {title: duration}\n",
         "3:11: 'title' is a column already"},
        {"base: base.yaml\noutputs: {film: avi}\n", "2:17: 'film' must be true or false or one of"},
        {"base: base.yaml\noutputs: {quality: high}\n", "2:11: 'quality' is of a film"},
        {"base: base.yaml\noutputs: {layers: [dept]}\n", "2:20: there is no layer 'dept'"},
        {"base: base.yaml\nrandom: {balls: [{count: 1, each: {radius: 1}}]}\n",
         "2:18: the key 'region' is missing"},
        {"base: base.yaml\nrandom:\n  balls:\n    - {count: 1.5, region: {from: [0, 0, 0], to: "
         "[1, 1, 1]}, each: {radius: 1}}\n",
         "4:15: 'count' must be"},
        {"base: base.yaml\nrandom:\n  balls:\n    - {count: {uniform: [1, 3]}, region: {from: [0, "
         "0, 0], to: [1, 1, 1]}, each: {radius: 1}}\n",
         "4:15: 'count' must be whole numbers"},
        {"base: base.yaml\nrandom:\n  balls:\n    - {count: 1, region: {from: [0, 0, 0], to: [1, "
         "1, 1]}, each: {mass: 1}}\n",
         "4:66: one of 'radius', 'preset' must stand here"},
        {"base: base.yaml\nrandom:\n  balls:\n    - {count: 1, region: {from: [0, 0, 0], to: [1, "
         "1, 1]}, each: {radius: 1, at: [0, 0]}}\n",
         "4:78: 'at' cannot be set here"},
        {"base: base.yaml\nrandom:\n  balls:\n    - {count: 1, region: {from: [0, 0, 0], to: [1, "
         "1, 1]}, each: {radius: 1, look: blue}}\n",
         ""},  // names are looked up when scenes are built
        {"base: base.yaml\nrandom:\n  balls:\n    - {count: {choice: [1, 1, 2.5, 3, 3]}, region: "
         "{from: [0, 0, 0], to: [1, 1, 1]}, each: {radius: 1}}\n",
         "4:15: 'count' must be whole numbers"},
        {"base: base.yaml\nrandom: {camera: {distance: {choice: [1, -1, 2]}}}\n",
         "2:29: 'distance' must be above 0"},
        {"base: base.yaml\nrandom: {camera: {distance: 1, elevation_deg: {choice: [0, 90, 1]}}}\n",
         "2:47: 'elevation_deg' must be above -90"},
        {"base: base.yaml\nrandom: {camera: {distance: {uniform: [-1, 1]}}}\n",
         "2:29: 'distance' must be above 0"},
    };
    for (const Wrong& one : cases) {
        const std::string mistakes = SweepFiles(one.text).mistakes();
        EXPECT_EQ(mistakes.substr(0, std::string(one.mistake).size()), one.mistake)
            << one.text << mistakes;
    }
}

TEST(SweepFile, ShowsTheBasesMistakesAtTheirPlace) {
    const SweepFiles files("base: base.yaml\n", "carom: 1\nballs: [{name: a, radus: 1}]\n");
    const SweepResult result = files.read();
    ASSERT_FALSE(result.sweep);
    EXPECT_NE(result.diagnostics.items().front().text().find("base.yaml:2:"), std::string::npos);
}

TEST(SweepFile, TellsSweepsApartByWhatTheirRunsDependOn) {
    const auto shared = [](const std::string& text) {
        return SweepFiles(text).sweep().fingerprint;
    };
    const std::string base = "base: base.yaml\n";
    const std::uint64_t plain = shared(base);
    EXPECT_EQ(shared("# words\nbase: base.yaml\n"), plain);
    EXPECT_EQ(shared(base + "axes: {balls.a.mass: [1, 2]}\n"), plain);
    EXPECT_NE(shared(base + "outputs: {motion: true}\n"), plain);
    EXPECT_NE(shared(base + "results: {t: duration}\n"), plain);
    EXPECT_NE(shared(base + "random: {camera: {distance: 3}}\n"), plain);
}

TEST(SweepSchema, NamesEveryKey) {
    const std::string schema = json_schema(FileKind::kSweep);
    const KeyTable table(FileKind::kSweep);
    int keys = 0;
    for (const SectionDoc& doc : table.sections())
        for (const KeySpec* spec : table.keys(doc.section)) {
            EXPECT_NE(schema.find("\"" + std::string(spec->key) + "\""), std::string::npos);
            ++keys;
        }
    EXPECT_GT(keys, 40);
}

}  // namespace
}  // namespace carom
