// What is written over the picture.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/build.h"
#include "scene/scalar.h"

namespace carom {

namespace {

/// Options of one overlay: none for `false`, and the defaults for `true`.
std::optional<Fields> overlay_options(const Fields& overlay, const char* key) {
    const Node* node = overlay.find(key);
    if (node == nullptr) return std::nullopt;
    const bool is_map = node->kind == Node::Kind::kMap;
    if (!is_map && !resolve_scalar(node->text, node->quoted).boolean) return std::nullopt;
    return overlay.child(key);
}

Corner parse_corner(const std::string& word) {
    if (word == "top_right") return Corner::kTopRight;
    if (word == "bottom_left") return Corner::kBottomLeft;
    return word == "bottom_right" ? Corner::kBottomRight : Corner::kTopLeft;
}

RulerOptions read_ruler(Build& build, const Fields& fields) {
    RulerOptions ruler;
    if (fields.has("at")) ruler.at = fields.vec2("at");
    ruler.from = fields.number("from");
    ruler.to = fields.maybe_number("to");
    if (ruler.to && *ruler.to <= ruler.from)
        build.report.error(*fields.find("to"),
                           fmt::format("the ruler's 'to' ({} m) must lie above its 'from' ({} m)",
                                       number_text(*ruler.to), number_text(ruler.from)));
    if (const Node* band = fields.find("band")) {
        const Vec2 bounds = fields.vec2("band");
        ruler.band = {bounds[0], bounds[1]};
        if (bounds[1] <= bounds[0])
            build.report.error(*band,
                               "the ruler's 'band' must be a lower and then a higher height");
    }
    return ruler;
}

/// Reports text that no picture has room for.
void check_length(Build& build, const Node& at, const std::string& what, const std::string& text,
                  long most) {
    const auto is_first_byte = [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    };
    const long length = std::count_if(text.begin(), text.end(), is_first_byte);
    if (length > most)
        build.report.error(at, fmt::format("the {} has {} characters; a picture has room for {}",
                                           what, length, most));
}

void read_text(Build& build, const Fields& fields) {
    Overlay& overlay = build.scene.overlay;
    constexpr long kMostInTitle = 160, kMostInCaption = 400;
    if (const auto title = overlay_options(fields, "title")) {
        overlay.title = {title->number("size_px")};
        const Node& node = *fields.find("title");
        const Node* said = build.root.find("title");
        if (said == nullptr)
            build.report.error(node, "the overlay shows a title, but the scene has no 'title'");
        else if (said->valid)
            check_length(build, *said, "title", build.scene.title, kMostInTitle);
    }
    if (const Node* caption = fields.find("caption")) {
        overlay.caption = caption->text;
        check_length(build, *caption, "caption", overlay.caption, kMostInCaption);
    }
}

PlotOptions read_plot(Build& build, const Node& at, const Fields& fields) {
    constexpr std::size_t kMost = 12;  // curves that can be told apart
    PlotOptions plot;
    const Node* named = fields.find("ball");
    const auto add = [&](const Node& reference) {
        const int ball = resolve_ball(build, reference);
        if (ball < 0) return;
        if (std::find(plot.balls.begin(), plot.balls.end(), ball) == plot.balls.end())
            plot.balls.push_back(ball);
        else
            build.report.error(reference, fmt::format("the plot names the ball {} twice",
                                                      quoted_excerpt(reference.text)));
    };
    if (named != nullptr && named->kind == Node::Kind::kScalar) add(*named);
    if (named != nullptr && named->kind == Node::Kind::kList) {
        if (named->children.empty()) build.report.error(*named, "the plot's 'ball' names no ball");
        if (named->children.size() > kMost)
            build.report.error(*named, fmt::format("a plot shows at most {} balls, not {}", kMost,
                                                   named->children.size()));
        else
            for (const Node& reference : named->children) add(reference);
    }
    const std::size_t count = build.scene.balls.size();
    if (named == nullptr && count > kMost)
        build.report.error(at, fmt::format("a plot shows at most {} balls, and the scene has {}; "
                                           "name them, such as 'plot: {{ball: {}}}'",
                                           kMost, count, build.scene.balls.front().name));
    else if (named == nullptr)
        for (std::size_t i = 0; i < count; ++i) plot.balls.push_back(static_cast<int>(i));
    const Vec2 size = fields.vec2("size");
    plot.size = {size[0], size[1]};
    plot.corner = parse_corner(fields.word("corner"));
    return plot;
}

}  // namespace

void build_overlay(Build& build) {
    const Fields fields = build.top().child("overlay");
    Overlay& overlay = build.scene.overlay;
    if (const auto ruler = overlay_options(fields, "ruler"))
        overlay.ruler = read_ruler(build, *ruler);
    if (const auto clock = overlay_options(fields, "clock"))
        overlay.clock = {parse_corner(clock->word("corner")), clock->integer("digits")};
    if (const auto trail = overlay_options(fields, "trail")) {
        overlay.trail = TrailOptions{};
        overlay.trail->seconds =
            trail->maybe_number("seconds").value_or(std::numeric_limits<double>::infinity());
        overlay.trail->width_px = trail->number("width_px");
    }
    if (const auto labels = overlay_options(fields, "labels"))
        overlay.labels = {labels->number("size_px")};
    read_text(build, fields);
    if (const auto peaks = overlay_options(fields, "peaks"))
        overlay.peaks = {peaks->number("size_px")};
    if (const auto velocity = overlay_options(fields, "velocity"))
        overlay.velocity = {velocity->maybe_number("scale")};
    if (const auto plot = overlay_options(fields, "plot"))
        overlay.plot = read_plot(build, *fields.find("plot"), *plot);
    overlay.theme = fields.word("theme") == "dark" ? Theme::kDark : Theme::kLight;
}

}  // namespace carom
