// The scene format as documents, both made from the table that the reader uses.
#pragma once

#include <string>

namespace carom {

/// JSON Schema (draft 2020-12) of a scene file, pretty-printed.
std::string scene_json_schema();

/// The reference of every key in Markdown, as it stands in docs/scene.md.
std::string scene_reference_markdown();

}  // namespace carom
