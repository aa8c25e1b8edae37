// Coefficients of restitution that depend on the approach speed: from the document, and whether
// pairs of them make sense together.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "scene/build.h"
#include "scene/scalar.h"

namespace carom {

namespace {

std::vector<double> numbers_of(const Node& list) {
    std::vector<double> numbers;
    for (const Node& entry : list.children) numbers.push_back(node_number(entry));
    return numbers;
}

/// Points in order, as many values as speeds.
bool are_points(Build& build, const Node& speeds, const Node& values) {
    constexpr std::size_t kFewest = 2;
    if (speeds.children.size() < kFewest) {
        build.report.error(speeds, fmt::format("'speed' must have at least {} numbers, not {}; for "
                                               "one, write a number instead of the mapping",
                                               kFewest, speeds.children.size()));
        return false;
    }
    if (speeds.children.size() != values.children.size()) {
        build.report.error(values, fmt::format("'value' must have as many numbers as 'speed', {}, "
                                               "not {}",
                                               speeds.children.size(), values.children.size()));
        return false;
    }
    for (std::size_t i = 1; i < speeds.children.size(); ++i) {
        const double before = node_number(speeds.children[i - 1]);
        const double here = node_number(speeds.children[i]);
        if (here > before) continue;
        build.report.error(speeds.children[i],
                           fmt::format("'speed' must increase: {} stands after {}",
                                       number_text(here), number_text(before)));
        return false;
    }
    return true;
}

std::string falling_text(const FallingSeparation& falls) {
    return fmt::format(
        "the separation speed must not fall where the approach is faster: from {:.4g} m/s to "
        "{:.4g} m/s it falls from {:.4g} m/s to {:.4g} m/s",
        falls.from, falls.to, falls.separation_from, falls.separation_to);
}

const RestitutionLaw* law_of(const Scene& scene, int material) {
    const auto& law = scene.materials[static_cast<std::size_t>(material)].restitution_law;
    return law ? &*law : nullptr;
}

}  // namespace

std::optional<RestitutionLaw> restitution_law_of(Build& build, const Fields& fields) {
    std::optional<RestitutionLaw> law;
    const Node *speeds = fields.find("speed"), *values = fields.find("value");
    const Node* at = speeds;
    if (fields.has("power")) {
        const Fields power = fields.child("power");
        at = fields.find("power");
        law = PowerRestitution{power.maybe_number("value").value_or(1), power.number("at_speed"),
                               power.maybe_number("exponent").value_or(0)};
    } else if (fields.has("viscoelastic")) {
        at = fields.find("viscoelastic");
        law =
            ViscoelasticRestitution{fields.child("viscoelastic").maybe_number("gamma").value_or(0)};
    } else if (speeds != nullptr && values != nullptr && are_points(build, *speeds, *values)) {
        law = MonotoneCurve(numbers_of(*speeds), numbers_of(*values));
        at = values;
    }
    if (!law) return {};
    if (const auto falls = falling_separation(*law)) {
        build.report.error(*at, falling_text(*falls));
        return {};
    }
    return law;
}

void check_restitution_laws(Build& build) {
    const Scene& scene = build.scene;
    std::set<int> of_surfaces, in_use;
    std::map<int, int> balls_of;
    for (const Surface& surface : scene.surfaces) of_surfaces.insert(surface.material);
    for (const Ball& ball : scene.balls) ++balls_of[ball.material];
    in_use = of_surfaces;
    for (const auto& [material, balls] : balls_of) in_use.insert(material);
    const auto may_meet = [&](int a, int b) {
        if (a == b) return balls_of.contains(a) && (balls_of[a] > 1 || of_surfaces.contains(a));
        return balls_of.contains(a) || balls_of.contains(b);
    };
    std::set<std::array<int, 2>> ruled;
    for (const PairRule& rule : scene.pairs)
        if (rule.restitution || rule.restitution_law)
            ruled.insert({std::min(rule.between[0], rule.between[1]),
                          std::max(rule.between[0], rule.between[1])});
    std::vector<int> with_law;
    for (const int material : in_use)
        if (law_of(scene, material) != nullptr) with_law.push_back(material);
    // Bounds the work where materials are thousands, or their tables have thousands of entries.
    constexpr std::size_t kMostPairs = 5000, kMostEntries = 100'000;
    std::size_t looked_at = 0, entries = 0;
    const auto entries_of = [&](int material) {
        const auto* curve = std::get_if<MonotoneCurve>(law_of(scene, material));
        return curve == nullptr ? std::size_t{1} : curve->x().size();
    };
    for (const int a : with_law)
        for (const int b : with_law) {
            if (b < a || !may_meet(a, b) || ruled.contains({a, b})) continue;
            entries += entries_of(a) + entries_of(b);
            if (++looked_at > kMostPairs || entries > kMostEntries) return;
            const auto falls = falling_separation(*law_of(scene, a), law_of(scene, b));
            if (!falls) continue;
            const auto name = [&](int m) -> const std::string& {
                return scene.materials[static_cast<std::size_t>(m)].name;
            };
            build.report.error(*build.material_nodes[static_cast<std::size_t>(b)],
                               fmt::format("materials '{}' and '{}' may meet, and of the product "
                                           "of their coefficients {}; give the pair a "
                                           "'restitution' of its own in 'pairs'",
                                           name(a), name(b), falling_text(*falls)));
        }
}

}  // namespace carom
