#include "render/overlay/elements.h"

#include <array>

#include "render/marks/labels.h"
#include "render/marks/peaks.h"
#include "render/marks/ruler.h"
#include "render/marks/trails.h"
#include "render/marks/velocity.h"
#include "render/plates/clock.h"
#include "render/plates/plot.h"
#include "render/plates/run_difference.h"
#include "render/plates/text.h"
#include "render/plates/verdict.h"

namespace carom {

std::span<const ElementKind> element_kinds() {
    // Arrows lie below text, names above everything; marks of peaks give way to all that is at a
    // fixed place, and so come after it.
    static const std::array kinds = {ruler_kind(),  clock_kind(),    velocity_kind(),
                                     title_kind(),  run_name_kind(), caption_kind(),
                                     plot_kind(),   verdict_kind(),  run_difference_kind(),
                                     trails_kind(), peaks_kind(),    labels_kind()};
    return kinds;
}

}  // namespace carom
