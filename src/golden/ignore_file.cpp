#include "golden/ignore_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "core/diagnostics.h"
#include "core/failure.h"
#include "golden/golden_name.h"
#include "scene/document.h"
#include "scene/reader.h"
#include "scene/report.h"
#include "scene/scalar.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr int kMostPixels = 100'000;  // of a side: no picture has more

/// One number of a rectangle; reports what else stands there.
int pixels(const Node& map, const char* key, int least, Report& report) {
    const Node* node = map.find(key);
    if (node == nullptr) {
        report.error(map,
                     fmt::format("'{}' is missing: a rectangle has x, y, width and height", key));
        return least;
    }
    const Scalar value = resolve_scalar(node->text, node->quoted);
    if (node->kind == Node::Kind::kScalar && value.kind == Scalar::Kind::kNumber &&
        value.integral() && value.number >= least && value.number <= kMostPixels)
        return static_cast<int>(value.number);
    report.error(*node,
                 fmt::format("'{}' must be a whole number of pixels, at least {}", key, least));
    return least;
}

PixelRect rect_of(const Node& map, Report& report) {
    static const std::vector<std::string> kKeys = {"x", "y", "width", "height", "why"};
    if (map.kind != Node::Kind::kMap) {
        report.error(map, "a rectangle is a mapping: {x: 10, y: 20, width: 100, height: 30}");
        return {};
    }
    for (const Node& entry : map.children)
        if (std::find(kKeys.begin(), kKeys.end(), entry.key) == kKeys.end())
            report.error_at_key(
                entry, fmt::format("unknown key '{}'{}", entry.key, suggestion(entry.key, kKeys)));
    const int x = pixels(map, "x", 0, report), y = pixels(map, "y", 0, report);
    const int width = pixels(map, "width", 1, report), height = pixels(map, "height", 1, report);
    return PixelRect::at(x, y, width, height);
}

void read_file(const std::string& path, std::vector<PixelRect>& rects) {
    Report report(path);
    const std::optional<Node> root =
        parse_document(read_scene_text(path), path, report.diagnostics());
    const Node* list = root ? root->find("ignore") : nullptr;
    if (root && root->kind == Node::Kind::kMap)
        for (const Node& entry : root->children)
            if (entry.key != "ignore")
                report.error_at_key(
                    entry, fmt::format("unknown key '{}'; the only one is 'ignore'", entry.key));
    if (root && (list == nullptr || list->kind != Node::Kind::kList))
        report.error(list == nullptr ? *root : *list,
                     "expected 'ignore:' with a list of rectangles, such as "
                     "- {x: 10, y: 20, width: 100, height: 30}");
    else if (root)
        for (const Node& entry : list->children) rects.push_back(rect_of(entry, report));
    if (!report.diagnostics().has_errors()) return;
    report.diagnostics().sort();
    std::string text = "cannot read what is ignored:";
    for (const Diagnostic& d : report.diagnostics().items()) text += "\n" + d.text();
    throw Failure(FailureKind::kInput, text);
}

}  // namespace

std::vector<PixelRect> ignored_rects(const std::string& folder, const std::string& still) {
    std::vector<PixelRect> rects;
    const std::string scene = scene_of_still(still).value_or(still);
    for (const std::string& name : {scene, still}) {
        const std::string path = (fs::path(folder) / (name + kIgnoreEnding)).string();
        std::error_code error;
        if (fs::exists(path, error)) read_file(path, rects);
    }
    return rects;
}

long covered_pixels(const std::vector<PixelRect>& rects, int width_px, int height_px) {
    // Between neighbouring edges a row of rectangles is all covered or not at all.
    std::set<int> columns = {0, width_px}, rows = {0, height_px};
    for (const PixelRect& r : rects) {
        for (const int x : {r.left, r.right}) columns.insert(std::clamp(x, 0, width_px));
        for (const int y : {r.top, r.bottom}) rows.insert(std::clamp(y, 0, height_px));
    }
    long covered = 0;
    for (auto top = rows.begin(); std::next(top) != rows.end(); ++top)
        for (auto left = columns.begin(); std::next(left) != columns.end(); ++left) {
            const PixelRect cell{*left, *top, *std::next(left), *std::next(top)};
            const bool in = std::any_of(rects.begin(), rects.end(), [&cell](const PixelRect& r) {
                return r.common(cell) == cell;
            });
            if (in) covered += long{cell.width()} * cell.height();
        }
    return covered;
}

void require_inside(const std::vector<PixelRect>& rects, int width_px, int height_px,
                    const std::string& still) {
    for (const PixelRect& r : rects)
        if (r.right > width_px || r.bottom > height_px)
            throw Failure(
                FailureKind::kInput,
                fmt::format("{}: the ignored rectangle {{x: {}, y: {}, width: {}, height: {}}} "
                            "leaves the picture of {}x{}",
                            still, r.left, r.top, r.width(), r.height(), width_px, height_px));
    if (!rects.empty() && covered_pixels(rects, width_px, height_px) == long{width_px} * height_px)
        throw Failure(
            FailureKind::kInput,
            fmt::format("{}: all of the picture is ignored: there is nothing to compare", still));
}

}  // namespace carom
