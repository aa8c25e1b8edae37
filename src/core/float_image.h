// A picture of numbers in memory.
#pragma once

#include <cstddef>
#include <vector>

namespace carom {

/// 32-bit floats, `channels` of them a pixel beside each other, rows from the top.
struct FloatImage {
    int width_px = 0;
    int height_px = 0;
    int channels = 1;
    std::vector<float> values;  ///< height_px * width_px * channels

    FloatImage() = default;
    FloatImage(int width, int height, int channels_a_pixel)
        : width_px(width),
          height_px(height),
          channels(channels_a_pixel),
          values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                 static_cast<std::size_t>(channels_a_pixel)) {}

    float* at(int x, int y) { return values.data() + place(x, y); }
    const float* at(int x, int y) const { return values.data() + place(x, y); }

  private:
    std::size_t place(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
    }
};

}  // namespace carom
