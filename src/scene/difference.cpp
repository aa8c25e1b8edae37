#include "scene/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/check.h"
#include "scene/catalogue.h"
#include "scene/document.h"
#include "scene/keys.h"
#include "scene/overrides.h"
#include "scene/report.h"
#include "scene/scalar.h"
#include "scene/virtual_body.h"

namespace carom {

namespace {

constexpr std::array<std::string_view, 6> kSimulated = {"simulation", "materials", "pairs",
                                                        "surfaces",   "defaults",  "balls"};

Node document(std::string_view text, const std::vector<Override>& overrides,
              const KeyTable& table) {
    Report report("");
    std::optional<Node> root = parse_document(text, "", report.diagnostics());
    if (!root) throw Bug("a scene is compared that was not read");
    apply_overrides(*root, overrides, table, report);
    return std::move(*root);
}

/// A value as people write it; "none" for null.
std::string value_text(const Node* node) {
    if (node == nullptr) return "none";
    if (node->kind == Node::Kind::kScalar) {
        const Scalar scalar = resolve_scalar(node->text, node->quoted);
        return scalar.kind == Scalar::Kind::kNumber ? number_text(scalar.number) : node->text;
    }
    std::string text;
    for (const Node& child : node->children) {
        if (!text.empty()) text += ", ";
        if (node->kind == Node::Kind::kMap) text += child.key + ": ";
        text += value_text(&child);
    }
    return node->kind == Node::Kind::kMap ? "{" + text + "}" : "[" + text + "]";
}

std::string shortened(std::string text) {
    constexpr std::size_t kMost = 28;  // bytes that a line on a picture has room for
    if (text.size() <= kMost) return text;
    std::size_t cut = kMost;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
    return text.substr(0, cut) + "\u2026";
}

/// 0.8 and 0.80 are the same value, whatever their texts.
bool same_value(const Node* a, const Node* b) {
    if (a == nullptr || b == nullptr) return a == b;
    if (a->kind != b->kind || a->children.size() != b->children.size()) return false;
    if (a->kind == Node::Kind::kScalar) {
        const Scalar x = resolve_scalar(a->text, a->quoted), y = resolve_scalar(b->text, b->quoted);
        const bool numbers = x.kind == Scalar::Kind::kNumber && y.kind == Scalar::Kind::kNumber;
        return numbers ? x.number == y.number : a->text == b->text;
    }
    for (std::size_t i = 0; i < a->children.size(); ++i)
        if (a->children[i].key != b->children[i].key ||
            !same_value(&a->children[i], &b->children[i]))
            return false;
    return true;
}

const Node* child_of(const Node* map, std::string_view key) {
    return map == nullptr || map->kind != Node::Kind::kMap ? nullptr : map->find(key);
}

double number_of(const Node* node, double otherwise) {
    return node == nullptr ? otherwise : resolve_scalar(node->text, node->quoted).number;
}

const Preset* preset_of(const Node* ball) {
    const Node* preset = child_of(ball, "preset");
    return preset == nullptr ? nullptr : find_preset(preset->text);
}

/// The coefficient of a material that does not name one: its virtual body's, or its preset's.
std::string implied_restitution(const Node& root, const Node* material, const std::string& name) {
    const Node* body = child_of(material, "virtual_body");
    const Preset* preset = find_preset(name);
    if (body == nullptr && preset == nullptr) return "1";
    const double constant =
        number_of(child_of(child_of(&root, "simulation"), "restitution_constant"), 4);
    const VirtualBody virtual_body = body == nullptr
                                         ? preset->virtual_body
                                         : VirtualBody{number_of(child_of(body, "distance"), 0),
                                                       number_of(child_of(body, "velocity"), 1)};
    return fmt::format("{:.4g}", rigid_restitution(virtual_body, constant));
}

/// What a ball has of its preset; "" where that says nothing.
std::string preset_value(const Preset* preset, std::string_view key) {
    if (preset == nullptr) return "";
    if (key == "radius") return fmt::format("{:.4g}", preset->radius);
    if (key == "mass") return fmt::format("{:.4g}", preset->mass);
    if (key == "inertia") return fmt::format("{:.4g}", preset->inertia_factor);
    return key == "material" ? std::string(preset->name) : "";
}

/// One of the two documents, with the mapping and its name that are being compared.
struct Side {
    const Node* root = nullptr;
    const Node* map = nullptr;
    std::string name{};
};

class Comparison {
  public:
    Comparison(const KeyTable& table, const Node& a, const Node& b) : table_(table) {
        section(Section::kScene, {&a, &a}, {&b, &b}, "");
    }
    std::vector<SceneDifference> found{};

  private:
    void section(Section section, const Side& a, const Side& b, const std::string& path);
    void value(const KeySpec& spec, const Side& a, const Side& b, const std::string& path);
    void entries(const KeySpec& spec, const Side& a, const Side& b, const std::string& path);
    std::string text(const KeySpec& spec, const Side& side) const;

