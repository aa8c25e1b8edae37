// What the tests of the scene reader share.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/reader.h"

namespace carom {

inline std::string all_text(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics.items()) text += diagnostic.text() + "\n";
    return text;
}

/// The scene of a text that must be right.
inline Scene scene_of(const std::string& text, const std::vector<Override>& overrides = {}) {
    SceneResult result = read_scene(text, "t.yaml", overrides);
    EXPECT_TRUE(result.scene.has_value()) << all_text(result.diagnostics);
    return result.scene.value_or(Scene{});
}

/// Everything that is wrong with a text, one per line, "" if nothing is.
inline std::string errors_of(const std::string& text, const std::vector<Override>& overrides = {}) {
    const SceneResult result = read_scene(text, "t.yaml", overrides);
    EXPECT_EQ(result.scene.has_value(), !result.diagnostics.has_errors());
    return all_text(result.diagnostics);
}

}  // namespace carom
