// Holds a document against the table of keys: everything that one key, or one mapping, can say
// about itself. What takes several parts of the scene (names, overlaps) is checked by the builders.
#pragma once

#include "scene/document.h"
#include "scene/keys.h"
#include "scene/report.h"

namespace carom {

/// Reports every unknown or missing key, wrong form and value out of range in `map` and below, and
/// clears `valid` of every node that has such a mistake in it. Returns map.valid.
bool validate_section(Node& map, Section section, const KeyTable& table, Report& report);

/// "a number (m)", "true or false", "one of solid, shell": what `spec` takes, for messages.
std::string expected_text(const KeySpec& spec);

/// "above 0 and at most 170"; "" where every finite number will do.
std::string range_text(const Range& range);

}  // namespace carom
