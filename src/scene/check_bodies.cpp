// What several bodies say together: their names, and overlaps at the start.
#include <fmt/format.h>

#include <set>
#include <string_view>
#include <unordered_map>

#include "scene/build.h"
#include "scene/overlap.h"
#include "scene/scalar.h"

namespace carom {

namespace {

struct NamedPlace {
    const Node* node;
    const char* kind;
};

/// Says what a name belongs to already; `taken` is looked up only, never walked.
void check_name(Build& build, std::unordered_map<std::string_view, NamedPlace>& taken,
                const std::string& name, const Node& node, const char* kind) {
    if (name.empty()) return;  // missing or wrong: reported by the validator
    const auto [first, fresh] = taken.emplace(name, NamedPlace{&node, kind});
    if (fresh) return;
    const Node* name_node = node.find("name");
    const NamedPlace& other = first->second;
    const std::string where =
        other.node->mark.line > 0 ? fmt::format(" in line {}", other.node->mark.line) : "";
    build.report.error(*name_node, fmt::format("the name '{}' is taken already, by the {}{}", name,
                                               other.kind, where));
}

std::string depth_text(double depth_m) { return fmt::format("{:.6g} m", depth_m); }

void report_balls(Build& build, const BallOverlap& overlap) {
    const auto first = static_cast<std::size_t>(overlap.first);
    const auto second = static_cast<std::size_t>(overlap.second);
    build.report.error(*build.ball_origins[second].node,
                       fmt::format("the balls '{}' and '{}' overlap by {} at the start",
                                   build.scene.balls[first].name, build.scene.balls[second].name,
                                   depth_text(overlap.depth)));
}

void report_surface(Build& build, const SurfaceOverlap& overlap) {
    const auto ball = static_cast<std::size_t>(overlap.ball);
    const std::string& ball_name = build.scene.balls[ball].name;
    const std::string& surface_name =
        build.scene.surfaces[static_cast<std::size_t>(overlap.surface)].name;
    // Whoever puts a ball's centre inside of a body most likely means a container.
    const bool inside = overlap.behind_by == 0 && overlap.depth > build.scene.balls[ball].radius;
    std::string message =
        overlap.behind_by > 0
            ? fmt::format(
                  "the ball '{}' is behind the plane '{}': its centre is {} on the far side",
                  ball_name, surface_name, depth_text(overlap.behind_by))
            : fmt::format("the ball '{}' and the surface '{}' overlap by {} at the start",
                          ball_name, surface_name, depth_text(overlap.depth));
    if (inside)
        message += "; surfaces are solid: for a container take a bowl, a pipe, or a room of planes";
    build.report.error(*build.ball_origins[ball].node, message);
}

}  // namespace

void check_names(Build& build) {
    const Scene& scene = build.scene;
    std::unordered_map<std::string_view, NamedPlace> taken;  // the names are the scene's
    taken.reserve(scene.surfaces.size() + scene.balls.size());
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
        check_name(build, taken, scene.surfaces[i].name, *build.surface_origins[i].node, "surface");
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        check_name(build, taken, scene.balls[i].name, *build.ball_origins[i].node, "ball");
}

void check_overlaps(Build& build) {
    std::vector<bool> sound_balls, sound_surfaces;
    for (const BodyOrigin& origin : build.ball_origins) sound_balls.push_back(origin.sound);
    for (const BodyOrigin& origin : build.surface_origins) sound_surfaces.push_back(origin.sound);
    const OverlapList found = find_overlaps(build.scene, sound_balls, sound_surfaces);
    if (found.too_many)
        build.report.error(
            build.root,
            fmt::format("too many balls lie abreast of too many surfaces: {} balls "
                        "and {} surfaces make more than {} pairs to look at; take "
                        "fewer of either",
                        build.scene.balls.size(), build.scene.surfaces.size(), kMostComparisons));

    // A grid that is too narrow overlaps in thousands of pairs: one per pair of entries is enough.
    std::set<std::pair<const Node*, const Node*>> told;
    for (const BallOverlap& overlap : found.balls) {
        const Node* first = build.ball_origins[static_cast<std::size_t>(overlap.first)].node;
        const Node* second = build.ball_origins[static_cast<std::size_t>(overlap.second)].node;
        if (told.emplace(first, second).second) report_balls(build, overlap);
    }
    std::set<std::pair<const Node*, int>> told_surfaces;
    for (const SurfaceOverlap& overlap : found.surfaces) {
        const Node* ball = build.ball_origins[static_cast<std::size_t>(overlap.ball)].node;
        if (told_surfaces.emplace(ball, overlap.surface).second) report_surface(build, overlap);
    }
}

}  // namespace carom
