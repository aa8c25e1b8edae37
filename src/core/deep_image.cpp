#include "core/deep_image.h"

#include <algorithm>

namespace carom {

namespace {

constexpr unsigned kStep = 257;  // 65535 / 255: one step of 8 bits in steps of 16

}  // namespace

DeepImage deepened(const Image& image) {
    DeepImage deep(image.width_px, image.height_px);
    std::transform(image.bgra.begin(), image.bgra.end(), deep.bgra.begin(),
                   [](std::uint8_t v) { return static_cast<std::uint16_t>(v * kStep); });
    return deep;
}

Image flattened(const AnyImage& image) {
    if (const auto* flat = std::get_if<Image>(&image)) return *flat;
    const auto& deep = std::get<DeepImage>(image);
    Image flat(deep.width_px, deep.height_px);
    std::transform(deep.bgra.begin(), deep.bgra.end(), flat.bgra.begin(), [](std::uint16_t v) {
        return static_cast<std::uint8_t>((v + kStep / 2) / kStep);
    });
    return flat;
}

}  // namespace carom
