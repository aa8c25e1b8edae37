// The rows of the table that describe the shapes of surfaces.
#include "scene/keys.h"

namespace carom {

namespace {

/// A point, which has to be given.
KeySpec point(Section section, std::string_view key, std::string_view doc,
              std::string_view example) {
    return {.section = section,
            .key = key,
            .forms = form::kNumbers,
            .count = 3,
            .range = kCoordinate,
            .unit = "m",
            .required = true,
            .doc = doc,
            .example = example};
}

/// Where the shape stands; the origin where it is left out.
KeySpec centre(Section section, std::string_view doc, std::string_view example) {
    KeySpec row = point(section, "position", doc, example);
    row.required = false;
    row.fallback = {0.0, 0.0, 0.0};
    return row;
}

/// A vector of any length but 0; upwards where it is left out.
KeySpec direction(Section section, std::string_view key, std::string_view doc,
                  std::string_view example) {
    return {.section = section,
            .key = key,
            .forms = form::kNumbers,
            .count = 3,
            .range = kCoordinate,
            .fallback = {0.0, 0.0, 1.0},
            .doc = doc,
            .example = example};
}

/// A length above 0, which has to be given.
KeySpec length(Section section, std::string_view key, std::string_view doc,
               std::string_view example) {
    return {.section = section,
            .key = key,
            .forms = form::kNumber,
            .range = kLength,
            .unit = "m",
            .required = true,
            .doc = doc,
            .example = example};
}

}  // namespace

std::vector<KeySpec> shape_keys() {
    using enum Section;
    using namespace form;
    return {
        direction(kPlane, "normal", "Towards the side where balls live; of any length but 0.",
                  "[0, 0, 1]"),
        {.section = kPlane,
         .key = "offset",
         .forms = kNumber,
         .range = kCoordinate,
         .unit = "m",
         .fallback = 0.0,
         .doc = "normal . p of the plane's points p.",
         .example = "0"},

        centre(kBox, "Centre.", "[0, 0, 1]"),
        {.section = kBox,
         .key = "size",
         .forms = kNumbers,
         .count = 3,
         .range = kLength,
         .unit = "m",
         .required = true,
         .doc = "Full edges along the box's own x, y and z.",
         .example = "[1, 1, 0.001]"},
        {.section = kBox,
         .key = "rotation_deg",
         .forms = kNumbers,
         .count = 3,
         .range = kCoordinate,
         .unit = "degrees",
         .fallback = {0.0, 0.0, 0.0},
         .doc = "Turns about x, then y, then z, the axes fixed.",
         .example = "[0, 30, 0]"},
        {.section = kBox,
         .key = "quaternion",
         .forms = kNumbers,
         .count = 4,
         .range = kCoordinate,
         .fallback_doc = "none",
         .doc = "[w, x, y, z] of any length but 0, instead of rotation_deg.",
         .example = "[1, 0, 0, 0]"},

        centre(kSphere, "Centre.", "[0, 0, 0]"),
        length(kSphere, "radius", "Radius.", "0.5"),

        point(kCapsule, "from", "One end of the segment.", "[0, 0, 0]"),
        point(kCapsule, "to", "The other end; not the same point.", "[1, 0, 0]"),
        length(kCapsule, "radius", "Radius.", "0.05"),

        point(kCylinder, "from", "Middle of one end.", "[0, 0, 0]"),
        point(kCylinder, "to", "Middle of the other end; not the same point.", "[0, 0, 1]"),
        length(kCylinder, "radius", "Radius.", "0.05"),

        centre(kRing, "Centre.", "[0, 0, 3.05]"),
        direction(kRing, "axis", "Across the circle, through its hole; of any length but 0.",
                  "[0, 0, 1]"),
        length(kRing, "radius", "From the centre to the middle of the tube.", "0.2286"),
        length(kRing, "tube_radius", "Radius of the tube, below `radius`.", "0.009"),

        centre(kBowl, "The sphere's centre.", "[0, 0, 1]"),
        length(kBowl, "radius", "The sphere's radius.", "1"),
        direction(kBowl, "opening", "Where the bowl is open; of any length but 0.", "[0, 0, 1]"),
        {.section = kBowl,
         .key = "depth",
         .forms = kNumber,
         .range = kLength,
         .unit = "m",
         .fallback_doc = "the radius: a hemisphere",
         .doc = "Of the rim over the lowest point, along `opening`; at most twice the radius, a "
                "closed sphere.",
         .example = "0.4"},

        point(kPipe, "from", "One end of the axis.", "[0, 0, 0.5]"),
        point(kPipe, "to", "The other end; not the same point.", "[2, 0, 0.5]"),
        length(kPipe, "radius", "Of the wall from the axis.", "0.5"),
        direction(
            kPipe, "opening",
            "Where the pipe is open: what of it lies across the axis counts, and must not be 0 "
            "unless the pipe is a tube.",
            "[0, 0, 1]"),
        {.section = kPipe,
         .key = "angle_deg",
         .forms = kNumber,
         .range = above_up_to(0, 360),
         .unit = "degrees",
         .fallback = 180.0,
         .doc = "Of the wall around the axis; 360 is a tube.",
         .example = "180"},
    };
}

}  // namespace carom
