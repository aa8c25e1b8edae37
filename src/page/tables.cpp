#include "page/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/markup.h"
#include "page/frame.h"
#include "page/html_table.h"
#include "report/closed_form.h"
#include "sim/contact/restitution.h"

namespace carom {

namespace {

/// Tops of a ball's gap, asked for in order of time.
class PeaksInOrder {
  public:
    explicit PeaksInOrder(const std::vector<Peak>& peaks) : peaks_(peaks) {}
    /// The first top after t and before the ball's next impact at `next`; null for none.
    const Peak* between(double t, double next) {
        while (at_ < peaks_.size() && peaks_[at_].time < t) ++at_;
        return at_ < peaks_.size() && peaks_[at_].time <= next ? &peaks_[at_] : nullptr;
    }

  private:
    const std::vector<Peak>& peaks_;
    std::size_t at_ = 0;
};

std::vector<const Event*> impacts_of(const Motion& motion) {
    std::vector<const Event*> impacts;
    for (const Event& event : motion.events)
        if (event.kind == EventKind::kImpact) impacts.push_back(&event);
    return impacts;
}

/// Of each impact the next one of the same ball, in s; infinity for none.
std::vector<double> next_times(const std::vector<const Event*>& impacts, std::size_t balls) {
    std::vector<double> next(impacts.size()), after(balls, std::numeric_limits<double>::infinity());
    for (std::size_t i = impacts.size(); i-- > 0;) {
        const Event& event = *impacts[i];
        next[i] = after[static_cast<std::size_t>(event.ball)];
        after[static_cast<std::size_t>(event.ball)] = event.time;
        if (!event.other.is_surface)
            after[static_cast<std::size_t>(event.other.index)] = event.time;
    }
    return next;
}

/// An impact's top afterwards; null for none.
std::vector<const Peak*> tops_of(const Motion& motion, const std::vector<const Event*>& impacts) {
    const std::vector<double> next = next_times(impacts, motion.balls.size());
    std::vector<PeaksInOrder> peaks;
    for (const std::vector<Peak>& of_ball : motion.peaks) peaks.emplace_back(of_ball);
    std::vector<const Peak*> tops;
    for (std::size_t i = 0; i < impacts.size(); ++i)
        tops.push_back(
            peaks[static_cast<std::size_t>(impacts[i]->ball)].between(impacts[i]->time, next[i]));
    return tops;
}

/// How far the run is from the closed form, an impact at a time.
class Deviations {
  public:
    explicit Deviations(const std::optional<Motion>& closed) {
        if (!closed) return;
        impacts_.resize(closed->balls.size());
        const std::vector<const Event*> impacts = impacts_of(*closed);
        const std::vector<const Peak*> tops = tops_of(*closed, impacts);
        for (std::size_t i = 0; i < impacts.size(); ++i)
            impacts_[static_cast<std::size_t>(impacts[i]->ball)].push_back(
                {impacts[i]->time, tops[i] != nullptr ? tops[i]->height : 0});
        count_.resize(impacts_.size());
    }
    bool empty() const { return impacts_.empty(); }

    /// Of time [s] and height [relative], as cells; "" where there is nothing to compare with.
    std::array<std::string, 2> cells(const Event& event, const Peak* top) {
        const auto ball = static_cast<std::size_t>(event.ball);
        const std::size_t k = count_[ball]++;
        if (k >= impacts_[ball].size()) return {};
        const Right& right = impacts_[ball][k];
        largest_s_ = std::max(largest_s_, std::abs(event.time - right.time));
        std::string time = fmt::format("{:.1e}", event.time - right.time);
        if (top == nullptr || !(right.height > 0)) return {time, ""};
        const double relative = top->height / right.height - 1;
        largest_ = std::max(largest_, std::abs(relative));
        return {time, fmt::format("{:.1e}", relative + 0.0)};
    }
    double largest_s() const { return largest_s_; }
    double largest() const { return largest_; }

