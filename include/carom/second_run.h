// Two runs in one picture.
#pragma once

#include <carom/motion.h>

#include <optional>

CAROM_NAMESPACE_BEGIN

/// A run to show with the first: as ghosts in the same picture, or in a half of its own. Balls of
/// equal names are compared. Camera, film and overlay are the first scene's; as ghosts both have to
/// have the same surfaces.
struct Against {
    Scene scene;
    Motion motion;  ///< of `scene`; a shorter one than the first's stays at its end
    bool side = false;
};

/// The run that the scene's own key `against` names, simulated: without the key there is none. A
/// path there is seen from the folder of the scene's file. Throws SceneError for that scene's
/// mistakes, Error where it cannot be read, Stopped.
CAROM_API std::optional<Against> second_run(const Scene& scene, const Control& control = {});

CAROM_NAMESPACE_END
