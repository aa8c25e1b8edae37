#include <carom/second_run.h>

#include "api/painting.h"
#include "scene/difference.h"

namespace carom::v1 {

std::optional<Against> second_run(const Scene& scene, const Control& control) {
    return translated(control, [&]() -> std::optional<Against> {
        const std::optional<carom::Against> wanted = against_named_in(scene.impl().scene);
        if (!wanted) return std::nullopt;
        const Scene second = scene_from(second_source(scene.impl().source, *wanted));
        return Against{second, simulate(second, {control.stop, {}}),
                       wanted->view == AgainstView::kSide};
    });
}

void require_own_motion(const Scene& scene, const Motion& motion) {
    if (motion.balls() != scene.balls() || motion.surfaces() != scene.surfaces())
        throw Error("this is the motion of another scene");
}

std::optional<SecondRun> run_to_show(const Scene& scene, const Motion& motion,
                                     const std::optional<Against>& against,
                                     const Control& control) {
    const std::optional<Against> shown = against ? against : second_run(scene, control);
    if (!shown) return std::nullopt;
    require_own_motion(shown->scene, shown->motion);
    const SceneSource &first = scene.impl().source, &second = shown->scene.impl().source;
    return make_second_run(
        scene.impl().scene, motion.duration(), shown->scene.impl().scene,
        shown->motion.impl().motion, shown->side ? AgainstView::kSide : AgainstView::kGhost,
        scene_differences(first.text, first.overrides, second.text, second.overrides));
}

}  // namespace carom::v1
