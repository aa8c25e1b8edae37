#include "render/runs/rebound_verdict.h"

#include <fmt/format.h>

namespace carom {

std::optional<ReboundVerdict> judge_rebound(const Scene& scene, const Motion& motion) {
    if (!scene.test) return std::nullopt;
    const ReboundTest& test = *scene.test;
    const auto ball = static_cast<std::size_t>(test.ball);
    const std::vector<Peak>& peaks = motion.peaks.at(ball);
    ReboundVerdict verdict;
    if (peaks.empty()) return verdict;
    verdict.rebounded = true;
    verdict.time_s = peaks.front().time;
    verdict.height_m = peaks.front().height + (test.to_top ? 2 * scene.balls[ball].radius : 0.0);
    // A ball that is made to reach a limit exactly does so within rounding.
    constexpr double kRounding = 1e-9;  // of the height
    const double slack = kRounding * verdict.height_m;
    verdict.passes =
        verdict.height_m >= test.low_m - slack && verdict.height_m <= test.high_m + slack;
    return verdict;
}

std::string verdict_text(const Scene& scene, const ReboundVerdict& verdict) {
    const ReboundTest& test = *scene.test;
    const std::string& ball = scene.balls[static_cast<std::size_t>(test.ball)].name;
    const std::string rule = test.rule.empty() ? "" : fmt::format(" ({})", test.rule);
    const std::string band = fmt::format("{} to {} m", test.low_m, test.high_m);
    const std::string head =
        fmt::format("{} {}{}: ", ball, verdict.passes ? "passes" : "does not pass", rule);
    if (!verdict.rebounded) return head + "no rebound within the motion, not " + band;
    return head + fmt::format("rebound to its {} {:.4f} m, {} {}", test.to_top ? "top" : "bottom",
                              verdict.height_m, verdict.passes ? "within" : "not", band);
}

}  // namespace carom
