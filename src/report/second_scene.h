// The second run of a film as its scene names it: where it is read from, and what it is called.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/runs/second_run.h"
#include "scene/reader.h"
#include "scene/scene.h"

namespace carom {

/// A text and what was changed in it.
struct SceneSource {
    std::string text, file;
    std::vector<Override> overrides;
};

/// The scene's key `against`, a path in it as seen from the scene's folder (standard input and
/// texts have none); empty without the key.
std::optional<Against> against_named_in(const Scene& scene);

/// Where the second run's scene comes from; `first` is what `scene` was read from. Throws
/// Failure(kInput) where that cannot be read.
SceneSource second_source(const SceneSource& first, const Against& wanted);

/// Both runs ready for a painter: named, and found fit to be shown together. Throws Failure(kInput)
/// as check_runs() does. `motion` is that of `second`, and is held until `first_ends_s`.
SecondRun make_second_run(const Scene& first, double first_ends_s, const Scene& second,
                          Motion motion, AgainstView view,
                          std::vector<SceneDifference> differences);

/// What the PNGs of a film of two runs say of the second: its fingerprint and how it is shown.
std::string second_text(const Scene& second, AgainstView view);

}  // namespace carom
