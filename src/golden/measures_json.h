// Measures of two pictures for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/image_measures.h"

namespace carom {

/// As members of `json`: same_size, largest, differing_pixels, pixels, differing_fraction, psnr_db,
/// psnr_luma_db, ssim. Identical pictures have no PSNR: null.
void put_measures(nlohmann::ordered_json& json, const ImageMeasures& m);

/// {tolerance, max_differing}.
nlohmann::ordered_json limits_json(const ImageTolerance& limits);

}  // namespace carom
