// The mean of several pictures in linear light, where they differ: motion blur.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "render/gl/gl.h"
#include "render/tile/tile_mask.h"

namespace carom {

/// Sums pictures by the processor, in whole numbers: light comes in steps of 2^-24 of white, and so
/// hundreds of pictures leave no steps. (By shaders it takes as long, and they have to be
/// compiled.)
class PictureMean {
  public:
    static constexpr int kMost = 128;  ///< pictures of one mean

    PictureMean();

    /// Forgets all parts.
    void clear() { sums_.clear(); }
    /// Begins the mean of `count` pictures in other parts of the picture than before.
    void begin(std::vector<TileMask::Part> parts, int count);
    /// Adds what is in a framebuffer to the mean that was begun last.
    void add(const Gl& gl, const GlFramebuffer& picture);
    /// Writes all means into their tiles of a picture, encoded as they have come.
    void write(Image& picture) const;

  private:
    std::array<std::uint32_t, 256> light_{}, opacity_{};  ///< of a code
    struct Sum {
        std::vector<TileMask::Part> parts;
        int count, added;
        std::vector<std::uint32_t> light;  ///< four a pixel, tile after tile
    };
    std::vector<Sum> sums_;
    std::vector<std::uint8_t> read_;
};

}  // namespace carom
