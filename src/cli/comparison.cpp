#include "cli/comparison.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/readable.h"

namespace carom {

namespace {

bool worse(const ImageDifference& a, const ImageDifference& b) {
    if (a.same_size != b.same_size) return !a.same_size;
    if (a.largest != b.largest) return a.largest > b.largest;
    return a.differing > b.differing;
}

std::string difference_text(const ImageDifference& d) {
    if (!d.same_size) return "the sizes differ";
    return fmt::format(
        "largest difference {} of 255, {:.4f} % of pixels differ, luma PSNR {:.2f} dB", d.largest,
        100 * d.differing_fraction(), d.psnr_luma_db);
}

}  // namespace

void Comparison::fail(const std::string& name, const std::string& why) {
    if (failed_.empty()) first_ = fmt::format("{}: {}", readable(name), why);
    if (failed_.empty() || failed_.back() != name) failed_.push_back(name);
}

void Comparison::add(const std::string& name, const Image& a, const Image& b) {
    const ImageDifference d = compare_images(a, b);
    ++compared_;
    if (!tolerance_.accepts(d)) fail(name, difference_text(d));
    if (worst_ && !worse(d, worst_->difference)) return;
    worst_ = Found{name, d};
    picture_ = d.same_size ? difference_image(a, b) : Image();
}

void Comparison::add_other_time(const std::string& name, double a_s, double b_s) {
    ++other_times_;
    fail(name, fmt::format("shown at {:.6g} s in one, at {:.6g} s in the other", a_s, b_s));
}

void Comparison::add_missing(const std::string& name) {
    ++missing_;
    fail(name, "only in one");
}

std::string Comparison::text() const {
    if (same())
        return fmt::format("same: {} {} compared, worst {}: {}\n", compared_, what_,
                           readable(worst_->name), difference_text(worst_->difference));
    std::string counts =
        fmt::format("{} of {} {} differ", failed_.size(), compared_ + missing_, what_);
    if (other_times_ > 0) counts += fmt::format(", {} shown at other times", other_times_);
    if (missing_ > 0) counts += fmt::format(", {} only in one", missing_);
    std::string text = fmt::format("different: {}\nfirst {}\n", counts, first_);
    if (worst_)
        text += fmt::format("worst {}: {}\n", readable(worst_->name),
                            difference_text(worst_->difference));
    return text;
}

nlohmann::ordered_json Comparison::json() const {
    const ImageDifference worst = worst_ ? worst_->difference : ImageDifference{};
    nlohmann::ordered_json json = {{"same", same()},
                                   {"compared", compared_},
                                   {"differing", failed_.size()},
                                   {"only_in_one", missing_},
                                   {"at_other_times", other_times_},
                                   {"first", first_},
                                   {"worst", worst_ ? worst_->name : ""},
                                   {"same_size", worst.same_size},
                                   {"largest", worst.largest},
                                   {"differing_fraction", worst.differing_fraction()},
                                   {"differs", failed_}};
    // JSON has no infinity: identical pictures have no PSNR.
    json["psnr_luma_db"] = std::isfinite(worst.psnr_luma_db)
                               ? nlohmann::ordered_json(worst.psnr_luma_db)
                               : nlohmann::ordered_json(nullptr);
    return json;
}

}  // namespace carom
