#include "scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scene/catalogue.h"
#include "scene/key_places.h"
#include "scene/scalar.h"

namespace carom {

namespace {

/// One step of a path: a key or name, or the i of [i].
struct Step {
    std::string name;
    int index = -1;  ///< below 0: `name` counts

    bool is_index() const { return index >= 0; }
    std::string text() const { return is_index() ? fmt::format("[{}]", index) : name; }
};

/// "balls[0].mass" -> balls, [0], mass; none if the brackets or dots are wrong.
std::optional<std::vector<Step>> split_path(const std::string& path) {
    std::vector<Step> steps;
    std::size_t i = 0;
    while (i < path.size()) {
        if (path[i] == '[') {
            const std::size_t end = path.find(']', i);
            if (end == std::string::npos || end == i + 1 || end - i > 8) return std::nullopt;
            const std::string digits = path.substr(i + 1, end - i - 1);
            if (digits.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
            steps.push_back({"", std::stoi(digits)});
            i = end + 1;
        } else {
            const std::size_t end = std::min(path.find_first_of(".[", i), path.size());
            if (end == i) return std::nullopt;
            steps.push_back({path.substr(i, end - i)});
            i = end;
        }
        if (i < path.size() && path[i] == '.' && ++i == path.size()) return std::nullopt;
    }
    if (steps.empty()) return std::nullopt;
    return steps;
}

void take_over(Node& node, int source) {
    node.source = source;
    node.mark = node.key_mark = {};
    for (Node& child : node.children) take_over(child, source);
}

/// What stands where a path has led to: a mapping of `section`, or the value of `spec`.
struct Place {
    Node* node = nullptr;
    std::optional<Section> section;  ///< set: `node` is a mapping of it
    const KeySpec* spec = nullptr;   ///< else: `node` is this key's list or named mappings
};

/// Puts one value into the tree.
class Setter {
  public:
    Setter(const KeyTable& table, Report& report, const ValueOrigin& origin)
        : table_(table), report_(report), origin_(origin) {}

    bool set(Node& root, const std::vector<Step>& steps, Node value);

  private:
    Node* fail(std::string message) {
        report_.error_in_source(origin_.source, origin_.mark, std::move(message));
        return nullptr;
    }
    bool follow(Node& root, const std::vector<Step>& steps, Node value);
    Node* entry_of(const Place& place, const Step& step, bool last);
    Node* key_of(const Place& place, const Step& step);
    Node* named_of(const Place& place, const Step& step, bool last);
    Node* listed_of(const Place& place, const Step& step);
    bool open(Place& place, Node& node, const Step& step);
    bool open_value(Place& place, Node& node);
    Node& add(Node& map, const std::string& key);
    Node made(Node::Kind kind) const;

    const KeyTable& table_;
    Report& report_;
    ValueOrigin origin_;
};

Node Setter::made(Node::Kind kind) const {
    Node node;
    node.kind = kind;
    node.source = origin_.source;
    node.mark = node.key_mark = origin_.mark;
    return node;
}

Node& Setter::add(Node& map, const std::string& key) {
    Node node = made(Node::Kind::kNull);
    node.key = key;
    map.children.push_back(std::move(node));
    return map.children.back();
}

Node* Setter::key_of(const Place& place, const Step& step) {
    const KeySpec* spec = step.is_index() ? nullptr : table_.find(*place.section, step.name);
    if (spec == nullptr)
        return fail(fmt::format("unknown key {}{}", quoted_excerpt(step.text()),
                                key_suggestion(table_, *place.section, step.name)));
    Node* node = place.node->find(step.name);
    return node != nullptr ? node : &add(*place.node, step.name);
}

Node* Setter::named_of(const Place& place, const Step& step, bool last) {
    if (step.is_index())
        return fail(fmt::format("'{}' goes by names, not by [i]", place.spec->key));
    if (Node* node = place.node->find(step.name)) return node;
    const bool in_catalogue =
        place.spec->child == Section::kMaterial && find_preset(step.name) != nullptr;
    if (last || in_catalogue) return &add(*place.node, step.name);
    std::vector<std::string> names;
    for (const Node& child : place.node->children) names.push_back(child.key);
    return fail(fmt::format("'{}' has no {}{}", place.spec->key, quoted_excerpt(step.name),
                            suggestion(step.name, names)));
}

/// An entry of a list, by [i] or, where entries have names, by name.
Node* Setter::listed_of(const Place& place, const Step& step) {
    std::vector<Node>& entries = place.node->children;
    if (step.is_index()) {
        const auto index = static_cast<std::size_t>(step.index);
        if (index < entries.size()) return &entries[index];
        return fail(fmt::format("'{}' has no entry [{}]: it has {}, counted from 0",
                                place.spec->key, step.index, entries.size()));
    }
    std::vector<std::string> names;
    for (Node& entry : entries) {
        const Node* name = entry.find("name");
        if (name == nullptr) continue;
        if (name->text == step.name) return &entry;
        names.push_back(name->text);
    }
    if ((place.spec->forms & form::kMaps) == 0)
        return fail(
            fmt::format("'{}' is a list of values; an entry is [0], [1], ...", place.spec->key));
    return fail(fmt::format("'{}' has no entry named {}{}", place.spec->key,
                            quoted_excerpt(step.name), suggestion(step.name, names)));
}

Node* Setter::entry_of(const Place& place, const Step& step, bool last) {
    if (place.section) return key_of(place, step);
    if ((place.spec->forms & form::kNamedMaps) != 0) return named_of(place, step, last);
    return listed_of(place, step);
}

/// A list of numbers that the file leaves out starts from its default.
bool Setter::open_value(Place& place, Node& node) {
    const Forms lists = form::kNumbers | form::kIntegers | form::kReferences | form::kTexts;
    if ((place.spec->forms & lists) == 0) {
        fail(fmt::format("'{}' is a single value; nothing stands below it", place.spec->key));
        return false;
    }
    if (node.kind == Node::Kind::kList) return true;
    const Fallback& fallback = place.spec->fallback;
    if (fallback.kind != Fallback::Kind::kNumbers) {
        fail(
            fmt::format("'{}' is not in the scene and has no default, so it has no entries; set it "
                        "as a whole",
                        place.spec->key));
        return false;
    }
    node.kind = Node::Kind::kList;
    for (int i = 0; i < fallback.count; ++i) {
        Node number = made(Node::Kind::kScalar);
        number.text = number_text(fallback.numbers[static_cast<std::size_t>(i)]);
        node.children.push_back(std::move(number));
    }
    return true;
}

/// Goes into `node`, making the mapping that has to be there.
bool Setter::open(Place& place, Node& node, const Step& step) {
    const KeySpec* spec = place.section ? table_.find(*place.section, step.name) : place.spec;
    const bool entry = !place.section;  // of named mappings or of a list
    place = {&node, std::nullopt, spec};
    const auto takes = [&](Forms forms) { return (spec->forms & forms) != 0; };
    if (entry && !takes(form::kNamedMaps | form::kMaps)) {
        fail(fmt::format("nothing stands below {} of '{}'", step.text(), spec->key));
        return false;
    }
    if (entry || takes(form::kMap)) place.section = spec->child;
    if (entry || takes(form::kMap | form::kNamedMaps)) {
        if (node.kind == Node::Kind::kMap) return true;
        node.kind = Node::Kind::kMap;  // also in place of `true`, say of an overlay
        node.text.clear();
        node.children.clear();
        return true;
    }
    if (!takes(form::kMaps)) return open_value(place, node);
    if (node.kind == Node::Kind::kList) return true;
    fail(fmt::format("the scene has no '{}'", spec->key));
    return false;
}

bool Setter::follow(Node& root, const std::vector<Step>& steps, Node value) {
    Place place{&root, Section::kScene, nullptr};
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const bool last = i + 1 == steps.size();
        Node* node = entry_of(place, steps[i], last);
        if (node == nullptr) return false;
        if (last) {
            value.key = node->key;
            *node = std::move(value);
            return true;
        }
        if (!open(place, *node, steps[i])) return false;
    }
    return true;
}

bool Setter::set(Node& root, const std::vector<Step>& steps, Node value) {
    const Node* top = root.find(steps.front().name);
    const std::optional<Node> before = top == nullptr ? std::nullopt : std::optional(*top);
    if (follow(root, steps, std::move(value))) return true;
    // A path that leads nowhere must not leave its first steps behind.
    if (before)
        *root.find(before->key) = *before;
    else if (!root.children.empty() && root.children.back().key == steps.front().name)
        root.children.pop_back();
    return false;
}

/// The same, with an error in `report` where there is none.
std::optional<std::vector<Step>> path_steps(const std::string& path, const ValueOrigin& origin,
                                            Report& report) {
    std::optional<std::vector<Step>> steps = split_path(path);
    if (!steps)
        report.error_in_source(origin.source, origin.mark,
                               "a path is keys and names joined by dots, and [i] in lists, such as "
                               "balls.a.mass or film.size[0]");
    return steps;
}

std::optional<Node> parse_value(const Override& override, Report& report, int source) {
    if (!override.value.empty() && override.value[0] == '#') {
        // For YAML this is a comment; on a command line it is a colour.
        Node node;
        node.kind = Node::Kind::kScalar;
        node.text = override.value;
        take_over(node, source);
        return node;
    }
    Diagnostics mistakes;
    std::optional<Node> node = parse_document(override.value, "", mistakes);
    for (const Diagnostic& mistake : mistakes.items())
        report.error_in_source(source, {}, "in the value: " + mistake.message);
    if (mistakes.has_errors()) return std::nullopt;
    take_over(*node, source);
    return node;
}

}  // namespace

void apply_overrides(Node& root, const std::vector<Override>& overrides, const KeyTable& table,
                     Report& report) {
    for (const Override& override : overrides) {
        const int source = report.add_source("--set " + override.path);
        std::optional<Node> value = parse_value(override, report, source);
        if (value)
            set_value(root, override.path, std::move(*value), {source}, table, report);
        else
            path_steps(override.path, {source}, report);
    }
}

bool set_value(Node& root, const std::string& path, Node value, const ValueOrigin& origin,
               const KeyTable& table, Report& report) {
    const std::optional<std::vector<Step>> steps = path_steps(path, origin, report);
    return steps && Setter(table, report, origin).set(root, *steps, std::move(value));
}

}  // namespace carom
