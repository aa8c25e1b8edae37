// From the text of a scene to its motion and the numbers of it.
#include "bounded_run.h"
#include "motion/csv.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(motion) {
    const auto scene = small_scene(input);
    if (!scene) return;
    const auto result = bounded_motion(*scene);
    if (!result) return;
    std::size_t bytes = 0;
    const auto count = [&](const auto& text) { bytes += text.size(); };
    write_motion_csv(result->motion, 20, 1, count, {});
    write_events_csv(result->motion, count);
    if (bytes == 0) broken_promise("no rows");
}

}  // namespace carom::fuzz
