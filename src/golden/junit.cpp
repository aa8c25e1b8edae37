// JUnit's XML of a golden report.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/markup.h"
#include "golden/golden_name.h"
#include "golden/golden_report.h"

namespace carom {

namespace {

/// One case. What has no golden or another one fails; what could not be compared is an error.
std::string test_case(const StillCheck& check) {
    std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\"",
                                   escaped(scene_of_still(check.still.name).value_or("")),
                                   escaped(check.still.name), escaped(check.still.scene));
    if (check.outcome == Outcome::kSame) return text + "/>\n";
    const char* element = check.outcome == Outcome::kUnreadable ? "error" : "failure";
    const std::string message = check.missed.empty() ? check.why : check.missed;
    text += fmt::format(">\n      <{} type=\"{}\" message=\"{}\">", element,
                        outcome_word(check.outcome), escaped(message));
    text += fmt::format("{}&#10;golden: {}&#10;", escaped(check.why), escaped(check.still.golden));
    if (!check.drawn_path.empty()) text += fmt::format("drawn: {}&#10;", escaped(check.drawn_path));
    return text + fmt::format("drawn by {}</{}>\n    </testcase>\n", escaped(check.still.renderer),
                              element);
}

std::string suite(const std::string& scene, const std::vector<const StillCheck*>& checks) {
    int failures = 0, errors = 0;
    std::string cases;
    for (const StillCheck* check : checks) {
        cases += test_case(*check);
        failures += check->outcome == Outcome::kDifferent || check->outcome == Outcome::kMissing;
        errors += check->outcome == Outcome::kUnreadable;
    }
    return fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}  "
        "</testsuite>\n",
        escaped(scene), checks.size(), failures, errors, cases);
}

}  // namespace

std::string junit_xml(const GoldenReport& report) {
    std::string suites;
    for (auto first = report.stills.begin(); first != report.stills.end();) {
        const auto last = std::find_if(first, report.stills.end(), [first](const StillCheck& c) {
            return c.still.scene != first->still.scene;
        });
        std::vector<const StillCheck*> checks;
        for (auto it = first; it != last; ++it) checks.push_back(&*it);
        suites += suite(first->still.scene, checks);
        first = last;
    }
    for (const std::string& scene : report.invalid_scenes)
        suites += fmt::format(
            "  <testsuite name=\"{0}\" tests=\"1\" failures=\"0\" errors=\"1\">\n"
            "    <testcase classname=\"{0}\" name=\"scene\" file=\"{0}\">\n"
            "      <error type=\"invalid\" message=\"the scene is invalid\"/>\n"
            "    </testcase>\n  </testsuite>\n",
            escaped(scene));
    const int failures = report.count(Outcome::kDifferent) + report.count(Outcome::kMissing);
    const std::size_t errors =
        static_cast<std::size_t>(report.count(Outcome::kUnreadable)) + report.invalid_scenes.size();
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"carom golden\" "
        "tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}</testsuites>\n",
        report.stills.size() + report.invalid_scenes.size(), failures, errors, suites);
}

}  // namespace carom
