// Materials, pair rules, and warnings about what has no effect: friction that only one partner
// names, or what needs friction and has none.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>
#include <set>
#include <utility>

#include "scene/build.h"
#include "scene/catalogue.h"
#include "scene/scalar.h"
#include "scene/virtual_body.h"

namespace carom {

namespace {

int add_material(Build& build, Material material, const Node* node) {
    const int index = static_cast<int>(build.scene.materials.size());
    build.material_index.emplace(material.name, index);
    build.scene.materials.push_back(std::move(material));
    build.material_nodes.push_back(node);
    return index;
}

/// A coefficient as a number, or over the approach speed; neither where the mapping has none.
struct RestitutionValue {
    std::optional<double> number;
    std::optional<RestitutionLaw> law;
};

RestitutionValue restitution_of(Build& build, const Fields& fields) {
    const Node* node = fields.find("restitution");
    if (node == nullptr) return {};
    if (node->kind == Node::Kind::kMap)
        return {{}, restitution_law_of(build, fields.child("restitution"))};
    return {node_number(*node), {}};
}

/// What materials and pairs name besides restitution.
template <class Named>
void read_contact(const Fields& fields, Named& named) {
    named.friction = fields.maybe_number("friction");
    named.rolling = fields.maybe_number("rolling");
    named.pivoting = fields.maybe_number("pivoting");
    named.tangential_restitution = fields.maybe_number("tangential_restitution");
}

/// A declared material. One that bears a preset's name starts from the catalogue's.
void build_material(Build& build, const Node& node) {
    const Fields fields = build.fields(Section::kMaterial, &node);
    Material material;
    material.name = node.key;
    material.mark = node.key_mark;
    if (const Preset* preset = find_preset(node.key)) material.virtual_body = preset->virtual_body;
    const RestitutionValue restitution = restitution_of(build, fields);
    if (restitution.number)
        material.virtual_body =
            virtual_body_for(*restitution.number, build.scene.simulation.restitution_constant);
    if (restitution.law) material.virtual_body = {};
    material.restitution_law = restitution.law;
    if (fields.has("virtual_body")) {
        const Fields body = fields.child("virtual_body");
        material.virtual_body = {body.maybe_number("distance").value_or(0),
                                 body.maybe_number("velocity").value_or(1)};
    }
    read_contact(fields, material);
    add_material(build, std::move(material), &node);
}

std::vector<std::string> material_names(const Build& build) {
    std::set<std::string> names;
    for (const auto& [name, index] : build.material_index)
        if (!name.empty()) names.insert(name);
    for (const std::string& name : preset_names()) names.insert(name);
    return {names.begin(), names.end()};
}

void build_pair(Build& build, const Node& node, std::set<std::array<int, 2>>& seen) {
    const Fields fields = build.fields(Section::kPair, &node);
    const Node* between = fields.find("between");
    if (between == nullptr) return;
    PairRule rule;
    rule.between = {resolve_material(build, between->children[0]),
                    resolve_material(build, between->children[1])};
    RestitutionValue restitution = restitution_of(build, fields);
    rule.restitution = restitution.number;
    rule.restitution_law = std::move(restitution.law);
    read_contact(fields, rule);
    rule.mark = node.mark;
    std::array<int, 2> ordered = rule.between;
    if (ordered[0] > ordered[1]) std::swap(ordered[0], ordered[1]);
    if (ordered[0] != 0 && !seen.insert(ordered).second)
        build.report.error(*between,
                           fmt::format("the pair of '{}' and '{}' stands twice",
                                       between->children[0].text, between->children[1].text));
    build.scene.pairs.push_back(rule);
}

/// A number of materials that multiplies, so that both partners have to name it.
struct Factor {
    const char* name;
    std::optional<double> Material::*of_material;
    std::optional<double> PairRule::*of_pair;
};

/// Rules that name it, each with the smaller index first.
std::set<std::array<int, 2>> rules_of(const Scene& scene, const Factor& factor) {
    std::set<std::array<int, 2>> rules;
    for (const PairRule& rule : scene.pairs) {
        const auto [a, b] = std::minmax(rule.between[0], rule.between[1]);
        if (rule.*factor.of_pair) rules.insert({a, b});
    }
    return rules;
}

/// The materials that bodies have, in order, and whether a ball has them: surfaces never meet each
/// other.
std::map<int, bool> materials_in_use(const Scene& scene) {
    std::map<int, bool> on_ball;
    for (const Surface& surface : scene.surfaces) on_ball[surface.material];
    for (const Ball& ball : scene.balls) on_ball[ball.material] = true;
    return on_ball;
}

void warn_of_half(Build& build, const Factor& factor) {
    const Scene& scene = build.scene;
    constexpr std::size_t kMostNamed = 20;  // bounds the work too, where materials are thousands
    const std::map<int, bool> in_use = materials_in_use(scene);
    const std::set<std::array<int, 2>> rules = rules_of(scene, factor);
    const auto value_of = [&](int material) {
        return scene.materials[static_cast<std::size_t>(material)].*factor.of_material;
    };
    std::vector<std::pair<int, bool>> without;
    for (const auto& [material, on_ball] : in_use)
        if (!value_of(material)) without.emplace_back(material, on_ball);

    std::map<int, std::vector<std::string>> partners;  // material with friction -> those without
    for (const auto& [with, on_ball] : in_use) {
        if (!(value_of(with).value_or(0) > 0)) continue;
        std::vector<std::string> names;
        for (const auto& [other, other_on_ball] : without) {
            const auto [a, b] = std::minmax(with, other);
            if ((!on_ball && !other_on_ball) || rules.contains({a, b})) continue;
            if (names.size() == kMostNamed) {
                names.emplace_back("and more");
                break;
            }
            const std::string& name = scene.materials[static_cast<std::size_t>(other)].name;
            names.push_back(name.empty() ? "the default material" : "'" + name + "'");
        }
        if (!names.empty()) partners[with] = std::move(names);
    }
    for (const auto& [material, names] : partners) {
        const auto index = static_cast<std::size_t>(material);
        build.report.warning(
            *build.material_nodes[index]->find(factor.name),
            fmt::format("material '{}' names {}, but it may meet what names none ({}), and between "
                        "them there will be none; give both a {}, or name it in 'pairs'",
                        scene.materials[index].name, factor.name, fmt::join(names, ", "),
                        factor.name));
    }
}

}  // namespace

int resolve_material(Build& build, const Node& reference) {
    const auto known = build.material_index.find(reference.text);
    if (known != build.material_index.end()) return known->second;
    if (find_preset(reference.text) != nullptr) return preset_material(build, reference.text);
    constexpr std::size_t kMostCompared = 1000;  // the names are copied for each reference
    const bool few = build.material_index.size() <= kMostCompared && !build.report.is_full();
    const std::string meant = few ? suggestion(reference.text, material_names(build)) : "";
    build.report.error(
        reference, fmt::format("there is no material {}{}", quoted_excerpt(reference.text), meant));
    return 0;
}

int preset_material(Build& build, const std::string& preset_name) {
    const auto known = build.material_index.find(preset_name);
    if (known != build.material_index.end()) return known->second;
    Material material;
    material.name = preset_name;
    material.virtual_body = find_preset(preset_name)->virtual_body;
    return add_material(build, std::move(material), nullptr);
}

void build_materials(Build& build) {
    add_material(build, Material{}, nullptr);  // the default: index 0, no name
    for (const Node& node : build.entries("materials")) build_material(build, node);
    std::set<std::array<int, 2>> seen;
    for (const Node& node : build.entries("pairs")) build_pair(build, node, seen);
}

void warn_of_half_friction(Build& build) {
    warn_of_half(build, {"friction", &Material::friction, &PairRule::friction});
    warn_of_half(build, {"rolling", &Material::rolling, &PairRule::rolling});
}

void warn_without_friction(Build& build) {
    const Scene& scene = build.scene;
    std::set<int> rough;  // materials that have friction, with a partner at least
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].friction.value_or(0) > 0) rough.insert(static_cast<int>(i));
    for (const PairRule& rule : scene.pairs)
        if (rule.friction.value_or(0) > 0) rough.insert(rule.between.begin(), rule.between.end());
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        for (const char* key : {"rolling", "tangential_restitution"}) {
            const Node* material = build.material_nodes[i];
            const Node* node = material == nullptr ? nullptr : material->find(key);
            if (node == nullptr || !node->valid || rough.contains(static_cast<int>(i))) continue;
            build.report.warning(
                *node, fmt::format("material '{}' names {}, but no friction: what does not grip "
                                   "does not need it; give it a friction, or name one in 'pairs'",
                                   scene.materials[i].name, key));
        }
}

}  // namespace carom
