// What a sweep's file says about its base, held against the base.
#pragma once

#include <string>
#include <string_view>

#include "core/diagnostics.h"
#include "scene/document.h"
#include "scene/scene.h"
#include "sweep/file/sweep_file.h"

namespace carom {

/// Paths that lead nowhere, and values that are wrong whatever the others are: of lists all, of
/// ranges and draws both ends and the middle. What two values do together only their run shows.
void check_axes(const Sweep& sweep, Diagnostics& diagnostics);

/// Expressions that are none, or name what no run can have.
void check_names_of_results(const Sweep& sweep, const Scene& base, const Node& root,
                            const std::string& path, Diagnostics& diagnostics);

/// Line `number` of a text, counted from 1, without its end.
std::string line_of(std::string_view text, int number);

}  // namespace carom
