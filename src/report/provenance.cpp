#include "report/provenance.h"

#include <fmt/format.h>

namespace carom {

std::string made_from(const Scene& scene) {
    return fmt::format("carom {}, scene {:016x}", CAROM_VERSION, scene.fingerprint);
}

PngNotes picture_notes(const Scene& scene, double time_s) {
    PngNotes notes;
    if (!scene.title.empty()) notes.texts.emplace_back("Title", scene.title);
    notes.texts.emplace_back("Software", "carom " CAROM_VERSION);
    notes.texts.emplace_back("Scene", fmt::format("{:016x}", scene.fingerprint));
    notes.texts.emplace_back("Time", fmt::format("{:.9g} s", time_s));
    return notes;
}

}  // namespace carom
