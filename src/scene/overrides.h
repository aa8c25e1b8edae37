// `--set PATH=VALUE`: values of the command line, put into the document before it is validated.
#pragma once

#include <vector>

#include "scene/document.h"
#include "scene/keys.h"
#include "scene/reader.h"
#include "scene/report.h"

namespace carom {

/// Applies the overrides in their order. Mistakes go to `report` under the name "--set PATH"; nodes
/// that were made here carry that source. PATH: keys, names of entries, or [i] in lists, joined by
/// dots: balls.a.mass, balls[0].mass, film.size[0], materials.rubber.friction.
void apply_overrides(Node& root, const std::vector<Override>& overrides, const KeyTable& table,
                     Report& report);

}  // namespace carom
