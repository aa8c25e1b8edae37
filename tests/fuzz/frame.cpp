// From the text of a scene to a picture of 64x36 at the end of its motion.
#include "bounded_run.h"
#include "core/failure.h"
#include "render/painter.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(frame) {
    const auto scene = small_scene(input);
    if (!scene) return;
    const auto result = bounded_motion(*scene);
    if (!result) return;
    PainterOptions options;
    options.width_px = scene->film.width_px;
    options.height_px = scene->film.height_px;
    options.few_pictures = true;
    try {
        Painter painter(*scene, result->motion, options);
        Image picture;
        painter.paint(result->motion.duration, picture);
        if (picture.width_px != options.width_px || picture.height_px != options.height_px)
            broken_promise("a picture of another size");
    } catch (const Failure&) {
    }
}

}  // namespace carom::fuzz
