// The steps from text to a scene one by one, for those who make many scenes from one document.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "scene/document.h"
#include "scene/keys.h"
#include "scene/reader.h"
#include "scene/report.h"
#include "scene/scene.h"

namespace carom {

/// The document with the overrides put in, not validated; none where it is no YAML or no mapping.
std::optional<Node> parse_scene_tree(std::string_view text, const std::vector<Override>& overrides,
                                     const KeyTable& table, Report& report);

/// The scene of a document, none where the report has errors. `root` is marked where it is wrong
/// (Node::valid): to use a document again, give a copy.
std::optional<Scene> scene_of_tree(Node& root, const KeyTable& table, Report& report);

/// What the report has found, in order and with the lines of its file; takes it from there.
Diagnostics shown_diagnostics(std::string_view text, Report& report);

}  // namespace carom
