// PNGs of whole numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace carom {

/// The bytes of a grey PNG of 16 bits, which says nothing of colours: `values` row by row from the
/// top. Failure(kOutput) with libpng's text.
std::string encode_gray16(int width_px, int height_px, const std::vector<std::uint16_t>& values);

}  // namespace carom
