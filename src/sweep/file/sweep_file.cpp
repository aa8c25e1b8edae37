#include "sweep/file/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/checksum.h"
#include "core/failure.h"
#include "scene/fields.h"
#include "scene/overrides.h"
#include "scene/scalar.h"
#include "scene/scene_tree.h"
#include "scene/validate.h"
#include "sweep/file/plan.h"
#include "sweep/file/results.h"
#include "sweep/file/sweep_checks.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// All values of the file carry this source, here and later beside a base scene.
void set_source(Node& node) {
    node.source = kSweepSource;
    for (Node& child : node.children) set_source(child);
}

Vec3 vec3_of(const Node& list) {
    return {node_number(list.children[0]), node_number(list.children[1]),
            node_number(list.children[2])};
}

/// From a validated file to the Sweep.
class SweepReader {
  public:
    SweepReader(const Node& root, const KeyTable& table, Report& report, Sweep& sweep)
        : root_(root), table_(table), report_(report), sweep_(sweep) {}

    void read() {
        const Fields top(table_, Section::kSweep, &root_);
        const std::string mode = top.word("mode");
        sweep_.mode = mode == "zip"      ? SweepMode::kZip
                      : mode == "lhs"    ? SweepMode::kLhs
                      : mode == "random" ? SweepMode::kRandom
                                         : SweepMode::kGrid;
        if (const Node* count = top.find("count"))
            sweep_.count = static_cast<std::int64_t>(node_number(*count));
        sweep_.seed = static_cast<std::uint64_t>(top.number("seed"));
        if (const Node* axes = top.find("axes")) sweep_.axes = read_axes(*axes, false);
        if (const Node* random = top.find("random")) read_random(*random);
        read_outputs(top.child("outputs"));
        if (const Node* results = top.find("results"))
            for (const Node& one : results->children) sweep_.results.push_back({one.key, one.text});
        check_mode(sweep_, root_, report_);
    }

  private:
    std::vector<SweepAxis> read_axes(const Node& map, bool list_is_value) {
        std::vector<SweepAxis> axes;
        for (const Node& node : map.children) {
            std::optional<Draw> draw = Draw::read(node, list_is_value, table_, report_);
            if (draw) axes.push_back({node.key, std::move(*draw), {kSweepSource, node.key_mark}});
        }
        return axes;
    }

    /// A number or a draw; `fallback` where it is left out.
    Draw read_number(const Node& map, const char* key, double fallback) {
        Node left_out;
        left_out.kind = Node::Kind::kScalar;
        left_out.text = number_text(fallback);
        const Node* node = map.find(key);
        const std::optional<Draw> draw =
            Draw::read(node == nullptr ? left_out : *node, true, table_, report_);
        if (!draw) return {};
        if (node != nullptr) require_numbers(*node, *draw);
        return *draw;
    }

    void require_numbers(const Node& node, const Draw& draw) {
        for (const Node& value : draw.values()) {
            const bool right =
                value.kind == Node::Kind::kScalar &&
                resolve_scalar(value.text, value.quoted).kind == Scalar::Kind::kNumber;
            if (!right) report_.error(value, fmt::format("'{}' must be a number", node.key));
        }
    }

    void read_random(const Node& map) {
        if (const Node* groups = map.find("balls"))
            for (const Node& group : groups->children) read_group(group);
        if (const Node* camera = map.find("camera")) read_camera(*camera);
    }

    void read_group(const Node& node) {
        const Fields fields(table_, Section::kSweepBalls, &node);
        RandomBalls group;
        group.origin = {kSweepSource, node.mark};
        group.name = fields.word("name");
        group.count = read_number(node, "count", 0);
        const Node& region = *node.find("region");
        const Vec3 from = vec3_of(*region.find("from")), to = vec3_of(*region.find("to"));
        group.low = from.cwiseMin(to);
        group.high = from.cwiseMax(to);
        group.gap = fields.number("gap");
        group.attempts = fields.integer("attempts");
        const Node& each = *node.find("each");
        group.each = read_axes(each, true);
        require_whole_count(node, group);
        check_each(group, each);
        for (const RandomBalls& other : sweep_.balls)
            if (other.name == group.name)
                report_.error(node, fmt::format("two groups are named '{}'; give one another "
                                                "'name'",
                                                group.name));
        sweep_.balls.push_back(std::move(group));
    }

