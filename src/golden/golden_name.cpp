#include "golden/golden_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "golden/ignore_file.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

bool is_digits(const std::string& text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::string still_name(const std::string& scene_stem, double time_s) {
    return fmt::format("{}-t{:.6f}", scene_stem, time_s);
}

std::string golden_path(const std::string& folder, const std::string& name) {
    return (fs::path(folder) / (name + ".png")).string();
}

std::optional<std::string> scene_of_still(const std::string& name) {
    constexpr std::size_t kDecimals = 6;
    const std::size_t dash = name.rfind("-t"), point = name.rfind('.');
    if (dash == std::string::npos || point == std::string::npos || point < dash) return {};
    const std::string whole = name.substr(dash + 2, point - dash - 2),
                      decimals = name.substr(point + 1);
    if (!is_digits(whole) || !is_digits(decimals) || decimals.size() != kDecimals) return {};
    return name.substr(0, dash);
}

std::vector<std::string> orphans(const std::string& folder,
                                 const std::vector<std::string>& stills) {
    std::set<std::string> wanted;
    for (const std::string& name : stills) {
        wanted.insert(name);
        if (const auto scene = scene_of_still(name)) wanted.insert(*scene);
    }
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const std::string file = at->path().filename().string();
        std::string name;
        if (at->path().extension() == ".png" && scene_of_still(at->path().stem().string()))
            name = at->path().stem().string();
        else if (file.ends_with(kIgnoreEnding))
            name = file.substr(0, file.size() - std::string(kIgnoreEnding).size());
        else
            continue;
        if (!wanted.contains(name)) found.push_back((fs::path(folder) / file).string());
    }
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace carom
