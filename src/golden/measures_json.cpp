#include "golden/measures_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace

void put_measures(Json& json, const ImageMeasures& m) {
    json["same_size"] = m.same_size;
    json["largest"] = m.largest;
    json["differing_pixels"] = m.differing;
    json["pixels"] = m.pixels;
    json["differing_fraction"] = m.differing_fraction();
    json["psnr_db"] = finite_or_null(m.psnr_db);
    json["psnr_luma_db"] = finite_or_null(m.psnr_luma_db);
    json["ssim"] = m.ssim;
}

Json limits_json(const ImageTolerance& limits) {
    return {{"tolerance", limits.channel}, {"max_differing", limits.differing}};
}

}  // namespace carom
