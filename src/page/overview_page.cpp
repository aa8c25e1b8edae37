#include "page/overview_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/markup.h"
#include "page/embedded_files.h"
#include "page/frame.h"
#include "page/html_table.h"
#include "page/plots.h"
#include "render/runs/rebound_verdict.h"

namespace carom {

namespace {

/// The top of the first rebound of any ball; "" for none.
std::string first_rebound(const Motion& motion) {
    const Peak* first = nullptr;
    for (const std::vector<Peak>& peaks : motion.peaks)
        if (!peaks.empty() && (first == nullptr || peaks.front().time < first->time))
            first = &peaks.front();
    return first != nullptr ? fmt::format("{:.6g}", first->height) : "";
}

}  // namespace

OverviewEntry::OverviewEntry(const Scene& scene, const SimulationResult& result,
                             const std::string& picture_png) {
    const Motion& motion = result.motion;
    const std::string title = escaped(page_title(scene));
    const auto verdict = judge_rebound(scene, motion);
    const double last = motion.events.empty() ? 0 : motion.events.back().time;
    figure_ = fmt::format(
        "<figure><img width=\"{}\" height=\"{}\" alt=\"{}: its balls at several instants\" "
        "src=\"{}\">{}<figcaption>{}{}</figcaption></figure>\n",
        scene.film.width_px, scene.film.height_px, title, data_uri("image/png", picture_png),
        height_plot(scene, motion), title,
        verdict ? ": " + escaped(verdict_text(scene, *verdict)) : "");
    cells_ = {title,
              escaped(std::filesystem::path(scene.file).filename().string()),
              fmt::format("{}", motion.balls.size()),
              fmt::format("{:.6g}", motion.duration),
              fmt::format("{}", result.report.impacts),
              first_rebound(motion),
              motion.events.empty() ? "" : fmt::format("{:.6g}", last),
              verdict ? (verdict->passes ? "passes" : "does not pass") : "",
              fmt::format("{:016x}", motion.hash())};
}

std::string overview_page(const std::vector<OverviewEntry>& entries, const std::string& version) {
    const std::string title = fmt::format("{} runs", entries.size());
    HtmlTable table("runs", "A click on a column's head sorts by it",
                    {{"Scene"},
                     {"File"},
                     {"Balls", true},
                     {"Duration, s", true},
                     {"Impacts", true},
                     {"First rebound, m", true},
                     {"Last event, s", true},
                     {"Test"},
                     {"Motion's hash"}});
    std::string figures;
    for (const OverviewEntry& entry : entries) {
        table.row(entry.cells());
        figures += entry.figure();
    }
    const EmbeddedFile script = overview_script();
    return page_head(title, {script.hash}) +
           fmt::format(
               "<header><h1>{}</h1></header>\n<main>\n<h2 id=\"table\">All runs</h2>\n{}<h2 "
               "id=\"pictures\">Side by side</h2>\n<div "
               "class=\"many\">\n{}</div>\n</main>\n<footer>"
               "<p class=\"soft\">carom {}</p></footer>\n<script>{}</script>\n</body></html>\n",
               title, table.text(), figures, escaped(version), script.text);
}

}  // namespace carom
