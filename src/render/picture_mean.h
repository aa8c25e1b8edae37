// The mean of several pictures in linear light, where they differ: motion blur.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "render/gl.h"
#include "render/srgb.h"
#include "render/tile_mask.h"

namespace carom {

/// Sums pictures by the processor, in whole numbers: light comes in steps of 2^-24 of white, and so
/// hundreds of pictures leave no steps. (By shaders it takes as long, and they have to be
/// compiled.)
class PictureMean {
  public:
    static constexpr int kMost = 128;  ///< pictures of one mean

    PictureMean();

    /// Begins a mean of `count` pictures, in the parts of a mask.
    void begin(std::vector<TileMask::Part> parts, int count);
    const std::vector<TileMask::Part>& parts() const { return parts_; }
    /// Adds what is in a framebuffer.
    void add(const Gl& gl, const GlFramebuffer& picture);
    /// Writes the mean into its tiles of a picture, encoded as it has come.
    void write(Image& picture) const;

  private:
    std::array<std::uint32_t, 256> light_{}, opacity_{};  ///< of a code
    SrgbEncoder encode_;
    std::vector<TileMask::Part> parts_;
    int count_ = 1, added_ = 0;
    std::vector<std::uint32_t> sums_;  ///< four a pixel, tile after tile
    std::vector<std::uint8_t> read_;
};

}  // namespace carom
