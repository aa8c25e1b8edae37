#include "golden/accept.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/checksum.h"
#include "core/diagnostics.h"
#include "core/failure.h"
#include "golden/golden_name.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "media/png.h"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& what) { throw Failure(FailureKind::kInput, what); }

std::string bytes_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    if (!stream.is_open() || stream.bad() || fs::is_directory(path))
        refuse(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
    return bytes;
}

Json read_report(const std::string& path) {
    const Json json = Json::parse(bytes_of(path), nullptr, false);
    if (json.is_discarded() || !json.is_object() || !json.contains("carom_golden_report") ||
        json["carom_golden_report"] != 1 || !json.contains("stills") || !json["stills"].is_array())
        refuse(fmt::format("{} is no report of 'carom golden check --json'", path));
    return json;
}

/// A text of a still's entry.
std::string text_of(const Json& still, const char* key, const std::string& report) {
    const auto found = still.find(key);
    if (found == still.end() || !found->is_string())
        refuse(fmt::format("{}: a still without '{}'", report, key));
    return found->get<std::string>();
}

void require_known(const std::vector<std::string>& only, const std::vector<std::string>& names,
                   const std::string& report) {
    std::vector<std::string> known = names;
    for (const std::string& name : names)
        if (const auto scene = scene_of_still(name)) known.push_back(*scene);
    for (const std::string& wanted : only) {
        if (std::find(known.begin(), known.end(), wanted) != known.end()) continue;
        const std::string nearest = nearest_word(wanted.substr(0, 100), known);
        refuse(fmt::format("{} has no still '{}' that could be accepted{}", report, wanted,
                           nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
    }
}

bool is_wanted(const std::string& name, const std::vector<std::string>& only) {
    return only.empty() || std::any_of(only.begin(), only.end(), [&name](const std::string& word) {
               return word == name || word == scene_of_still(name);
           });
}

/// Checks that nothing has changed since the report was written.
Acceptance acceptance_of(const Json& still, const std::string& folder, const std::string& report) {
    Acceptance result;
    result.name = text_of(still, "name", report);
    // The name decides where it goes: a report from elsewhere cannot write outside of `folder`.
    if (!scene_of_still(result.name) || result.name.find('/') != std::string::npos)
        refuse(fmt::format("{}: '{}' is no name of a still", report, result.name));
    if (!still.contains("drawn"))
        refuse(fmt::format("{}: {} has no drawn picture", report, result.name));
    result.golden = golden_path(folder, result.name);
    result.drawn = (fs::path(report).parent_path() / text_of(still, "drawn", report)).string();
    result.bytes = bytes_of(result.drawn);
    if (checksum_text(result.bytes) != text_of(still, "drawn_checksum", report))
        refuse(fmt::format("{} is not the picture that {} tells of: check again", result.drawn,
                           report));
    read_png(result.drawn);
    std::error_code error;
    result.replaces = fs::exists(result.golden, error);
    const std::string now = result.replaces ? checksum_text(bytes_of(result.golden)) : "";
    if (now != text_of(still, "golden_checksum", report))
        refuse(
            fmt::format("{} has changed since {} was written: check again", result.golden, report));
    return result;
}

}  // namespace

std::vector<Acceptance> acceptances(const std::string& path, const std::vector<std::string>& only) {
    const Json report = read_report(path);
    const std::string folder = text_of(report, "dir", path);
    std::vector<const Json*> open;
    std::vector<std::string> names;
    for (const Json& still : report["stills"]) {
        if (!still.is_object()) refuse(fmt::format("{}: a still that is no object", path));
        if (text_of(still, "outcome", path) == "same") continue;
        open.push_back(&still);
        names.push_back(text_of(still, "name", path));
    }
    require_known(only, names, path);
    std::vector<Acceptance> result;
    for (std::size_t i = 0; i < open.size(); ++i)
        if (is_wanted(names[i], only)) result.push_back(acceptance_of(*open[i], folder, path));
    return result;
}

void take(const std::vector<Acceptance>& acceptances) {
    if (acceptances.empty()) return;
    prepare_folder(fs::path(acceptances.front().golden).parent_path().string());
    std::vector<OutputFile> files;
    for (const Acceptance& a : acceptances) {
        files.emplace_back(a.golden);
        std::ofstream stream(files.back().temporary_path(), std::ios::binary);
        stream << a.bytes << std::flush;
        if (!stream)
            throw Failure(FailureKind::kOutput,
                          fmt::format("cannot write '{}': {}", a.golden, std::strerror(errno)));
    }
    for (OutputFile& file : files) file.commit();
}

}  // namespace carom
