#include "hard_cases_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "report/plot.h"
#include "report/text_table.h"

namespace carom::bench {

namespace {

/// The larger, the worse; what holds is below 1.
double badness(const Outcome& o) {
    switch (o.kind) {
        case Outcome::Kind::kRefused:
            return 0;
        case Outcome::Kind::kDone:
            if (o.limit > 0) return std::min(o.error / o.limit, 1e300);
            return o.error > 0 ? 1e300 : 0;
        case Outcome::Kind::kCut:
            return 1e301;
        case Outcome::Kind::kFailed:
            return 1e302;
        case Outcome::Kind::kCrashed:
            return 1e303;
    }
    return 0;
}

std::string first_sentence(const std::string& text) {
    const std::size_t end = text.find(';');
    return text.substr(0, std::min<std::size_t>(end, 160));
}

/// "1 ms" and "0.1 ms" of one family side by side: "ODE world 1 ms, 0.1 ms".
std::string join_names(const std::vector<const Engine*>& engines) {
    std::string text, family;
    for (const Engine* e : engines) {
        if (!text.empty()) text += ", ";
        text += e->family == family ? e->name.substr(family.size() + 1) : e->name;
        family = e->family;
    }
    return text;
}

}  // namespace

const Outcome& Cell::worst() const {
    return *std::max_element(runs.begin(), runs.end(), [](const Outcome& a, const Outcome& b) {
        return badness(a) < badness(b);
    });
}

bool Cell::holds() const {
    return std::all_of(runs.begin(), runs.end(), [](const Outcome& o) { return o.holds(); });
}

double Cell::cost() const {
    double cpu = 0, simulated = 0;
    for (const Outcome& o : runs) {
        cpu += o.cpu_s;
        simulated += o.simulated_s;
    }
    return simulated > 0 ? cpu / simulated : std::numeric_limits<double>::quiet_NaN();
}

std::string Cell::error_text() const {
    const Outcome& o = worst();
    switch (o.kind) {
        case Outcome::Kind::kRefused:
            return "refused";
        case Outcome::Kind::kDone:
            if (o.error == 0) return "0";
            return std::isfinite(o.error) ? fmt::format("{:.1e}", o.error) : "none";
        case Outcome::Kind::kCut:
            return "cut";
        case Outcome::Kind::kFailed:
            return o.what.find("LCP") != std::string::npos ? "LCP error" : "gives up";
        case Outcome::Kind::kCrashed:
            return "crashes";
    }
    return "";
}

std::string Cell::failure() const {
    const Outcome& o = worst();
    if (o.holds()) return "";
    if (o.kind != Outcome::Kind::kDone) return first_sentence(o.what);
    if (!o.how.empty()) return o.how;
    if (!std::isfinite(o.error)) return o.what;
    return o.error > 0.01 ? o.what : "";
}

std::string markdown_table(const std::vector<Row>& rows, const std::vector<Engine>& engines) {
    std::string text = "| | Case | Reference |", rule = "|---|---|---|";
    for (const Engine& engine : engines) {
        text += fmt::format(" {} |", engine.name);
        rule += "---|";
    }
    text += '\n' + rule + '\n';
    for (const Row& row : rows) {
        text += fmt::format("| {} | {} | {} |", row.one->id, row.one->title, row.one->reference);
        for (const Cell& cell : row.cells) {
            const char* mark = cell.holds() ? "**" : "";
            text += fmt::format(" {0}{1}{0}", mark, cell.error_text());
            if (std::isfinite(cell.cost())) text += fmt::format("<br>{:.1e}", cell.cost());
            text += " |";
        }
        text += '\n';
    }
    return text;
}

std::string markdown_failures(const std::vector<Row>& rows, const std::vector<Engine>& engines) {
    std::string text;
    for (const Row& row : rows) {
        std::vector<std::string> order;
        std::map<std::string, std::vector<const Engine*>> by_words;
        for (std::size_t i = 0; i < engines.size(); ++i) {
            const std::string words = row.cells[i].failure();
            if (words.empty()) continue;
            if (by_words[words].empty()) order.push_back(words);
            by_words[words].push_back(&engines[i]);
        }
        if (order.empty()) continue;
        text += fmt::format("- {}, {}. ", row.one->id, row.one->title);
        for (const std::string& words : order)
            text += fmt::format("{}: {}. ", join_names(by_words[words]), words);
        text.back() = '\n';
    }
    return text;
}

std::string csv(const std::vector<Row>& rows, const std::vector<Engine>& engines) {
    TextTable table;
    for (const char* name : {"case", "title", "engine", "run", "outcome", "error", "limit", "holds",
                             "cpu_s", "simulated_s", "steps", "what", "how"})
        table.columns.push_back({name, name});
    const std::map<Outcome::Kind, const char*> kinds = {{Outcome::Kind::kDone, "done"},
                                                        {Outcome::Kind::kRefused, "refused"},
                                                        {Outcome::Kind::kFailed, "failed"},
                                                        {Outcome::Kind::kCut, "cut"},
                                                        {Outcome::Kind::kCrashed, "crashed"}};
    for (const Row& row : rows)
        for (std::size_t i = 0; i < engines.size(); ++i)
            for (std::size_t r = 0; r < row.cells[i].runs.size(); ++r) {
                const Outcome& o = row.cells[i].runs[r];
                const auto number = [](double value) { return carom::Cell(value, 6); };
                table.rows.push_back({row.one->id, row.one->title, engines[i].name,
                                      number(static_cast<double>(r)), kinds.at(o.kind),
                                      number(o.error), number(o.limit), o.holds() ? "yes" : "no",
                                      number(o.cpu_s), number(o.simulated_s),
                                      number(static_cast<double>(o.steps)), o.what, o.how});
            }
    return csv_text(table);
}

void write_error_plot(const std::vector<Row>& rows, const std::vector<Engine>& engines,
                      const std::string& path) {
    constexpr double kLeast = 1e-17, kMost = 10;  // errors beyond are drawn at the edge
    Plot plot;
    plot.title = "Hard cases: error against cost, one point per case";
    plot.x = {"CPU seconds per simulated second", true};
    plot.y = {"largest error, relative", true, kLeast / 3, 3 * kMost};
    plot.legend = Legend::kTopLeft;
    for (std::size_t i = 0; i < engines.size(); ++i) {
        Series series;
        series.title = engines[i].name;
        series.style = SeriesStyle::kPoints;
        for (const Row& row : rows) {
            const Cell& cell = row.cells[i];
            if (cell.worst().kind == Outcome::Kind::kRefused || !std::isfinite(cell.cost()))
                continue;
            series.x.push_back(cell.cost());
            series.y.push_back(std::clamp(cell.worst().error, kLeast, kMost));
        }
        plot.series.push_back(series);
    }
    write_plot(plot, path);
}

}  // namespace carom::bench
