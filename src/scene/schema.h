// The formats of files as documents, made from the tables that the readers use.
#pragma once

#include <string>

#include "scene/keys.h"

namespace carom {

/// JSON Schema (draft 2020-12) of a file, pretty-printed.
std::string json_schema(FileKind kind);

/// The reference of every key in Markdown, as it stands in docs/scene.md and docs/sweeps.md.
std::string reference_markdown(FileKind kind);

}  // namespace carom
