// What the pixels of a picture show, in numbers (docs/layers.md).
#pragma once

#include <carom/second_run.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

CAROM_NAMESPACE_BEGIN

/// Numbers for the pixels of a picture, `channels` of them a pixel beside each other, rows from the
/// top; units and channels of each kind are those of its file. Of "segmentation" they are in `ids`,
/// of all others in `values`; the other one is empty.
struct Layer {
    std::string name;
    int width = 0, height = 0, channels = 1;
    std::vector<float> values{};
    std::vector<std::uint16_t> ids{};
};

/// The layers `names` ("depth", "distance", "segmentation", "normals", "flow", "backflow",
/// "coordinates"; each at most once) of an instant [s], in the order asked for and with the values
/// of `carom still --layers`. Flow goes to the instant a frame's time away. Of `against` the camera
/// knows alone. Needs neither OpenGL nor OpenEXR. Throws Error for an unknown name, for an instant
/// outside of the motion, and for two runs side by side.
CAROM_API std::vector<Layer> layers(const Scene& scene, const Motion& motion, double time,
                                    const std::vector<std::string>& names,
                                    const std::optional<Against>& against = {});

CAROM_NAMESPACE_END
