// OpenEXR files of 32-bit floats.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/float_image.h"
#include "core/pixel_rect.h"

namespace carom {

/// Refuses the work before it is begun: Failure(kRun) that names the package where a
/// library is missing.
void require_openexr();

/// Pictures of one size and kind, one after the other, each as the bytes of an EXR file: tiles of
/// 64 pixels, ZIP without loss. Bytes are the same whatever came before. Keeps the compressed
/// tiles.
class ExrEncoder {
  public:
    /// Of the channels in the order of FloatImage.
    explicit ExrEncoder(std::vector<std::string> channel_names);
    ~ExrEncoder();
    ExrEncoder(ExrEncoder&&) noexcept;

    /// False only where no pixel of the rectangle differs from the picture before.
    using Changed = std::function<bool(const PixelRect&)>;
    /// Failure(kRun) with OpenEXR's text.
    std::string encode(const FloatImage& image, const Changed& changed);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace carom
