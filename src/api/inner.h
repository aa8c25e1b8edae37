// How the public values hold the inner ones.
#pragma once

#include <carom/motion.h>
#include <carom/scene.h>

#include <string>
#include <utility>

#include "core/check.h"
#include "core/failure.h"
#include "motion/motion.h"
#include "report/second_scene.h"
#include "scene/scene.h"

namespace carom::v1 {

struct Scene::Impl {
    carom::Scene scene;
    std::vector<Diagnostic> warnings;
    SceneSource source;  ///< what it was read from
};

struct Motion::Impl {
    carom::Motion motion;
};

/// Throws SceneError.
Scene scene_from(SceneSource source);

/// Runs `work`; what the library throws inside comes out as Error.
template <class Work>
auto translated(const Work& work) {
    try {
        return work();
    } catch (const Failure& failure) {
        throw Error(failure.what());
    } catch (const Bug& bug) {
        throw Error(std::string(bug.what()) + "\nThis is a bug in carom.");
    }
}

/// The same of work that can be stopped.
template <class Work>
auto translated(const Control& control, const Work& work) {
    try {
        return translated(work);
    } catch (const Error& error) {
        if (control.stop.stop_requested()) throw Stopped(error.what());
        throw;
    }
}

/// Throws Error for a time [s] outside of the motion.
void require_instant(const Motion& motion, double time);

inline Vec3 plain(const carom::Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace carom::v1
