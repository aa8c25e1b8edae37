// PNG files through libpng.
#pragma once

#include <string>

#include "core/image.h"
#include "media/output_file.h"

namespace carom {

/// Compression against time; pixels are the same. kFast: Z_RLE after the sub filter, for frames.
/// kSmall: level 9, the filter chosen row by row, for goldens and stills.
enum class PngEffort { kFast, kSmall };

/// Writes `image` (alpha only where a pixel is not opaque) to `path`, whole or not at all.
/// Tagged as sRGB. PNG's alpha is straight: a premultiplied channel survives the way there and back
/// exactly. Throws Failure(kOutput).
void write_png(const std::string& path, const Image& image, PngEffort effort = PngEffort::kFast,
               Durability durability = Durability::kSynced, Existing existing = Existing::kReplace);

/// The encoded bytes, for standard output.
std::string encode_png(const Image& image, PngEffort effort = PngEffort::kFast);

/// Any PNG (grey, palette, 16 bits, transparent, interlaced) as 8-bit premultiplied BGRA. Samples
/// are taken as sRGB, whatever gamma the file names. Throws Failure(kInput) with libpng's text when
/// the file is missing, damaged, no PNG, or larger than 100 megapixels.
Image read_png(const std::string& path);

}  // namespace carom
