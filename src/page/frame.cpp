#include "page/frame.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "core/markup.h"
#include "export/motion_json.h"
#include "export/scene_json.h"
#include "media/png.h"
#include "page/embedded_files.h"
#include "page/gzip.h"
#include "render/texture/ball_texture.h"

namespace carom {

namespace {

/// The pictures of the balls' markings, by their looks as the motion has them.
std::string textures_json(const Scene& scene, KnownTextures& known) {
    nlohmann::ordered_json textures = nlohmann::ordered_json::object();
    std::optional<BallTextures> painter;
    for (const Ball& ball : scene.balls) {
        const Look& look = scene.looks[static_cast<std::size_t>(ball.look)];
        const std::string key = look_json(look).dump();
        if (!has_markings(look) || textures.contains(key)) continue;
        if (!known.contains(key)) {
            if (!painter) painter.emplace();
            known[key] = data_uri("image/png", encode_png(painter->draw(look), PngEffort::kSmall));
        }
        textures[key] = known[key];
    }
    return textures.dump();  // words, colours and base64: nothing that ends an element
}

std::string packed(const char* id, std::string_view gzipped) {
    return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, base64(gzipped));
}

std::string packed_motion(const char* id, const Scene& scene, const Motion& motion,
                          std::string_view version) {
    std::string json;
    write_motion_json(scene, motion, version, [&](std::string_view part) { json += part; });
    return packed(id, gzip(json));
}

std::string check_box(const char* name, const char* label, bool on) {
    return fmt::format("<label><input type=\"checkbox\" id=\"v-{}\"{}> {}</label>\n", name,
                       on ? " checked" : "", label);
}

}  // namespace

std::string data_uri(std::string_view type, std::string_view bytes) {
    return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string escaped_lines(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        result += escaped(line, std::string::npos) + '\n';
    }
    return result;
}

std::string page_title(const Scene& scene) {
    return scene.title.empty() ? std::filesystem::path(scene.file).filename().string()
                               : scene.title;
}

std::string counted(std::size_t count, std::string_view of_one) {
    return fmt::format("{} {}{}", count, of_one, count == 1 ? "" : "s");
}

std::string page_head(std::string_view title, const std::vector<std::string_view>& scripts,
                      bool connects) {
    std::string allowed;
    for (const std::string_view hash : scripts) allowed += fmt::format(" '{}'", hash);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "media-src data:; style-src '{}'; script-src{}; {}base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<link rel=\"icon\" "
        "href=\"data:,\">\n<title>{}</title>\n<style>{}</style></head>\n<body>\n",
        page_style().hash, allowed, connects ? "connect-src 'self'; " : "", escaped(title),
        page_style().text);
}

std::string viewer_elements(const Motion& motion, const SecondRun* second) {
    std::string speeds;
    for (const int slower : {1, 2, 5, 10, 30, 100, 300, 1000})
        speeds += slower == 1 ? std::string("<option value=\"1\">real time</option>")
                              : fmt::format("<option value=\"{0}\">1/{0}</option>", slower);
    return fmt::format(
        "<p id=\"v-note\" class=\"soft\" role=\"status\" hidden></p>\n"
        "<section id=\"viewer\" aria-label=\"The motion in three dimensions\" hidden>\n"
        "<div class=\"stage\"><canvas id=\"v-canvas\" tabindex=\"0\" role=\"img\" "
        "aria-label=\"{} in motion, in three dimensions. Keys: space plays, left and right "
        "go "
        "from impact to impact, a d w s turn, + and - zoom, c is the scene's camera.\"></canvas>"
        "<div id=\"v-labels\" aria-hidden=\"true\"></div></div>\n"
        "<input type=\"range\" id=\"v-scrub\" min=\"0\" max=\"{}\" step=\"any\" value=\"0\" "
        "aria-label=\"instant, s\">\n"
        "<div class=\"bar\"><button type=\"button\" id=\"v-play\">Play</button>\n"
        "<button type=\"button\" id=\"v-before\">Impact before</button>\n"
        "<button type=\"button\" id=\"v-after\">Next impact</button>\n"
        "<span id=\"v-time\">0.000 s</span>\n"
        "<label>Speed <select id=\"v-speed\">{}</select></label>\n"
        "<button type=\"button\" id=\"v-camera\">The scene's camera</button></div>\n"
        "<div class=\"bar\">{}{}{}{}{}</div>\n<p id=\"v-event\" class=\"soft\"></p>\n"
        "<p class=\"soft\">Drag to turn; two fingers, or Ctrl and the wheel, zoom. Every instant "
        "is computed from the motion's own pieces, none is between two frames.</p>\n</section>\n",
        counted(motion.balls.size(), "ball"), motion.duration, speeds,
        check_box("trails", "trails", true), check_box("peaks", "peaks", true),
        check_box("arrows", "velocities", false),
        check_box("names", "names", motion.balls.size() <= 12),
        second != nullptr ? check_box("second", "second run, as ghosts", true) : "");
}

std::string viewer_data(const Scene& scene, const Motion& motion, const SecondRun* second,
                        std::string_view version, KnownTextures& known) {
    return fmt::format(
               "<footer><details><summary>Licence of three.js</summary><pre>{}</pre>"
               "</details></footer>\n",
               escaped_lines(three_licence())) +
           packed_motion("motion", scene, motion, version) +
           (second != nullptr ? packed_motion("second", second->scene, second->motion, version)
                              : "") +
           packed("three", three_script().text) +
           fmt::format(
               "<script type=\"application/json\" id=\"textures\">{}</script>\n"
               "<script>{}</script>\n",
               textures_json(scene, known), viewer_script().text);
}

}  // namespace carom
