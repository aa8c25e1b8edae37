#include "scene/key_places.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "core/diagnostics.h"
#include "scene/report.h"

namespace carom {

namespace {

/// "surfaces[].plane" as the path of --set: surfaces.NAME.plane.
std::string set_path(std::string_view section, std::string_view key) {
    std::string path(section);
    for (std::size_t at = 0; (at = path.find("[]", at)) != std::string::npos;)
        path.replace(at, 2, ".NAME");
    return fmt::format("{}{}{}", path, path.empty() ? "" : ".", key);
}

}  // namespace

std::string place_suggestion(const KeyTable& table, std::string_view key) {
    constexpr std::size_t kMostPlaces = 3;
    std::vector<std::string> places, in_lists;
    for (const SectionDoc& section : table.sections()) {
        // What stands in `defaults` stands first of all where it is filled in.
        const bool repeats = section.section == Section::kBallDefaults;
        if (repeats || table.find(section.section, key) == nullptr) continue;
        const std::string path = set_path(section.path, key);
        (path.find("NAME") == std::string::npos ? places : in_lists).push_back("'" + path + "'");
    }
    if (places.empty()) places = std::move(in_lists);
    if (places.size() > kMostPlaces) places.resize(kMostPlaces);
    if (places.empty()) return "";
    return fmt::format("; did you mean {}?", fmt::join(places, " or "));
}

std::string key_suggestion(const KeyTable& table, Section section, const std::string& key) {
    const std::vector<std::string> names = table.key_names(section);
    const bool short_enough = key.size() <= 100;
    if (section == Section::kScene && short_enough && nearest_word(key, names).empty()) {
        const std::string place = place_suggestion(table, key);
        if (!place.empty()) return place;
    }
    return suggestion(key, names);
}

}  // namespace carom
