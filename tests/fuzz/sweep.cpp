// The file of a sweep over a fixed base, and the values of its first and last runs.
#include <algorithm>

#include "core/failure.h"
#include "sweep/file/plan.h"
#include "sweep/file/sweep_file.h"
#include "target.h"

namespace carom::fuzz {

namespace {

constexpr const char* kBase = R"(carom: 1
simulation: {duration: 1}
materials: {rubber: {restitution: 0.8}}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}, material: rubber}]
balls: [{name: a, radius: 0.1, position: [0, 0, 1], material: rubber}]
film: {size: [64, 36], fps: 10}
)";

/// A base that reads the terminal, or a device, would wait for ever: that is for those who run it.
bool names_another_base(std::string_view text) {
    for (std::size_t at = text.find("base"); at != std::string_view::npos;
         at = text.find("base", at + 1))
        if (text.substr(at, 15) != "base: base.yaml" && text.substr(at, 9) != "base.yaml")
            return true;
    return false;
}

}  // namespace

CAROM_FUZZ_TARGET(sweep) {
    const std::string_view text = input;
    if (names_another_base(text)) return;
    static const std::string base = file_beside("base.yaml", kBase);
    const std::string path = file_with(text, ".yaml");
    try {
        const SweepResult result = read_sweep_file(path, {});
        if (result.sweep.has_value() == result.diagnostics.has_errors())
            broken_promise("a sweep with errors, or none without");
        for (const Diagnostic& d : result.diagnostics.items())
            if (d.shown().empty()) broken_promise("an empty message");
        if (!result.sweep) return;
        const Plan plan(*result.sweep);
        constexpr std::int64_t kLooked = 20;
        for (std::int64_t run = 0; run < std::min(plan.count(), kLooked); ++run) {
            if (plan.values(run).size() != result.sweep->axes.size())
                broken_promise("a run without a value of each axis");
        }
        if (plan.count() > 0) (void)plan.values(plan.count() - 1);
    } catch (const Failure&) {
    }
}

}  // namespace carom::fuzz