  private:
    struct Right {
        double time = 0, height = 0;
    };
    std::vector<std::vector<Right>> impacts_;
    std::vector<std::size_t> count_;
    double largest_s_ = 0, largest_ = 0;
};

const std::string& other_name(const Event& event, const Motion& motion) {
    const auto& names = event.other.is_surface ? motion.surface_names : motion.ball_names;
    return names[static_cast<std::size_t>(event.other.index)];
}

std::string name_of(const Material& material) {
    return material.name.empty() ? "(no material)" : escaped(material.name);
}

int material_of(const Scene& scene, const Partner& partner) {
    const auto index = static_cast<std::size_t>(partner.index);
    return partner.is_surface ? scene.surfaces[index].material : scene.balls[index].material;
}

/// A material's own coefficient, and what it follows from.
std::string own_text(const Scene& scene, const Material& material) {
    const VirtualBody& body = material.virtual_body;
    const double own =
        restitution_of_time(virtual_time(body), scene.simulation.restitution_constant);
    if (material.restitution_law) return name_of(material) + " over the approach speed";
    std::string text = fmt::format("{} {:.6g}", name_of(material), own);
    if (body.distance_m > 0 && std::isfinite(body.distance_m))
        text += fmt::format(" (x {:.4g} m, v {:.4g} m/s)", body.distance_m, body.velocity_m_s);
    return text;
}

const PairRule* rule_of(const Scene& scene, int a, int b) {
    for (const PairRule& rule : scene.pairs)
        if ((rule.between[0] == a && rule.between[1] == b) ||
            (rule.between[0] == b && rule.between[1] == a))
            return &rule;
    return nullptr;
}

std::string source_text(const Scene& scene, int a, int b) {
    const PairRule* rule = rule_of(scene, a, b);
    if (rule != nullptr && rule->restitution_law) return "of the pair, over the approach speed";
    if (rule != nullptr && rule->restitution)
        return fmt::format("of the pair: {:.6g}", *rule->restitution);
    const Material& first = scene.materials[static_cast<std::size_t>(a)];
    const Material& second = scene.materials[static_cast<std::size_t>(b)];
    return "product: " + own_text(scene, first) + " × " + own_text(scene, second);
}

std::string range_text(double low, double high) {
    return low == high ? fmt::format("{:.6g}", low) : fmt::format("{:.6g} … {:.6g}", low, high);
}

}  // namespace

std::string bounce_table(const Scene& scene, const Motion& motion) {
    const std::vector<const Event*> impacts = impacts_of(motion);
    if (impacts.empty()) return "<p>Nothing meets anything.</p>\n";
    const std::vector<const Peak*> tops = tops_of(motion, impacts);
    Deviations off(closed_form_motion(scene, motion));
    const std::size_t count = std::min(impacts.size(), kMostBounces);
    std::vector<HtmlColumn> columns = {{"Time, s"},
                                       {"Ball"},
                                       {"Meets"},
                                       {"Rises to, m", true},
                                       {"Coefficient", true},
                                       {"Approach, m/s", true}};
    if (!off.empty())
        for (const char* name : {"Time off, s", "Height off"}) columns.push_back({name, true});
    HtmlTable table(
        "bounces",
        fmt::format("{}{}. A click on an instant shows it above.",
                    counted(impacts.size(), "impact"),
                    count < impacts.size() ? fmt::format(", the first {} are listed", count) : ""),
        columns, true);
    for (std::size_t i = 0; i < count; ++i) {
        const Event& event = *impacts[i];
        std::vector<std::string> cells = {
            fmt::format("<button type=\"button\">{:.6f}</button>", event.time),
            escaped(motion.ball_names[static_cast<std::size_t>(event.ball)]),
            escaped(other_name(event, motion)),
            tops[i] != nullptr ? fmt::format("{:.6g}", tops[i]->height) : "",
            fmt::format("{:.6g}", event.restitution),
            fmt::format("{:.4g}", event.approach_speed)};
        if (!off.empty())
            for (std::string& cell : off.cells(event, tops[i])) cells.push_back(std::move(cell));
        table.row(cells, false);
    }
    const std::string about =
        off.empty()
            ? "<p class=\"soft\">This scene has no closed form to be held against: balls meet one "
              "another or several things, or friction or air acts.</p>\n"
            : fmt::format(
                  "<p>Against the closed form, computed apart, impacts are off by at most "
                  "{:.1e} s, heights by {:.1e} of themselves.</p>\n",
                  off.largest_s(), off.largest());
    return about + table.text();
}

std::string pair_table(const Scene& scene, const Motion& motion) {
    struct Met {
        std::size_t impacts = 0;
        double low = 1, high = 0;
    };
    std::map<std::array<int, 2>, Met> met;
    for (const Event* event : impacts_of(motion)) {
        const int a = scene.balls[static_cast<std::size_t>(event->ball)].material;
        const int b = material_of(scene, event->other);
        Met& pair = met[{std::min(a, b), std::max(a, b)}];
        ++pair.impacts;
        pair.low = std::min(pair.low, event->restitution);
        pair.high = std::max(pair.high, event->restitution);
    }
    if (met.empty()) return "";
    HtmlTable table("pairs-met", "Materials that met, with the coefficients of their impacts",
                    {{"Pair"}, {"Impacts", true}, {"Coefficient", true}, {"Comes from"}});
    for (const auto& [pair, numbers] : met)
        table.row({name_of(scene.materials[static_cast<std::size_t>(pair[0])]) + " and " +
                       name_of(scene.materials[static_cast<std::size_t>(pair[1])]),
                   fmt::format("{}", numbers.impacts), range_text(numbers.low, numbers.high),
                   source_text(scene, pair[0], pair[1])});
    return table.text();
}

std::string effect_table(const std::map<std::string, Effect>& effects) {
    HtmlTable table("parts", "Only what the scene needs is modelled and drawn",
                    {{"Part"}, {"Modelled"}, {"Why"}});
    for (const bool on : {true, false})
        for (const auto& [name, effect] : effects)
            if (effect.on == on) table.row({escaped(name), on ? "yes" : "no", escaped(effect.why)});
    return table.text();
}

std::string accuracy_table(const AccuracyReport& report) {
    HtmlTable table("errors",
                    fmt::format("Errors against {} up to {:.6g} s; times are this machine's",
                                report.closed_form ? "the closed form" : "the method exact",
                                report.sensitivity.trusted_until_s),
                    {{"Method"},
                     {"Position, m", true},
                     {"Over the extent", true},
                     {"Impacts, s", true},
                     {"CPU s a second", true},
                     {"Impacts", true},
                     {"Left out"}});
    for (const AccuracyRun& run : report.runs) {
        const auto number = [](double value) { return fmt::format("{:.2e}", value); };
        table.row({escaped(run.name()), run.error ? number(run.error->position_m) : "",
                   run.error ? number(run.error->position_relative) : "",
                   run.error ? number(run.error->impact_time_s) : "",
                   run.cpu_s_per_s > 0 ? number(run.cpu_s_per_s) : "",
                   fmt::format("{}", run.impacts), escaped(run.missing)});
    }
    return "<p>" + escaped(accuracy_summary(report)) + "</p>\n" + table.text();
}

}  // namespace carom
