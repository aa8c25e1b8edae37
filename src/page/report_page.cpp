#include "page/report_page.h"

#include <fmt/format.h>

#include "core/markup.h"
#include "page/embedded_files.h"
#include "page/frame.h"
#include "page/plots.h"
#include "page/tables.h"
#include "render/runs/rebound_verdict.h"

namespace carom {

namespace {

std::string heading(const char* id, const char* text) {
    return fmt::format("<h2 id=\"{}\">{}</h2>\n", id, text);
}

std::string method_text(const Simulation& simulation) {
    if (simulation.method == Method::kExact) return "method exact";
    return fmt::format("method fixed, steps of {:.6g} s", simulation.step);
}

std::string head_of_page(const Scene& scene, const SimulationResult& result,
                         const std::string& title) {
    const Motion& motion = result.motion;
    std::string text = fmt::format(
        "<a class=\"skip\" href=\"#film\">To film and pictures</a>\n<header><h1>{}</h1>\n<p "
        "class=\"soft\">{}, {:.6g} s, {}, {}</p>\n",
        escaped(title), counted(motion.balls.size(), "ball"), motion.duration,
        counted(static_cast<std::size_t>(result.report.impacts), "impact"),
        method_text(scene.simulation));
    if (const auto verdict = judge_rebound(scene, motion))
        text += fmt::format("<p class=\"{}\">{}</p>\n", verdict->passes ? "good" : "bad",
                            escaped(verdict_text(scene, *verdict)));
    if (!result.report.unrest.empty())
        text += fmt::format("<p class=\"bad\">{}</p>\n", escaped(result.report.unrest));
    return text + "</header>\n";
}

std::string pictures(const Scene& scene, const Motion& motion, const ReportParts& parts) {
    const Film& film = scene.film;
    return heading("film", "Film and picture") +
           fmt::format(
               "<div class=\"two\">\n<figure><video controls muted playsinline "
               "preload=\"metadata\" "
               "width=\"{0}\" height=\"{1}\" src=\"{2}\"></video><figcaption>The film: {0} × {1}, "
               "{3:.6g} frames a second</figcaption></figure>\n<figure><img width=\"{0}\" "
               "height=\"{1}\" alt=\"{4} at the instants {5}\" "
               "src=\"{6}\"><figcaption>Instants {5}</figcaption></figure>\n</div>\n",
               film.width_px, film.height_px, data_uri("video/mp4", parts.film_mp4),
               film.fps.per_second(), counted(motion.balls.size(), "ball"),
               escaped(parts.strobe_caption), data_uri("image/png", parts.strobe_png));
}

std::string plots(const Scene& scene, const Motion& motion) {
    std::string text = heading("plots", "Heights and energy") + "<div class=\"two\">\n<figure>" +
                       height_plot(scene, motion) +
                       "<figcaption>Height of each ball's lowest point";
    if (motion.balls.size() > kMostCurves)
        text += fmt::format(", of the first {} balls", kMostCurves);
    return text + " above z = 0</figcaption></figure>\n<figure>" + energy_plot(scene, motion) +
           "<figcaption>Energy of all balls; potential energy is that above z = 0</figcaption>"
           "</figure>\n</div>\n";
}

std::string origin(const Scene& scene, const SimulationResult& result, const ReportParts& parts) {
    std::string text = heading("origin", "Where it comes from") + "<dl>\n";
    const auto row = [&](const std::string& name, const std::string& value) {
        text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(value));
    };
    row("scene", scene.file);
    row("scene's fingerprint", fmt::format("{:016x}", scene.fingerprint));
    row("motion's hash", fmt::format("{:016x}", result.motion.hash()));
    row("renderer", parts.renderer);
    for (const auto& [name, version] : parts.versions) row(name, version);
    row("three.js", std::string(three_version()));
    return text + "</dl>\n";
}

}  // namespace

std::string report_page(const Scene& scene, const SimulationResult& result,
                        const ReportParts& parts, const SecondRun* second) {
    const Motion& motion = result.motion;
    const std::string title = page_title(scene);
    const auto version = parts.versions.find("carom");
    std::string page = page_head(title, {viewer_script().hash, three_script().hash}) +
                       head_of_page(scene, result, title) + "<main>\n";
    page += viewer_elements(motion, second);
    page += pictures(scene, motion, parts);
    page += plots(scene, motion);
    page += heading("impacts", "Bounces") + bounce_table(scene, motion);
    page += heading("pairs", "Coefficients of restitution") + pair_table(scene, motion);
    if (parts.accuracy)
        page += heading("accuracy", "Speed beside error") + accuracy_table(*parts.accuracy);
    page += heading("effects", "What was modelled") + effect_table(parts.effects);
    page += heading("scene", "The scene") + "<pre tabindex=\"0\">" +
            escaped_lines(parts.scene_text) + "</pre>\n";
    page += origin(scene, result, parts) + "</main>\n";
    KnownTextures textures;
    page += viewer_data(scene, motion, second,
                        version == parts.versions.end() ? "" : version->second, textures);
    return page + "</body></html>\n";
}

}  // namespace carom
