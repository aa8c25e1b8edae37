#include "sweep/file/sweep_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "scene/overrides.h"
#include "scene/report.h"
#include "scene/validate.h"
#include "sweep/file/random_scene.h"
#include "sweep/file/results.h"

namespace carom {

namespace {

/// Each mistake once, however many values show it.
class Findings {
  public:
    explicit Findings(Diagnostics& all) : all_(all) {}
    void add(const Diagnostics& some) {
        for (const Diagnostic& one : some.items())
            if (one.severity == Severity::kError &&
                seen_.emplace(one.file, one.mark.line, one.mark.column, one.message).second)
                all_.add(one);
    }

  private:
    Diagnostics& all_;
    std::set<std::tuple<std::string, int, int, std::string>> seen_;
};

/// Those of a draw that are looked at.
std::vector<Node> samples(const Draw& draw) {
    constexpr std::int64_t kMostLooked = 1000;
    constexpr double kNearlyOne = 1 - 1e-15;
    if (!draw.values().empty() && draw.levels() <= kMostLooked) return draw.values();
    if (!draw.has_ends()) return {draw.at(0.5)};
    return {draw.at(0), draw.at(0.5), draw.at(kNearlyOne)};
}

/// A report in which kSweepSource is the sweep's file.
Report report_of(const Sweep& sweep) {
    Report report(sweep.base_file);
    report.add_source(sweep.file);
    return report;
}

void check_axis(const Sweep& sweep, const SweepAxis& axis, Findings& findings) {
    for (const Node& value : samples(axis.draw)) {
        Report report = report_of(sweep);
        Node root = sweep.base;
        if (set_value(root, axis.path, value, axis.origin, sweep.scene_keys, report))
            validate_section(root, Section::kScene, sweep.scene_keys, report);
        findings.add(report.diagnostics());
    }
}

/// A group's balls, at a place that stands for any.
void check_group(const Sweep& sweep, const RandomBalls& group, Findings& findings) {
    std::vector<Node> middle;
    for (const SweepAxis& one : group.each) middle.push_back(one.draw.at(0.5));
    for (std::size_t i = 0; i < group.each.size(); ++i)
        for (const Node& value : samples(group.each[i].draw)) {
            Report report = report_of(sweep);
            Node root = sweep.base;
            std::vector<Node> values = middle;
            values[i] = value;
            add_ball(sweep, group, group.name + "_0", group.low, values, root, report);
            validate_section(root, Section::kScene, sweep.scene_keys, report);
            findings.add(report.diagnostics());
        }
}

}  // namespace

void check_axes(const Sweep& sweep, Diagnostics& diagnostics) {
    Findings findings(diagnostics);
    for (const SweepAxis& axis : sweep.axes) check_axis(sweep, axis, findings);
    for (const RandomBalls& group : sweep.balls) check_group(sweep, group, findings);
    Report report = report_of(sweep);
    Node root = sweep.base;
    draw_camera(sweep, 0, root, report);
    validate_section(root, Section::kScene, sweep.scene_keys, report);
    findings.add(report.diagnostics());
}

void check_names_of_results(const Sweep& sweep, const Scene& base, const Node& root,
                            const std::string& path, Diagnostics& diagnostics) {
    ResultNames known;
    for (const Ball& ball : base.balls) known.balls.push_back(ball.name);
    for (const Surface& surface : base.surfaces) known.surfaces.push_back(surface.name);
    for (const RandomBalls& group : sweep.balls) known.drawn.push_back(group.name + "_");
    const Node* results = root.find("results");
    if (results == nullptr) return;
    std::vector<std::string> columns = {"run", "motion_hash", "status", "reason"};
    for (const SweepAxis& axis : sweep.axes) columns.push_back(axis.path);
    for (const Node& one : results->children) {
        if (std::ranges::find(columns, one.key) != columns.end())
            diagnostics.add({Severity::kError, path, one.key_mark,
                             fmt::format("'{}' is a column already; name it otherwise", one.key)});
        const std::string wrong = wrong_expression(one.text, known);
        if (!wrong.empty()) diagnostics.add({Severity::kError, path, one.mark, wrong});
    }
}

std::string line_of(std::string_view text, int number) {
    for (int line = 1; line < number; ++line) {
        const std::size_t end = text.find('\n');
        if (end == text.npos) return "";
        text.remove_prefix(end + 1);
    }
    std::string line(text.substr(0, text.find('\n')));
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

}  // namespace carom
