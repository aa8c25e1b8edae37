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

/// Where a value comes from: a source of the report and a place in it, for mistakes of the path.
struct ValueOrigin {
    int source = 0;
    SourceMark mark{};
};

/// Puts one value where `path` leads. False, with an error in `report`, where it leads nowhere; the
/// tree is then as it was.
bool set_value(Node& root, const std::string& path, Node value, const ValueOrigin& origin,
               const KeyTable& table, Report& report);

}  // namespace carom
