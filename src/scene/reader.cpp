#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>

#include "core/excerpt.h"
#include "core/failure.h"
#include "scene/build.h"
#include "scene/document.h"
#include "scene/odd_blank.h"
#include "scene/overrides.h"
#include "scene/scene_tree.h"
#include "scene/validate.h"

namespace carom {

namespace {

/// Reads at most one byte more than a scene may have, so that a huge or endless input ends.
std::string read_bounded(std::istream& stream) {
    constexpr std::size_t kMost = kMaxDocumentBytes + 1;
    std::string text;
    std::array<char, 1 << 16> part;
    while (stream && text.size() < kMost) {
        const std::size_t wanted = std::min(part.size(), kMost - text.size());
        stream.read(part.data(), static_cast<std::streamsize>(wanted));
        text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    }
    return text;
}

void build_scene(Build& build) {
    build_setup(build);
    build_air(build);
    build_materials(build);
    build_looks(build);
    build_surfaces(build);
    build_balls(build);
    build_overlay(build);
    build_camera(build);
    build_test(build);
    build_against(build);
    check_names(build);
    check_overlaps(build);
    check_flights(build);
    check_restitution_laws(build);
    warn_of_half_friction(build);
    warn_without_friction(build);
}

/// A key or a number with a no-break space in it looks right on the screen.
void point_out_odd_blanks(std::string_view text, const std::string& file, Diagnostics& all) {
    Diagnostics result;
    int looked_at = 0;
    // Each goes through the text.
    constexpr std::size_t kMostBytes = 100'000'000;
    const int most_looks =
        static_cast<int>(std::min<std::size_t>(100, kMostBytes / (text.size() + 1)));
    for (Diagnostic d : all.items()) {
        const bool here = d.severity == Severity::kError && d.file == file && d.mark.line > 0 &&
                          d.message.find("not valid YAML") == std::string::npos;
        if (here && ++looked_at <= most_looks)
            if (const auto blank = odd_blank_in_line(text, d.mark.line);
                blank && blank->name != "a tab")
                d.message += fmt::format("; there is {} in column {}: write a plain space",
                                         blank->name, blank->column);
        result.add(std::move(d));
    }
    all = std::move(result);
}

/// So that messages can show them. Looks at each line of the text once: marks are in order.
void add_source_lines(std::string_view text, const std::string& file, Diagnostics& all) {
    constexpr std::size_t kMostBytes = 20'000'000;  // a thousand copies of a line of megabytes
    Diagnostics result;
    std::string_view line = first_line(text);
    std::size_t kept = 0;
    int number = 1;
    for (Diagnostic d : all.items()) {
        if (d.file == file && d.mark.line >= number) {
            if (number < d.mark.line) {
                for (; number < d.mark.line && !text.empty(); ++number)
                    text = after_first_line(text);
                number = d.mark.line;
                line = first_line(text);
            }
            kept += line.size();
            if (kept <= kMostBytes) d.source_line = line;
        }
        result.add(std::move(d));
    }
    all = std::move(result);
}

}  // namespace

const std::vector<Node>& Build::entries(std::string_view key) const {
    static const std::vector<Node> kNone;
    const Node* node = root.find(key);
    const KeySpec* spec = table.find(Section::kScene, key);
    const Node::Kind kind = (spec->forms & form::kMaps) != 0 ? Node::Kind::kList : Node::Kind::kMap;
    return node != nullptr && node->kind == kind ? node->children : kNone;
}

std::optional<Node> parse_scene_tree(std::string_view text, const std::vector<Override>& overrides,
                                     const KeyTable& table, Report& report) {
    std::optional<Node> root = parse_document(text, report.file(), report.diagnostics());
    if (root && root->kind != Node::Kind::kMap) {
        report.error(*root, "a scene must be a mapping of keys, such as 'carom: 1'");
        root.reset();
    }
    if (root) apply_overrides(*root, overrides, table, report);
    return root;
}

std::optional<Scene> scene_of_tree(Node& root, const KeyTable& table, Report& report) {
    validate_section(root, Section::kScene, table, report);
    Scene scene;
    scene.file = report.file();
    scene.fingerprint = fingerprint(root);
    Build build{table, report, root, scene};
    build_scene(build);
    if (report.diagnostics().has_errors()) return std::nullopt;
    return scene;
}

Diagnostics shown_diagnostics(std::string_view text, Report& report) {
    Diagnostics all = std::move(report.diagnostics());
    if (all.has_errors()) point_out_odd_blanks(text, report.file(), all);
    all.sort();
    add_source_lines(text, report.file(), all);
    return all;
}

SceneResult read_scene(std::string_view text, const std::string& file,
                       const std::vector<Override>& overrides) {
    SceneResult result;
    Report report(file);
    const KeyTable table;
    std::optional<Node> root = parse_scene_tree(text, overrides, table, report);
    if (root) result.scene = scene_of_tree(*root, table, report);
    result.diagnostics = shown_diagnostics(text, report);
    return result;
}

std::string read_scene_text(const std::string& path, const char* kind) {
    errno = 0;
    if (path == "-") {
        std::string text = read_bounded(std::cin);
        if (std::ferror(stdin) != 0)
            throw Failure(
                FailureKind::kInput,
                fmt::format("cannot read the scene from standard input: {}", std::strerror(errno)));
        return text;
    }
    std::ifstream stream(path, std::ios::binary);
    std::string text;
    if (stream) text = read_bounded(stream);
    if (!stream.is_open() || stream.bad() || (stream.fail() && !stream.eof()))
        throw Failure(FailureKind::kInput, fmt::format("cannot read the {} file '{}': {}", kind,
                                                       path, std::strerror(errno)));
    return text;
}

SceneResult read_scene_file(const std::string& path, const std::vector<Override>& overrides) {
    return read_scene(read_scene_text(path), path == "-" ? "<stdin>" : path, overrides);
}

Override parse_override(const std::string& argument) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos || equals == 0)
        throw Failure(
            FailureKind::kInput,
            fmt::format("--set wants PATH=VALUE, such as balls.a.mass=1, not '{}'", argument));
    return {argument.substr(0, equals), argument.substr(equals + 1)};
}

}  // namespace carom
