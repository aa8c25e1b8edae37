// The reader of scenes: any bytes give a scene or errors, never both or neither, and every message
// can be shown.
#include "scene/reader.h"
#include "target.h"

namespace carom::fuzz {

CAROM_FUZZ_TARGET(scene) {
    const SceneResult result = read_scene(input, "fuzz.yaml");
    if (result.scene.has_value() == result.diagnostics.has_errors())
        broken_promise("a scene with errors, or none without");
    for (const Diagnostic& d : result.diagnostics.items()) {
        const std::string shown = d.shown();
        if (shown.empty() || shown.back() != '\n' || d.message.find('\n') != std::string::npos)
            broken_promise("a message that is not one line: " + shown);
        for (const char c : shown)
            if (static_cast<unsigned char>(c) < 0x20 && c != '\n')
                broken_promise("a message that could move the cursor: " + shown);
    }
}

}  // namespace carom::fuzz