    const KeyTable& table_;
};

void Comparison::section(Section section, const Side& a, const Side& b, const std::string& path) {
    // A virtual body against a coefficient is compared by the coefficients that both amount to.
    const bool mixed =
        section == Section::kMaterial && (child_of(a.map, "virtual_body") == nullptr) !=
                                             (child_of(b.map, "virtual_body") == nullptr);
    for (const KeySpec* spec : table_.keys(section)) {
        const bool top = section == Section::kScene;
        if (top && std::find(kSimulated.begin(), kSimulated.end(), spec->key) == kSimulated.end())
            continue;
        if (spec->key == "look" || spec->key == "name") continue;
        if (mixed && spec->key == "virtual_body") continue;
        const bool same = same_value(child_of(a.map, spec->key), child_of(b.map, spec->key));
        if (same && !(mixed && spec->key == "restitution")) continue;
        value(*spec, a, b, path + (path.empty() ? "" : ".") + std::string(spec->key));
    }
}

/// Steps and solvers are read by the method `fixed` alone.
bool is_unread(const KeySpec& spec, const Side& side) {
    if (spec.section != Section::kSimulation) return false;
    if (spec.key != "step" && spec.key != "solver" && spec.key != "iterations") return false;
    const Node* method = child_of(side.map, "method");
    return method == nullptr || method->text != "fixed";
}

/// The value of a key, or what stands for it where it is left out.
std::string Comparison::text(const KeySpec& spec, const Side& side) const {
    if (is_unread(spec, side)) return "\u2013";
    if (const Node* node = child_of(side.map, spec.key)) return shortened(value_text(node));
    if (spec.section == Section::kMaterial && spec.key == "restitution")
        return implied_restitution(*side.root, side.map, side.name);
    if (spec.section == Section::kBall) {
        const Node* defaults = child_of(child_of(side.root, "defaults"), "ball");
        if (std::string own = preset_value(preset_of(side.map), spec.key); !own.empty()) return own;
        if (const Node* node = child_of(defaults, spec.key)) return shortened(value_text(node));
        if (std::string its = preset_value(preset_of(defaults), spec.key); !its.empty()) return its;
    }
    if (spec.fallback.kind != Fallback::Kind::kNone) return spec.fallback.text();
    constexpr std::size_t kPlain = 8;  // longer ones are explanations
    const bool plain = !spec.fallback_doc.empty() && spec.fallback_doc.size() <= kPlain;
    return plain ? std::string(spec.fallback_doc) : std::string("none");
}

void Comparison::value(const KeySpec& spec, const Side& a, const Side& b, const std::string& path) {
    const auto inner = [&](const Side& side) {
        return Side{side.root, child_of(side.map, spec.key), side.name};
    };
    // What may be a plain value too is told as a whole, unless both are mappings.
    const auto is_map = [&](const Side& side) {
        const Node* node = inner(side).map;
        return node != nullptr && node->kind == Node::Kind::kMap;
    };
    const bool only_map = spec.forms == form::kMap;
    if ((spec.forms & form::kMap) != 0 && (only_map || (is_map(a) && is_map(b))))
        return section(spec.child, inner(a), inner(b), path);
    if ((spec.forms & (form::kNamedMaps | form::kMaps)) != 0)
        return entries(spec, inner(a), inner(b), path);
    if (is_unread(spec, a) && is_unread(spec, b)) return;
    const SceneDifference difference{path, text(spec, a), text(spec, b)};
    const bool both = child_of(a.map, spec.key) != nullptr && child_of(b.map, spec.key) != nullptr;
    // Written out in one scene, and left to its default in the other.
    if (difference.first != difference.second || both) found.push_back(difference);
}

/// Named mappings and lists of mappings: by name where there is one, else by place.
void Comparison::entries(const KeySpec& spec, const Side& a, const Side& b,
                         const std::string& path) {
    const auto name_of = [&](const Node& list, std::size_t i) {
        const Node& entry = list.children[i];
        if (!entry.key.empty()) return entry.key;
        const Node* name = entry.find("name");
        return name != nullptr ? name->text : fmt::format("[{}]", i);
    };
    const auto entry_of = [&](const Node* list, const std::string& name) -> const Node* {
        for (std::size_t i = 0; list != nullptr && i < list->children.size(); ++i)
            if (name_of(*list, i) == name) return &list->children[i];
        return nullptr;
    };
    std::vector<std::string> names;
    for (const Node* list : {a.map, b.map})
        for (std::size_t i = 0; list != nullptr && i < list->children.size(); ++i)
            if (list == a.map || entry_of(a.map, name_of(*list, i)) == nullptr)
                names.push_back(name_of(*list, i));
    for (const std::string& name : names) {
        const Side x{a.root, entry_of(a.map, name), name}, y{b.root, entry_of(b.map, name), name};
        const std::string there = path + (name[0] == '[' ? "" : ".") + name;
        const bool material = spec.key == "materials";  // one that is left out has defaults
        if ((x.map != nullptr && y.map != nullptr) || material)
            section(spec.child, x, y, there);
        else
            found.push_back(
                {there, x.map != nullptr ? "there" : "none", y.map != nullptr ? "there" : "none"});
    }
}

}  // namespace

std::vector<SceneDifference> scene_differences(std::string_view first,
                                               const std::vector<Override>& first_overrides,
                                               std::string_view second,
                                               const std::vector<Override>& second_overrides) {
    const KeyTable table;
    const Node a = document(first, first_overrides, table);
    const Node b = document(second, second_overrides, table);
    return std::move(Comparison(table, a, b).found);
}

}  // namespace carom
