// PNG files through libpng.
#pragma once

#include <string>

#include "core/image.h"

namespace carom {

/// Compression against time; pixels are the same.
enum class PngEffort { kFast, kSmall };

/// Writes `image` (alpha only where a pixel is not opaque) to `path`, whole or not at all.
/// Replaces an existing file: whether that is allowed is decided before drawing (OutputFile).
void write_png(const std::string& path, const Image& image, PngEffort effort = PngEffort::kFast);

/// The encoded bytes, for standard output.
std::string encode_png(const Image& image, PngEffort effort = PngEffort::kFast);

/// Throws Failure(kInput) when the file is missing or no PNG.
Image read_png(const std::string& path);

}  // namespace carom
