// Materials, pair rules, and the warning about friction that only one partner names.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <utility>

#include "scene/build.h"
#include "scene/catalogue.h"
#include "scene/scalar.h"
#include "scene/virtual_body.h"

namespace carom {

namespace {

int add_material(Build& build, Material material, const Node* friction_node) {
    const int index = static_cast<int>(build.scene.materials.size());
    build.material_index.emplace(material.name, index);
    build.scene.materials.push_back(std::move(material));
    build.friction_nodes.push_back(friction_node);
    return index;
}

/// A declared material. One that bears a preset's name starts from the catalogue's.
void build_material(Build& build, const Node& node) {
    const Fields fields = build.fields(Section::kMaterial, &node);
    Material material;
    material.name = node.key;
    material.mark = node.key_mark;
    if (const Preset* preset = find_preset(node.key)) material.virtual_body = preset->virtual_body;
    if (const auto restitution = fields.maybe_number("restitution"))
        material.virtual_body =
            virtual_body_for(*restitution, build.scene.simulation.restitution_constant);
    if (fields.has("virtual_body")) {
        const Fields body = fields.child("virtual_body");
        material.virtual_body = {body.maybe_number("distance").value_or(0),
                                 body.maybe_number("velocity").value_or(1)};
    }
    material.friction = fields.maybe_number("friction");
    add_material(build, std::move(material), fields.find("friction"));
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
    rule.restitution = fields.maybe_number("restitution");
    rule.friction = fields.maybe_number("friction");
    rule.mark = node.mark;
    std::array<int, 2> ordered = rule.between;
    if (ordered[0] > ordered[1]) std::swap(ordered[0], ordered[1]);
    if (ordered[0] != 0 && !seen.insert(ordered).second)
        build.report.error(*between,
                           fmt::format("the pair of '{}' and '{}' stands twice",
                                       between->children[0].text, between->children[1].text));
    build.scene.pairs.push_back(rule);
}

/// Rules that name friction, each with the smaller index first.
std::set<std::array<int, 2>> friction_rules(const Scene& scene) {
    std::set<std::array<int, 2>> rules;
    for (const PairRule& rule : scene.pairs) {
        const auto [a, b] = std::minmax(rule.between[0], rule.between[1]);
        if (rule.friction) rules.insert({a, b});
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

}  // namespace

int resolve_material(Build& build, const Node& reference) {
    const auto known = build.material_index.find(reference.text);
    if (known != build.material_index.end()) return known->second;
    if (find_preset(reference.text) != nullptr) return preset_material(build, reference.text);
    build.report.error(reference,
                       fmt::format("there is no material {}{}", quoted_excerpt(reference.text),
                                   suggestion(reference.text, material_names(build))));
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
    const Scene& scene = build.scene;
    constexpr std::size_t kMostNamed = 20;  // bounds the work too, where materials are thousands
    const std::map<int, bool> in_use = materials_in_use(scene);
    const std::set<std::array<int, 2>> rules = friction_rules(scene);
    const auto friction_of = [&](int material) {
        return scene.materials[static_cast<std::size_t>(material)].friction;
    };
    std::vector<std::pair<int, bool>> without;
    for (const auto& [material, on_ball] : in_use)
        if (!friction_of(material)) without.emplace_back(material, on_ball);

    std::map<int, std::vector<std::string>> partners;  // material with friction -> those without
    for (const auto& [with, on_ball] : in_use) {
        if (!(friction_of(with).value_or(0) > 0)) continue;
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
            *build.friction_nodes[index],
            fmt::format(
                "material '{}' names friction, but it may meet what names none ({}), and between "
                "them there will be none; give both a friction, or name it in 'pairs'",
                scene.materials[index].name, fmt::join(names, ", ")));
    }
}

}  // namespace carom
