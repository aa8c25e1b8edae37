// Measures of two pictures in words.
#pragma once

#include <string>

#include "core/image_measures.h"

namespace carom {

/// "largest difference 5 of 255, 20 of 1000 pixels (2.0000 %) differ, PSNR 31.20 dB, SSIM
/// 0.980000".
std::string measures_text(const ImageMeasures& m);

/// "2 of 255 and 1 % of the pixels".
std::string limits_text(const ImageTolerance& limits);

/// Which limits are missed and by how much: "off by 5, 3 more than the 2 of 255 allowed"; empty
/// where none is.
std::string missed_text(const ImageTolerance& limits, const ImageMeasures& m);

}  // namespace carom
