// The rows of the table that describe materials and pairs of them.
#include "scene/keys.h"

namespace carom {

namespace {

constexpr Range kCoefficient = between(0, 1e6);
constexpr Range kSpeed = between(0, 1e9);

// What a material says of itself and a pair may say of two.
KeySpec restitution(Section section, std::string_view fallback, std::string_view doc,
                    std::string_view example) {
    return {.section = section,
            .key = "restitution",
            .forms = form::kNumber | form::kMap,
            .child = Section::kRestitution,
            .range = between(0, 1),
            .fallback_doc = fallback,
            .doc = doc,
            .example = example};
}

KeySpec coefficient(Section section, std::string_view key, std::string_view fallback,
                    std::string_view doc, std::string_view example) {
    return {.section = section,
            .key = key,
            .forms = form::kNumber,
            .range = kCoefficient,
            .fallback_doc = fallback,
            .doc = doc,
            .example = example};
}

KeySpec pivoting(Section section, std::string_view fallback, std::string_view doc) {
    return {.section = section,
            .key = "pivoting",
            .forms = form::kNumber,
            .range = between(0, 1e9),
            .unit = "m",
            .fallback_doc = fallback,
            .doc = doc,
            .example = "0.0005"};
}

KeySpec tangential(Section section, std::string_view fallback, std::string_view doc) {
    return {.section = section,
            .key = "tangential_restitution",
            .forms = form::kNumber,
            .range = between(-1, 1),
            .fallback_doc = fallback,
            .doc = doc,
            .example = "0.2"};
}

}  // namespace

std::vector<KeySpec> material_keys() {
    using enum Section;
    using namespace form;
    return {
        restitution(
            kMaterial, "1",
            "Coefficient against a rigid body: separation speed over approach speed; a number, "
            "or how it depends on the approach speed.",
            "0.85"),
        {.section = kMaterial,
         .key = "virtual_body",
         .forms = kMap,
         .child = kVirtualBody,
         .fallback_doc = "none",
         .doc = "The paper's x and v instead of a coefficient.",
         .example = "{distance: 0.42, velocity: 5.0}"},
        coefficient(kMaterial, "friction", "none, which counts as 0",
                    "Coulomb's coefficient against a reference of 1.", "0.6"),
        coefficient(
            kMaterial, "rolling", "none, which counts as 0",
            "Rolling resistance against a reference of 1: a ball that rolls slows by this times "
            "N/m. It needs friction.",
            "0.01"),
        pivoting(
            kMaterial, "0",
            "Moment against spin about the normal, over the normal force; those of a pair add."),
        tangential(kMaterial, "none",
                   "After an impact that grips, the slip is minus this times that before. It needs "
                   "friction."),

        {.section = kRestitution,
         .key = "speed",
         .forms = kNumbers,
         .range = kSpeed,
         .unit = "m/s",
         .fallback_doc = "none",
         .doc = "Approach speeds, increasing; the coefficient is constant beyond both ends.",
         .example = "[2, 7, 20]"},
        {.section = kRestitution,
         .key = "value",
         .forms = kNumbers,
         .range = between(0, 1),
         .fallback_doc = "none",
         .doc = "The coefficients there; a monotone cubic between them.",
         .example = "[0.8, 0.75, 0.6]"},
        {.section = kRestitution,
         .key = "power",
         .forms = kMap,
         .child = kPowerRestitution,
         .fallback_doc = "none",
         .doc = "A power of the approach speed.",
         .example = "{value: 0.9, at_speed: 1.0, exponent: 0.25}"},
        {.section = kRestitution,
         .key = "viscoelastic",
         .forms = kMap,
         .child = kViscoelasticRestitution,
         .fallback_doc = "none",
         .doc = "Viscoelastic spheres.",
         .example = "{gamma: 0.1}"},
        {.section = kPowerRestitution,
         .key = "value",
         .forms = kNumber,
         .range = above_up_to(0, 1),
         .required = true,
         .doc = "The coefficient at `at_speed`.",
         .example = "0.9"},
        {.section = kPowerRestitution,
         .key = "at_speed",
         .forms = kNumber,
         .range = between(1e-9, 1e9),
         .unit = "m/s",
         .fallback = 1.0,
         .doc = "The approach speed that `value` is for.",
         .example = "1.0"},
        {.section = kPowerRestitution,
         .key = "exponent",
         .forms = kNumber,
         .range = {.min = -10, .max = 1, .below_max = true},
         .required = true,
         .doc = "How fast it falls; below 0 it grows. 0.25 in the fully plastic limit.",
         .example = "0.25"},
        {.section = kViscoelasticRestitution,
         .key = "gamma",
         .forms = kNumber,
         .range = between(0, 1e6),
         .unit = "(s/m)^(1/5)",
         .required = true,
         .doc = "What the bodies lose at 1 m/s, to first order.",
         .example = "0.1"},

        {.section = kVirtualBody,
         .key = "distance",
         .forms = kNumber,
         .range = between(0, 1e9),
         .unit = "m",
         .required = true,
         .doc = "x: how far the virtual body's surface lies below the real one; 0 loses nothing.",
         .example = "0.42"},
        {.section = kVirtualBody,
         .key = "velocity",
         .forms = kNumber,
         .range = kCoordinate,
         .unit = "m/s",
         .required = true,
         .doc = "v: the speed of that surface; above 0 where `distance` is.",
         .example = "5.0"},

        {.section = kPair,
         .key = "between",
         .forms = kReferences,
         .count = 2,
         .refers_to = NameKind::kMaterial,
         .required = true,
         .doc = "The two materials; they may be the same.",
         .example = "[rubber, steel]"},
        restitution(kPair, "the product", "Coefficient of the pair.", "0.8"),
        coefficient(kPair, "friction", "the product", "Coulomb's coefficient of the pair.", "0.5"),
        coefficient(kPair, "rolling", "the product", "Rolling resistance of the pair.", "0.01"),
        pivoting(kPair, "the sum", "Resistance against spin about the normal."),
        tangential(kPair, "the product of those that are named",
                   "Tangential restitution of the pair."),
    };
}

}  // namespace carom
