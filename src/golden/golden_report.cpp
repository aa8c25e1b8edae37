#include "golden/golden_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/checksum.h"
#include "golden/measures_json.h"

namespace carom {

namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

OrderedJson rects_json(const std::vector<PixelRect>& rects) {
    OrderedJson list = OrderedJson::array();
    for (const PixelRect& r : rects)
        list.push_back({{"x", r.left}, {"y", r.top}, {"width", r.width()}, {"height", r.height()}});
    return list;
}

/// `path` as it is found from `folder`, if that can be said.
std::string seen_from(const std::string& path, const fs::path& folder) {
    std::error_code error;
    const fs::path to = fs::weakly_canonical(fs::absolute(path, error), error);
    const fs::path from = fs::weakly_canonical(fs::absolute(folder, error), error);
    const fs::path relative = to.lexically_relative(from);
    return relative.empty() ? to.string() : relative.string();
}

OrderedJson still_json(const StillCheck& check, const fs::path& folder) {
    OrderedJson json = {{"name", check.still.name},
                        {"outcome", outcome_word(check.outcome)},
                        {"scene", check.still.scene},
                        {"time", check.still.time_s},
                        {"golden", check.still.golden},
                        {"golden_checksum", check.golden_checksum},
                        {"renderer", check.still.renderer},
                        {"why", check.why},
                        {"missed", check.missed}};
    if (check.golden_width_px > 0) {
        OrderedJson measures = OrderedJson::object();
        put_measures(measures, check.measures);
        json["measures"] = std::move(measures);
        json["golden_size"] = {check.golden_width_px, check.golden_height_px};
    }
    json["size"] = {check.width_px, check.height_px};
    json["ignored"] = rects_json(check.ignored);
    if (!check.drawn_path.empty()) {
        json["drawn"] = seen_from(check.drawn_path, folder);
        json["drawn_checksum"] = checksum_text(check.drawn_png);
    }
    return json;
}

}  // namespace

int GoldenReport::count(Outcome outcome) const {
    return static_cast<int>(
        std::count_if(stills.begin(), stills.end(),
                      [outcome](const StillCheck& c) { return c.outcome == outcome; }));
}

std::string GoldenReport::counts_text() const {
    return fmt::format("{} same, {} different, {} missing, {} unreadable", count(Outcome::kSame),
                       count(Outcome::kDifferent), count(Outcome::kMissing),
                       count(Outcome::kUnreadable));
}

std::string report_json(const GoldenReport& report, const std::string& path) {
    OrderedJson counts = OrderedJson::object();
    for (const Outcome outcome :
         {Outcome::kSame, Outcome::kDifferent, Outcome::kMissing, Outcome::kUnreadable})
        counts[outcome_word(outcome)] = report.count(outcome);
    OrderedJson json = {{"carom_golden_report", 1},    {"version", report.version},
                        {"dir", report.folder},        {"limits", limits_json(report.limits)},
                        {"counts", std::move(counts)}, {"invalid_scenes", report.invalid_scenes},
                        {"orphans", report.orphans},   {"stills", OrderedJson::array()}};
    for (const StillCheck& check : report.stills)
        json["stills"].push_back(
            still_json(check, path.empty() ? fs::path() : fs::absolute(path).parent_path()));
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace carom
