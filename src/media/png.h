// PNG files through libpng.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/deep_image.h"
#include "core/image.h"
#include "media/output_file.h"

namespace carom {

/// Compression against time; pixels are the same. kFast: Z_RLE after the sub filter, for frames.
/// kSmall: level 9, the filter chosen row by row, for goldens and stills.
enum class PngEffort { kFast, kSmall };

/// What a PNG says besides its pixels.
struct PngNotes {
    double pixels_per_m = 0;  ///< physical size (pHYs); 0 for none
    /// Keywords and texts (tEXt; iTXt where not ASCII).
    std::vector<std::pair<std::string, std::string>> texts;
};

/// Writes `image` (alpha only where a pixel is not opaque) to `path`, whole or not at all.
/// Tagged as sRGB. PNG's alpha is straight: a premultiplied channel survives the way there and back
/// exactly. Throws Failure(kOutput).
void write_png(const std::string& path, const Image& image, PngEffort effort = PngEffort::kFast,
               Durability durability = Durability::kSynced, Existing existing = Existing::kReplace,
               const PngNotes& notes = {});

/// The encoded bytes, for standard output.
std::string encode_png(const Image& image, PngEffort effort = PngEffort::kFast,
                       const PngNotes& notes = {});

/// True where the file at `path` is, as far as its checksums tell, the PNG that write_png() or
/// PngEncoder makes of a picture of this size with these notes: its head is the same byte for byte,
/// and behind it nothing is missing, damaged or too much. Pixels are not decoded.
bool is_whole_png(const std::string& path, int width_px, int height_px, const PngNotes& notes);

/// Encodes frame after frame as kFast does, with the same bytes, and works only on the rows that
/// differ from the frame before. Keeps one picture.
class PngEncoder {
  public:
    PngEncoder();
    ~PngEncoder();
    std::string encode(const Image& image, const PngNotes& notes = {});

  private:
    std::unique_ptr<class PngRows> rows_;
};

/// Any PNG (grey, palette, 1 to 16 bits, transparent, interlaced) in the depth that it has: 8 bits
/// for up to 8, else 16; premultiplied. Samples are taken as sRGB, unless a gAMA chunk without an
/// sRGB or iCCP chunk beside it says otherwise by more than 15 %: then v becomes the sRGB value of
/// the light v^(1 / gAMA) (PNG, third edition, 12.13), rounded. Colour profiles and chromaticities
/// are not applied. Throws Failure(kInput) with libpng's text when the file is missing, damaged, no
/// PNG, or larger than 100 megapixels.
AnyImage read_any_png(const std::string& path);

/// The same in 8 bits, rounded to the nearest.
Image read_png(const std::string& path);

}  // namespace carom
