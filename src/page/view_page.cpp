#include "page/view_page.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/markup.h"
#include "page/embedded_files.h"
#include "page/plots.h"
#include "page/tables.h"

namespace carom {

namespace {

std::string watching(int revision) {
    return fmt::format(
        "<p id=\"revision\" data-number=\"{}\" hidden></p>\n<p id=\"lost\" class=\"bad\" "
        "role=\"status\" hidden>carom view has ended: this page does not follow the scene any "
        "more.</p>\n",
        revision);
}

/// `content` is HTML.
std::string page_without_viewer(const std::string& file, const std::string& content, int revision) {
    const std::string name = std::filesystem::path(file).filename().string();
    return page_head(name, {watch_script().hash}, true) +
           fmt::format(
               "<header><h1>{}</h1>\n{}</header>\n<main>{}</main>\n<script>{}</script>\n"
               "</body></html>\n",
               escaped(name), watching(revision), content, watch_script().text);
}

}  // namespace

std::string view_page(const Scene& scene, const SimulationResult& result, const SecondRun* second,
                      const std::string& version, int revision, KnownTextures& known) {
    const Motion& motion = result.motion;
    std::string page = page_head(
        page_title(scene), {viewer_script().hash, three_script().hash, watch_script().hash}, true);
    page += fmt::format("<header><h1>{}</h1>\n{}</header>\n<main>\n{}", escaped(page_title(scene)),
                        watching(revision), viewer_elements(motion, second));
    page += "<h2>Heights and energy</h2>\n<div class=\"two\">\n<figure>" +
            height_plot(scene, motion) + "</figure>\n<figure>" + energy_plot(scene, motion) +
            "</figure>\n</div>\n<h2>Bounces</h2>\n" + bounce_table(scene, motion) + "</main>\n";
    return page + viewer_data(scene, motion, second, version, known) +
           fmt::format("<script>{}</script>\n</body></html>\n", watch_script().text);
}

std::string waiting_page(const std::string& file, int revision) {
    return page_without_viewer(
        file, "<p role=\"status\">The scene is simulated; the page comes by itself.</p>\n",
        revision);
}

std::string wrong_scene_page(const std::string& file, const std::string& messages, int revision) {
    return page_without_viewer(
        file,
        fmt::format("<p class=\"bad\">The scene cannot be shown as it is; the page follows when it "
                    "is saved again.</p>\n<pre tabindex=\"0\">{}</pre>",
                    escaped_lines(messages)),
        revision);
}

}  // namespace carom
