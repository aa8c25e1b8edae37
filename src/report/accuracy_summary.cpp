// What the table of `carom accuracy` comes to, in sentences.
#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "report/accuracy.h"

namespace carom {

namespace {

struct Target {
    double error;
    const char* name;
};
constexpr std::array<Target, 3> kTargets = {{{1e-2, "1 %"}, {1e-3, "0.1 %"}, {1e-6, "1e-6"}}};

/// "1 %, 0.1 % and 1e-6".
std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

/// The targets' answers, with those that are the same said once: "for 1 % A, for 0.1 % and 1e-6 B".
template <class Answer>
std::string answers(const std::string& before, const Answer& answer) {
    std::vector<std::pair<std::vector<std::string>, std::string>> groups;
    for (const Target& target : kTargets) {
        const std::string text = answer(target);
        if (text.empty()) continue;
        if (groups.empty() || groups.back().second != text) groups.push_back({{}, text});
        groups.back().first.emplace_back(target.name);
    }
    std::string result;
    for (const auto& [names, text] : groups)
        result += fmt::format("{}{}{} {}", result.empty() ? "" : ", ", before, listed(names), text);
    return result;
}

std::string needed(const AccuracyReport& report, const Target& target) {
    const AccuracyRun* best = report.cheapest(target.error);
    if (best == nullptr) return "none of these";
    return fmt::format("{} ({:.2g} CPU s per s)", best->name(), best->cpu_s_per_s);
}

/// How `fixed` does where `exact` is the answer.
std::string beside(const AccuracyReport& report, const Target& target) {
    const AccuracyRun* best = report.cheapest(target.error);
    if (best == nullptr || best->method != Method::kExact) return "";
    const AccuracyRun* fixed = report.cheapest(target.error, Method::kFixed);
    if (fixed == nullptr) return "with no step";
    return fmt::format("with {:.0f} times the CPU ({}, step {} s)",
                       fixed->cpu_s_per_s / best->cpu_s_per_s,
                       fixed->solver == Solver::kQuick ? "quick" : "world", fixed->step);
}

std::string trust(const AccuracyReport& report) {
    const Sensitivity& s = report.sensitivity;
    std::string text;
    if (s.chaotic)
        text = fmt::format(
            " The motion is chaotic: rounding alone moves a ball by 1 % of the smallest radius "
            "after {:.4g} s; errors are measured up to there.",
            s.trusted_until_s);
    if (!report.closed_form && report.runs.front().steps > 0)
        text += fmt::format(
            " Contacts that act on each other are stepped by exact too ({} steps): its own error "
            "there is not in these numbers.",
            report.runs.front().steps);
    if (s.lyapunov_time_s)
        text += fmt::format(" Small differences grow by e every {:.2g} s (Lyapunov time).",
                            *s.lyapunov_time_s);
    return text;
}

}  // namespace

std::string accuracy_summary(const AccuracyReport& report) {
    std::string text = fmt::format(
        "Of the motion's {:.3g} m this scene needs {}", report.extent_m,
        answers("for ", [&report](const Target& target) { return needed(report, target); }));
    const std::string fixed =
        answers("", [&report](const Target& target) { return beside(report, target); });
    if (!fixed.empty()) text += "; fixed reaches " + fixed;
    return text + "." + trust(report);
}

}  // namespace carom