    /// Those that stand in the file, and of a draw its ends and its middle.
    static std::vector<double> looked_at(const Draw& draw) {
        constexpr double kNearlyOne = 1 - 1e-15;
        std::vector<double> numbers;
        for (const Node& value : draw.values()) numbers.push_back(node_number(value));
        if (draw.values().empty())
            for (const double u : {0.0, 0.5, kNearlyOne})
                numbers.push_back(node_number(draw.at(u)));
        return numbers;
    }

    void require_whole_count(const Node& node, const RandomBalls& group) {
        constexpr double kMost = 100'000;
        if (report_.diagnostics().has_errors()) return;
        const auto right = [](double count) {
            return count == std::floor(count) && count >= 0 && count <= kMost;
        };
        if (!std::ranges::all_of(looked_at(group.count), right))
            report_.error(*node.find("count"),
                          "'count' must be whole numbers between 0 and 100000: draw it by "
                          "'integer' or 'choice'");
    }

    void check_each(const RandomBalls& group, const Node& each) {
        bool sized = false;
        for (const SweepAxis& one : group.each) {
            const std::string key = one.path.substr(0, one.path.find_first_of(".["));
            sized = sized || key == "radius" || key == "preset";
            for (const char* taken : {"name", "position", "drop_height", "at", "repeat"})
                if (key == taken)
                    report_.error_in_source(
                        one.origin.source, one.origin.mark,
                        fmt::format("'{}' cannot be set here: names and places are made by the "
                                    "sweep",
                                    taken));
        }
        if (!sized)
            report_.error(each,
                          "one of 'radius', 'preset' must stand here: places without overlap "
                          "depend on it");
    }

    void read_camera(const Node& node) {
        RandomCamera camera;
        constexpr double kAzimuth_deg = -90, kElevation_deg = 10;  // as in the table of keys
        camera.origin = {kSweepSource, node.key_mark};
        if (const Node* to = node.find("to")) camera.to = vec3_of(*to);
        camera.distance = read_number(node, "distance", 1);
        camera.azimuth_deg = read_number(node, "azimuth_deg", kAzimuth_deg);
        camera.elevation_deg = read_number(node, "elevation_deg", kElevation_deg);
        if (node.find("fov_deg") != nullptr) camera.fov_deg = read_number(node, "fov_deg", 0);
        if (report_.diagnostics().has_errors()) return;
        const auto is_far = [](double distance) { return distance > 0; };
        const auto is_no_pole = [](double degrees) { return std::abs(degrees) < 90; };
        if (!std::ranges::all_of(looked_at(camera.distance), is_far))
            return report_.error(*node.find("distance"), "'distance' must be above 0");
        if (!std::ranges::all_of(looked_at(camera.elevation_deg), is_no_pole))
            return report_.error(*node.find("elevation_deg"),
                                 "'elevation_deg' must be above -90 and below 90");
        sweep_.camera = std::move(camera);
    }

    void read_outputs(const Fields& fields) {
        SweepOutputs& out = sweep_.outputs;
        const auto flag = [&](const char* key) {
            const Node* node = fields.find(key);
            return node != nullptr && node->kind == Node::Kind::kScalar &&
                   resolve_scalar(node->text, node->quoted).boolean;
        };
        out.motion = flag("motion");
        out.events = flag("events");
        out.stats = flag("stats");
        out.scene = flag("scene");
        out.frames = flag("frames");
        out.quality = fields.word("quality");
        if (const Node* film = fields.find("film")) {
            const bool is_flag =
                resolve_scalar(film->text, film->quoted).kind == Scalar::Kind::kBool;
            out.film = is_flag ? (flag("film") ? "mp4" : "") : film->text;
        }
        if (const Node* quality = fields.find("quality"); quality != nullptr && out.film.empty())
            report_.error_at_key(*quality, "'quality' is of a film, and there is no 'film' here");
        if (const Node* stills = fields.find("stills")) {
            out.stills = flag("stills") || stills->kind == Node::Kind::kList;
            for (const Node& time : stills->children) out.still_times.push_back(node_number(time));
        }
        if (const Node* layers = fields.find("layers"))
            for (const Node& layer : layers->children) read_layer(layer);
    }

