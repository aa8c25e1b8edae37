// The rows of the table that describe a sweep's file.
#include "scene/keys.h"

namespace carom {

namespace {

std::vector<KeySpec> top_keys() {
    using enum Section;
    using namespace form;
    return {
        {.section = kSweep,
         .key = "carom",
         .forms = kInteger,
         .range = between(1, 1),
         .fallback = 1,
         .doc = "Version of the format.",
         .example = "1"},
        {.section = kSweep,
         .key = "base",
         .forms = kText,
         .required = true,
         .doc = "The scene that all runs begin with, as seen from the folder of this file. It has "
                "to be valid by itself.",
         .example = "drop.yaml"},
        {.section = kSweep,
         .key = "axes",
         .forms = kPaths,
         .child = kSweepDraw,
         .fallback_doc = "none",
         .doc = "What differs between runs: from paths, as those of --set, to a list of values, a "
                "range or a draw. One value alone is the same in all runs.",
         .example = "{balls.a.mass: [0.5, 1, 2]}"},
        {.section = kSweep,
         .key = "mode",
         .forms = kWord,
         .words = {"grid", "zip", "lhs", "random"},
         .fallback = "grid",
         .doc = "`grid`: every value of each axis with every value of the others, the last axis "
                "changing fastest; `zip`: the first values together, the second ones, and so on; "
                "`lhs`: a Latin hypercube, in which each axis is cut into `count` parts of equal "
                "probability and each part is met once; `random`: `count` independent draws.",
         .example = "random"},
        {.section = kSweep,
         .key = "count",
         .forms = kInteger,
         .range = between(1, 1e7),
         .fallback_doc = "as the axes say",
         .doc = "How many runs the modes `lhs` and `random` make. More of `random` leave the first "
                "ones as they are.",
         .example = "1000"},
        {.section = kSweep,
         .key = "seed",
         .forms = kInteger,
         .range = between(0, 9007199254740991.0),
         .fallback = 0,
         .doc = "What all that is drawn depends on, besides the run's number and the path.",
         .example = "7"},
        {.section = kSweep,
         .key = "random",
         .forms = kMap,
         .child = kSweepRandom,
         .fallback_doc = "none",
         .doc = "What is drawn anew for each run: balls at places without overlap, and a camera.",
         .example = "{camera: {distance: 3}}"},
        {.section = kSweep,
         .key = "outputs",
         .forms = kMap,
         .child = kSweepOutputs,
         .fallback_doc = "none: the table of results alone",
         .doc = "The files of each run.",
         .example = "{motion: true, film: mp4}"},
        {.section = kSweep,
         .key = "results",
         .forms = kNamedTexts,
         .fallback_doc = "none",
         .doc = "Columns of index.csv: from names to expressions.",
         .example = "{top: 'peak(\"a\", 1)'}"},
    };
}

std::vector<KeySpec> output_keys() {
    using enum Section;
    using namespace form;
    const auto flag = [](std::string_view key, std::string_view doc) {
        return KeySpec{.section = kSweepOutputs,
                       .key = key,
                       .forms = kBool,
                       .fallback = false,
                       .doc = doc,
                       .example = "true"};
    };
    return {
        flag("motion", "`motion.csv`, with film.fps rows per second."),
        flag("events", "`events.csv`."),
        flag("stats",
             "`stats.json`: what --stats writes of the simulation, without times and memory."),
        flag("scene", "`scene.yaml`: the run's scene with all that was set and drawn."),
        flag("frames", "`frames/frame_00000.png` and so on."),
        {.section = kSweepOutputs,
         .key = "film",
         .forms = kBool | kWord,
         .words = {"mp4", "mkv", "webm", "mov", "gif", "apng", "webp", "y4m"},
         .fallback = false,
         .doc = "`film.mp4`, or of another kind.",
         .example = "mp4"},
        {.section = kSweepOutputs,
         .key = "quality",
         .forms = kWord,
         .words = {"draft", "medium", "high"},
         .fallback = "medium",
         .doc = "How the film is coded, as --quality.",
         .example = "high"},
        {.section = kSweepOutputs,
         .key = "stills",
         .forms = kBool | kNumbers,
         .range = at_least(0),
         .unit = "s",
         .fallback = false,
         .doc = "`still_000.png` and so on at these instants; `true`: at those of film.stills.",
         .example = "[0.5, 1.2]"},
        {.section = kSweepOutputs,
         .key = "layers",
         .forms = kTexts,
         .fallback_doc = "none",
         .doc = "Layers of each frame in `frames/`, of depth, distance, segmentation, normals, "
                "flow, backflow and coordinates.",
         .example = "[depth, segmentation]"},
    };
}

KeySpec pair_of_numbers(std::string_view key, std::string_view doc, std::string_view example) {
    return {.section = Section::kSweepDraw,
            .key = key,
            .forms = form::kNumbers,
            .count = 2,
            .fallback_doc = "none",
            .doc = doc,
            .example = example};
}

std::vector<KeySpec> draw_keys() {
    using enum Section;
    using namespace form;
    return {
        {.section = kSweepDraw,
         .key = "from",
         .forms = kNumber,
         .fallback_doc = "none",
         .doc = "First value of a range.",
         .example = "0.5"},
        {.section = kSweepDraw,
         .key = "to",
         .forms = kNumber,
         .fallback_doc = "none",
         .doc = "Last value of a range.",
         .example = "2"},
        {.section = kSweepDraw,
         .key = "steps",
         .forms = kInteger,
         .range = between(1, 1e7),
         .fallback_doc = "none",
         .doc = "How many values a range has, both ends among them. They are rounded to 15 digits.",
         .example = "4"},
        {.section = kSweepDraw,
         .key = "scale",
         .forms = kWord,
         .words = {"linear", "log"},
         .fallback = "linear",
         .doc = "`linear`: values of a range differ by the same amount; `log`: by the same factor.",
         .example = "log"},
        pair_of_numbers("uniform", "Equally likely from the first number up to the second.",
                        "[0.5, 2]"),
        pair_of_numbers("log_uniform",
                        "The same of the logarithm: each factor is equally likely. Above 0.",
                        "[0.01, 1]"),
        pair_of_numbers("normal", "Normal, of this mean and standard deviation.", "[1, 0.1]"),
        pair_of_numbers("integer", "Whole numbers, equally likely, both ends among them.",
                        "[1, 6]"),
        {.section = kSweepDraw,
         .key = "choice",
         .forms = kValues,
         .fallback_doc = "none",
         .doc = "One of these values.",
         .example = "[rubber, steel]"},
        {.section = kSweepDraw,
         .key = "weights",
         .forms = kNumbers,
         .range = at_least(0),
         .fallback_doc = "all equal",
         .doc = "How likely each value of `choice` is, against the others.",
         .example = "[3, 1]"},
        pair_of_numbers("within", "`normal` is cut off outside of these bounds.", "[0.5, 1.5]"),
        {.section = kSweepDraw,
         .key = "draws",
         .forms = kInteger,
         .range = between(1, 1e7),
         .fallback_doc = "1",
         .doc = "How many values are drawn in the modes `grid` and `zip`.",
         .example = "10"},
    };
}

KeySpec camera_number(std::string_view key, std::string_view unit, std::string_view doc,
                      std::string_view example, std::string_view fallback) {
    return {.section = Section::kSweepCamera,
            .key = key,
            .forms = form::kNumber | form::kMap,
            .child = Section::kSweepDraw,
            .unit = unit,
            .fallback_doc = fallback,
            .doc = doc,
            .example = example};
}

KeySpec corner(std::string_view key, std::string_view example) {
    return {.section = Section::kSweepBox,
            .key = key,
            .forms = form::kNumbers,
            .count = 3,
            .unit = "m",
            .required = true,
            .doc = "A corner of the box.",
            .example = example};
}

std::vector<KeySpec> random_keys() {
    using enum Section;
    using namespace form;
    return {
        {.section = kSweepRandom,
         .key = "balls",
         .forms = kMaps,
         .child = kSweepBalls,
         .fallback_doc = "none",
         .doc = "Groups of balls, which are added to those of the base.",
         .example =
             "[{count: 5, region: {from: [-1, -1, 0], to: [1, 1, 2]}, each: {radius: 0.1}}]"},
        {.section = kSweepRandom,
         .key = "camera",
         .forms = kMap,
         .child = kSweepCamera,
         .fallback_doc = "the base's",
         .doc = "A camera on a sphere around a point.",
         .example = "{distance: 3, azimuth_deg: {uniform: [0, 360]}}"},
        {.section = kSweepBalls,
         .key = "name",
         .forms = kName,
         .fallback = "random",
         .doc = "The balls are NAME_0, NAME_1 and so on.",
         .example = "marble"},
        {.section = kSweepBalls,
         .key = "count",
         .forms = kInteger | kMap,
         .child = kSweepDraw,
         .range = between(0, 100'000),
         .required = true,
         .doc = "How many balls.",
         .example = "{integer: [3, 12]}"},
        {.section = kSweepBalls,
         .key = "region",
         .forms = kMap,
         .child = kSweepBox,
         .required = true,
         .doc = "The box that each ball lies in as a whole at the start.",
         .example = "{from: [-1, -1, 0], to: [1, 1, 2]}"},
        {.section = kSweepBalls,
         .key = "gap",
         .forms = kNumber,
         .range = between(0, 1e5),
         .unit = "m",
         .fallback = 0.001,
         .doc = "At least so far from all other bodies at the start.",
         .example = "0.01"},
        {.section = kSweepBalls,
         .key = "attempts",
         .forms = kInteger,
         .range = between(1, 1'000'000),
         .fallback = 1000,
         .doc = "Places tried for a ball, before the run fails for want of room.",
         .example = "5000"},
        {.section = kSweepBalls,
         .key = "each",
         .forms = kPaths,
         .child = kSweepDraw,
         .required = true,
         .doc = "From keys of `balls[]`, or paths below, to a value or a draw for each ball. "
                "`radius` or `preset` must be among them.",
         .example = "{radius: {uniform: [0.05, 0.1]}, \"velocity[0]\": {normal: [0, 1]}}"},
        corner("from", "[-1, -1, 0]"),
        corner("to", "[1, 1, 2]"),
        {.section = kSweepCamera,
         .key = "to",
         .forms = kNumbers,
         .count = 3,
         .unit = "m",
         .fallback = {0, 0, 0},
         .doc = "The point that it looks at.",
         .example = "[0, 0, 0.5]"},
        camera_number("distance", "m", "From that point.", "{uniform: [3, 5]}", ""),
        camera_number("azimuth_deg", "degrees", "About z, from x towards y.", "{uniform: [0, 360]}",
                      "`-90`"),
        camera_number("elevation_deg", "degrees", "Above the level of that point, below 90.",
                      "{uniform: [5, 30]}", "`10`"),
        camera_number("fov_deg", "degrees", "The vertical field of view.", "{uniform: [30, 50]}",
                      "the base's"),
    };
}

}  // namespace

std::vector<KeySpec> sweep_keys() {
    std::vector<KeySpec> all = top_keys();
    for (auto* rows : {output_keys, draw_keys, random_keys})
        for (KeySpec& row : rows()) all.push_back(std::move(row));
    for (KeySpec& row : all)
        if (row.section == Section::kSweepCamera && row.key == "distance") row.required = true;
    return all;
}

std::vector<Rule> sweep_rules() {
    return {{Section::kSweepDraw,
             Rule::Kind::kExactlyOne,
             {"from", "uniform", "log_uniform", "normal", "integer", "choice"}}};
}

std::vector<SectionDoc> sweep_section_docs() {
    using enum Section;
    return {
        {kSweep, "sweep", "", "A sweep file is one mapping:"},
        {kSweepDraw, "draw", "axes.PATH",
         "A range of values, or a draw. It stands also below `random`, where it is drawn for each "
         "run, and below `random.balls[].each` for each ball."},
        {kSweepRandom, "random", "random",
         "Each run's own scene. Nothing here depends on the axes, on other runs or on how many "
         "there are."},
        {kSweepBalls, "random_balls", "random.balls[]",
         "Balls at places that are drawn until one is free."},
        {kSweepBox, "region", "random.balls[].region", "A box along the axes."},
        {kSweepCamera, "random_camera", "random.camera",
         "Takes the place of the base's `camera.from` and `camera.to`."},
        {kSweepOutputs, "outputs", "outputs", "The files in each run's folder."},
    };
}

}  // namespace carom
