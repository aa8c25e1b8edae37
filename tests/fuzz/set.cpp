// `--set PATH=VALUE`, one a line, over a scene that has some of everything.
#include <vector>

#include "core/failure.h"
#include "scene/reader.h"
#include "target.h"

namespace carom::fuzz {

namespace {

constexpr const char* kBase = R"(carom: 1
title: base
simulation: {duration: 1}
air: {density: 1.2}
materials:
  rubber: {restitution: 0.8, friction: 0.5}
  felt: {restitution: {speed: [1, 2], value: [0.9, 0.8]}}
pairs: [{between: [rubber, felt], restitution: 0.7}]
looks: {red: {color: "#c8102e", style: striped}}
surfaces:
  - {name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: rubber}
  - {name: post, cylinder: {from: [2, 0, 0], to: [2, 0, 1], radius: 0.05}}
  - {name: cup, bowl: {position: [4, 0, 1], radius: 0.5}}
defaults: {ball: {mass: 1}}
balls:
  - {name: a, radius: 0.1, position: [0, 0, 1], material: felt, look: red}
  - {name: c, radius: 0.05, position: [0, 3, 1], repeat: {count: [2, 2, 1], spacing: 0.2}}
camera: {from: [0, -6, 1.5], to: [0, 0, 1]}
film: {size: [160, 90], fps: 30, stills: [0.5]}
overlay: {ruler: true, labels: true}
)";

}  // namespace

CAROM_FUZZ_TARGET(set) {
    constexpr std::size_t kMostOverrides = 8;
    std::vector<Override> overrides;
    std::string_view rest = input;
    while (!rest.empty() && overrides.size() < kMostOverrides) {
        const std::size_t end = rest.find('\n');
        try {
            overrides.push_back(parse_override(std::string(rest.substr(0, end))));
        } catch (const Failure&) {  // no '='
        }
        rest = end == std::string_view::npos ? "" : rest.substr(end + 1);
    }
    const SceneResult result = read_scene(kBase, "base.yaml", overrides);
    if (result.scene.has_value() == result.diagnostics.has_errors())
        broken_promise("a scene with errors, or none without");
    for (const Diagnostic& d : result.diagnostics.items())
        if (d.shown().empty()) broken_promise("an empty message");
}

}  // namespace carom::fuzz
