// The rows of the table that describe the air, and how balls fly in it.
#include "scene/keys.h"

namespace carom {

namespace {

constexpr Range kWind = between(-1e4, 1e4);
constexpr Range kCoefficient = between(0, 1e3);

std::vector<KeySpec> rows_of_air() {
    using enum Section;
    using namespace form;
    return {
        {.section = kScene,
         .key = "air",
         .forms = kMap,
         .child = kAir,
         .fallback_doc = "none: a vacuum",
         .doc = "The air that balls fly in.",
         .example = "{density: 1.225}"},
        {.section = kAir,
         .key = "density",
         .forms = kNumber,
         .range = between(0, 1e4),
         .unit = "kg/m^3",
         .fallback_doc = "1.225, or what the three below say",
         .doc = "Density.",
         .example = "1.225"},
        {.section = kAir,
         .key = "temperature_c",
         .forms = kNumber,
         .range = between(-90, 60),
         .unit = "degrees Celsius",
         .fallback_doc = "15 beside one of the two below",
         .doc = "Temperature, from which density and viscosity follow.",
         .example = "20"},
        {.section = kAir,
         .key = "pressure_pa",
         .forms = kNumber,
         .range = between(0, 1e7),
         .unit = "Pa",
         .fallback_doc = "101325 beside one of the others",
         .doc = "Pressure, from which the density follows.",
         .example = "101325"},
        {.section = kAir,
         .key = "humidity",
         .forms = kNumber,
         .range = between(0, 1),
         .fallback_doc = "0 beside one of the others",
         .doc = "Relative humidity, 0 to 1, from which the density follows.",
         .example = "0.6"},
        {.section = kAir,
         .key = "viscosity",
         .forms = kNumber,
         .range = above_up_to(0, 1e6),
         .unit = "Pa s",
         .fallback_doc = "1.81e-5, or what the temperature says",
         .doc = "Dynamic viscosity, which Reynolds numbers take.",
         .example = "1.81e-5"},
        {.section = kAir,
         .key = "wind",
         .forms = kNumbers,
         .count = 3,
         .range = kWind,
         .unit = "m/s",
         .fallback = {0.0, 0.0, 0.0},
         .doc = "Velocity of the air.",
         .example = "[3, 0, 0]"},
        {.section = kAir,
         .key = "buoyancy",
         .forms = kBool,
         .fallback = true,
         .doc = "Whether the air lifts a ball by the weight of what it displaces.",
         .example = "false"},
    };
}

std::vector<KeySpec> rows_of_balls() {
    using enum Section;
    using namespace form;
    return {
        {.section = kBall,
         .key = "drag",
         .forms = kNumber | kWord | kMap,
         .child = kDragTable,
         .words = {"sphere"},
         .range = kCoefficient,
         .fallback_doc = "the preset's, or `sphere`",
         .in_defaults = true,
         .doc = "Drag coefficient C_D in air: a number, `sphere` for a smooth sphere's curve over "
                "the Reynolds number, or a table.",
         .example = "0.507"},
        {.section = kBall,
         .key = "lift",
         .forms = kNumber | kWord | kMap,
         .child = kLiftTable,
         .words = {"spin_ratio", "tennis", "baseball"},
         .range = kCoefficient,
         .fallback_doc = "none",
         .in_defaults = true,
         .doc = "Lift coefficient C_L in air, along spin x velocity: a number, a curve of the spin "
                "ratio S = r spin / speed by name (`spin_ratio` is S itself, `tennis` 1/(2 + 1/S), "
                "`baseball` 1.12 S/(0.583 + 2.333 S)), or a table over S.",
         .example = "spin_ratio"},
        {.section = kBall,
         .key = "spin_decay_s",
         .forms = kNumber,
         .range = between(1e-3, 1e9),
         .unit = "s",
         .fallback_doc = "none: the spin lasts",
         .in_defaults = true,
         .doc = "Time in which the spin falls to 1/e while the ball flies in air.",
         .example = "30"},

        {.section = kDragTable,
         .key = "speed",
         .forms = kNumbers,
         .range = between(0, 1e6),
         .unit = "m/s",
         .fallback_doc = "this or `reynolds`",
         .doc = "Speeds through the air, increasing.",
         .example = "[5, 10, 15, 20]"},
        {.section = kDragTable,
         .key = "reynolds",
         .forms = kNumbers,
         .range = between(0, 1e12),
         .fallback_doc = "this or `speed`",
         .doc = "Reynolds numbers of the ball's diameter, increasing.",
         .example = "[1.0e5, 2.0e5, 4.0e5]"},
        {.section = kDragTable,
         .key = "value",
         .forms = kNumbers,
         .range = kCoefficient,
         .required = true,
         .doc = "C_D at each; monotone cubics between them, constant beyond.",
         .example = "[0.5, 0.45, 0.19, 0.16]"},
        {.section = kLiftTable,
         .key = "spin",
         .forms = kNumbers,
         .range = between(0, 1e6),
         .required = true,
         .doc = "Spin ratios S, increasing.",
         .example = "[0, 0.1, 0.2, 0.4]"},
        {.section = kLiftTable,
         .key = "value",
         .forms = kNumbers,
         .range = between(-1e3, 1e3),
         .required = true,
         .doc = "C_L at each; monotone cubics between them, constant beyond.",
         .example = "[0, 0.16, 0.23, 0.33]"},
    };
}

}  // namespace

std::vector<KeySpec> air_keys() {
    std::vector<KeySpec> rows = rows_of_air();
    for (KeySpec& row : rows_of_balls()) rows.push_back(std::move(row));
    return rows;
}

}  // namespace carom