    void read_layer(const Node& node) {
        std::vector<std::string> names;
        for (const LayerKindInfo& info : layer_kinds()) names.emplace_back(info.name);
        const LayerKindInfo* found = find_layer_kind(node.text);
        std::vector<LayerKind>& layers = sweep_.outputs.layers;
        if (found == nullptr)
            report_.error(node, fmt::format("there is no layer {}{}", quoted_excerpt(node.text),
                                            suggestion(node.text, names)));
        else if (std::find(layers.begin(), layers.end(), found->kind) != layers.end())
            report_.error(node, fmt::format("'{}' stands twice", node.text));
        else
            layers.push_back(found->kind);
    }

    const Node& root_;
    const KeyTable& table_;
    Report& report_;
    Sweep& sweep_;
};

/// What all runs share: where it is another, each run has to be made again.
std::uint64_t shared_fingerprint(const Sweep& sweep, const Node& root) {
    Checksum sum;
    const auto add = [&](std::uint64_t number) { sum.add(&number, sizeof number); };
    const std::string version = CAROM_VERSION;
    sum.add(version.data(), version.size());
    add(fingerprint(sweep.base));
    for (const char* key : {"random", "outputs", "results"}) {
        const Node* node = root.find(key);
        add(node == nullptr ? 0 : fingerprint(*node));
    }
    if (root.find("random") != nullptr) add(sweep.seed);
    return sum.value();
}

/// The base as text and tree; its own mistakes go to the result.
bool read_base(const std::string& path, const Node& root, const std::vector<Override>& overrides,
               Sweep& sweep, Diagnostics& diagnostics) {
    const fs::path named = root.find("base")->text;
    sweep.base_file = (fs::path(path).parent_path() / named).string();
    if (sweep.base_file == "-") sweep.base_file = "./-";  // a file, not standard input
    sweep.base_text = read_scene_text(sweep.base_file);
    Report report(sweep.base_file);
    report.add_source(path);  // kSweepSource, for later
    std::optional<Node> tree =
        parse_scene_tree(sweep.base_text, overrides, sweep.scene_keys, report);
    std::optional<Scene> scene;
    if (tree) {
        sweep.base = *tree;
        scene = scene_of_tree(*tree, sweep.scene_keys, report);
    }
    if (scene && scene->against && sweep.outputs.pictures())
        report.error(*sweep.base.find("against"),
                     "a sweep draws one run in a picture: take 'against' out");
    const Diagnostics found = shown_diagnostics(sweep.base_text, report);
    for (const Diagnostic& one : found.items()) diagnostics.add(one);
    if (!found.has_errors()) check_names_of_results(sweep, *scene, root, path, diagnostics);
    return !found.has_errors();
}

}  // namespace

SweepResult read_sweep_file(const std::string& path, const std::vector<Override>& base_overrides) {
    SweepResult result;
    const std::string text = read_scene_text(path, "sweep");
    Report report(path);
    report.add_source(path);
    std::optional<Node> root = parse_document(text, path, report.diagnostics());
    if (root && root->kind != Node::Kind::kMap) {
        report.error(*root, "a sweep must be a mapping of keys, such as 'base: scene.yaml'");
        root.reset();
    }
    std::optional<Sweep> sweep;
    if (root) {
        set_source(*root);
        const KeyTable table(FileKind::kSweep);
        if (validate_section(*root, Section::kSweep, table, report)) {
            sweep.emplace();
            sweep->file = path;
            SweepReader(*root, table, report, *sweep).read();
        }
    }
    const bool right = !report.diagnostics().has_errors();
    result.diagnostics = shown_diagnostics(text, report);
    if (!right || !sweep) return result;

    Diagnostics of_base;
    if (read_base(path, *root, base_overrides, *sweep, of_base)) {
        check_axes(*sweep, of_base);
        sweep->fingerprint = shared_fingerprint(*sweep, *root);
        sweep->file_fingerprint = fingerprint(*root);
    }
    for (Diagnostic one : of_base.items()) {
        if (one.file == path && one.mark.line > 0) one.source_line = line_of(text, one.mark.line);
        result.diagnostics.add(std::move(one));
    }
    if (!result.diagnostics.has_errors()) result.sweep = std::move(sweep);
    return result;
}

}  // namespace carom
