// The rows of the table that describe a second run, and what lies behind both.
#include "scene/keys.h"

namespace carom {

std::vector<KeySpec> against_keys() {
    using enum Section;
    using namespace form;
    return {
        {.section = kScene,
         .key = "background",
         .forms = kWord,
         .words = {"sky", "transparent"},
         .fallback = "sky",
         .doc = "`sky`: sky over the surfaces; `transparent`: pictures with alpha, in which planes "
                "are "
                "left out but for the shadows on them.",
         .example = "transparent"},
        {.section = kScene,
         .key = "against",
         .forms = kMap,
         .child = kAgainst,
         .fallback_doc = "none",
         .doc = "A second run in the same picture: another scene, or this one with values set.",
         .example = "{set: [\"simulation.method=fixed\"]}"},

        {.section = kAgainst,
         .key = "scene",
         .forms = kText,
         .fallback_doc = "this scene",
         .doc = "Scene file of the other run, as seen from the folder of this one.",
         .example = "other.yaml"},
        {.section = kAgainst,
         .key = "set",
         .forms = kTexts,
         .fallback_doc = "`[]`",
         .doc = "What is set in the other run, as with --set on the command line.",
         .example = "[\"simulation.method=fixed\"]"},
        {.section = kAgainst,
         .key = "view",
         .forms = kWord,
         .words = {"ghost", "side"},
         .fallback = "ghost",
         .doc = "`ghost`: the other run's balls translucent in the same picture; `side`: the runs "
                "beside each other, seen by the same camera.",
         .example = "side"},
    };
}

}  // namespace carom
