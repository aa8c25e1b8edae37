#include "golden/measures_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace carom {

namespace {

using OrderedJson = nlohmann::ordered_json;

/// JSON has no infinity.
OrderedJson finite_or_null(double value) {
    return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

}  // namespace

void put_measures(OrderedJson& json, const ImageMeasures& m) {
    json["same_size"] = m.same_size;
    json["largest"] = m.largest;
    json["differing_pixels"] = m.differing;
    json["pixels"] = m.pixels;
    json["differing_fraction"] = m.differing_fraction();
    json["psnr_db"] = finite_or_null(m.psnr_db);
    json["psnr_luma_db"] = finite_or_null(m.psnr_luma_db);
    json["ssim"] = m.ssim;
}

OrderedJson limits_json(const ImageTolerance& limits) {
    return {{"tolerance", limits.channel}, {"max_differing", limits.differing}};
}

}  // namespace carom
