#include "render/plates/plot.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/draw2d/round_steps.h"
#include "render/element/height_range.h"

namespace carom {

namespace {

constexpr double kLettersPx = 12;  // at 720
constexpr double kLinePx = 1.8;    // width of a curve, at 720
constexpr double kDotPx = 3.6;     // radius, at 720
constexpr double kOpacity = 0.95;

std::string number_text(double value, double step) {
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    const std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
    return value < -0.5 * step ? "\u2212" + text : text;
}

/// What the heights of one ball's lowest point reach.
void add_heights(const Trajectory& path, double radius, double first, double last,
                 HeightRange& heights) {
    HeightRange centre;
    const auto& pieces = path.pieces();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double end = i + 1 < pieces.size() ? std::min(pieces[i + 1].start, last) : last;
        const double begin = std::max(pieces[i].start, first);
        if (begin <= end) centre.add(pieces[i], begin, end);
    }
    heights.add(centre.low_m - radius);
    heights.add(centre.high_m - radius);
}

/// What the axis of time spans at least, s: so much that marks are apart by more than rounding.
double least_span_s(const Motion& motion) { return 1e-9 * std::max(1.0, motion.duration); }

}  // namespace

PlotAxes choose_plot_axes(const Scene& scene, const Motion& motion, double most_lines_s,
                          double most_lines_m) {
    PlotAxes axes;
    axes.first_s = scene.film.start;
    axes.high_m = axes.low_m = 0;
    HeightRange heights;
    for (const int ball : scene.overlay.plot->balls) {
        const auto i = static_cast<std::size_t>(ball);
        add_heights(motion.balls[i], scene.balls[i].radius, axes.first_s, motion.duration, heights);
    }
    constexpr double kNearZero = 0.6;  // of the far end: then the axis starts at 0
    if (heights.low_m > 0 && heights.low_m < kNearZero * heights.high_m) heights.low_m = 0;
    if (heights.high_m < 0 && heights.high_m > kNearZero * heights.low_m) heights.high_m = 0;
    // What does not move gets an axis of its own size.
    const double least = 1e-6 * std::max({std::abs(heights.low_m), std::abs(heights.high_m), 1.0});
    axes.step_m = step_at_least(std::max(heights.high_m - heights.low_m, least) / most_lines_m);
    constexpr double kRounding = 1e-9;  // of a step: 2.0000000001 m ends at the line of 2 m
    axes.low_m = axes.step_m * std::floor(heights.low_m / axes.step_m + kRounding);
    axes.high_m = axes.step_m * std::ceil(heights.high_m / axes.step_m - kRounding);
    if (axes.high_m <= axes.low_m) axes.high_m = axes.low_m + axes.step_m;
    axes.step_s = step_at_least(std::max(motion.duration - axes.first_s, least_span_s(motion)) /
                                most_lines_s);
    return axes;
}

PlotElement::PlotElement(const Scene& scene, const Motion& motion, int width_px, int height_px,
                         const std::vector<PixelRect>& taken, const Palette& palette)
    : scene_(scene),
      motion_(motion),
      palette_(palette),
      font_(letters_px(kLettersPx, height_px)),
      unit_(std::max(overlay_px(1, height_px), 0.55)) {
    choose_place(taken, width_px, height_px);
    const double size = font_.size_px();
    top_px_ = 2.1 * size;
    bottom_px_ = rect_.height() - 2.1 * size;
    right_px_ = rect_.width() - 1.0 * size;
    const PlotAxes rough =
        choose_plot_axes(scene, motion, 5, std::max(1.0, (bottom_px_ - top_px_) / (2.6 * size)));
    double widest = 0;
    for (const double height : {rough.low_m, rough.high_m})
        widest = std::max(widest, font_.lay_out(number_text(height, rough.step_m)).width_px);
    left_px_ = std::round(widest + 1.1 * size);
    constexpr double kLeastAxis = 2;  // letters
    if (std::min(right_px_ - left_px_, bottom_px_ - top_px_) < kLeastAxis * size) {
        rect_ = {};
        return;
    }
    const double number_s =
        font_.lay_out(number_text(motion.duration, 0.1 * rough.step_s)).width_px + 2.0 * size;
    const PlotAxes axes =
        choose_plot_axes(scene, motion, std::max(1.0, (right_px_ - left_px_) / number_s),
                         std::max(1.0, (bottom_px_ - top_px_) / (2.6 * size)));
    scale_.left_s = axes.first_s;
    scale_.bottom_m = axes.low_m;
    scale_.px_per_s =
        (right_px_ - left_px_) / std::max(motion.duration - axes.first_s, least_span_s(motion));
    scale_.px_per_m = (bottom_px_ - top_px_) / (axes.high_m - axes.low_m);
    scale_.origin_px = Vec2(left_px_, bottom_px_);
    for (const int ball : scene.overlay.plot->balls) {
        const int look = scene.balls[static_cast<std::size_t>(ball)].look;
        inks_.push_back(
            trail_ink(scene.looks[static_cast<std::size_t>(look)], scene.overlay.theme));
    }
    curves_.emplace(rect_.width(), rect_.height(), inks_);
    make_plate(axes);
    start_over();
}

void PlotElement::choose_place(const std::vector<PixelRect>& taken, int width_px, int height_px) {
    const PlotOptions& options = *scene_.overlay.plot;
    const int border = border_px(height_px);
    const bool at_left =
        options.corner == Corner::kTopLeft || options.corner == Corner::kBottomLeft;
    const bool at_top = options.corner == Corner::kTopLeft || options.corner == Corner::kTopRight;
    // Room for a few numbers on each axis, however small the picture.
    const double least = 7 * font_.size_px();
    const int w = std::min(whole_px(std::max(options.size[0] * width_px, 1.5 * least)),
                           width_px - 2 * border);
    const int h =
        std::min(whole_px(std::max(options.size[1] * height_px, least)), height_px - 2 * border);
    rect_ = PixelRect::at(at_left ? border : width_px - border - w,
                          at_top ? border : height_px - border - h, w, h);
    for (std::size_t turn = 0; turn < taken.size(); ++turn)
        for (const PixelRect& other : taken)
            if (rect_.overlaps(other))
                rect_ =
                    rect_.with_top(at_top ? other.bottom + border / 2 : other.top - h - border / 2);
    rect_ = rect_.with_top(std::clamp(rect_.top, 0, std::max(height_px - h, 0)));
}

void PlotElement::make_plate(const PlotAxes& axes) {
    plate_ = Image(rect_.width(), rect_.height());
    Canvas canvas(plate_);
    const double size = font_.size_px();
    draw_plate(canvas, rect_.width(), rect_.height(), 0.5 * size, palette_, 0.86);
    draw_grid(canvas, axes);
    font_.draw(canvas, font_.lay_out("height, m"), 0.7 * size, std::round(1.35 * size),
               palette_.ink);
    if (scene_.overlay.plot->balls.size() > 1) draw_names(canvas);
    canvas.finish();
}

void PlotElement::draw_grid(Canvas& canvas, const PlotAxes& axes) const {
    cairo_t* c = canvas.context();
    const double size = font_.size_px(), cap = font_.cap_height_px();
    const double line = std::max(unit_, 1.0);
    const auto stroke = [&](const Vec2& from, const Vec2& to, double alpha) {
        // On whole pixels, so that level and upright lines stay sharp.
        const double shift = std::fmod(std::round(line), 2) == 1 ? 0.5 : 0;
        cairo_move_to(c, std::floor(from.x()) + shift, std::floor(from.y()) + shift);
        cairo_line_to(c, std::floor(to.x()) + shift, std::floor(to.y()) + shift);
        canvas.use(with_alpha(palette_.ink, alpha));
        cairo_set_line_width(c, std::round(line));
        cairo_stroke(c);
    };
    const TextRun unit_s = font_.lay_out("t, s");
    const double unit_x = right_px_ - unit_s.width_px;
    const double row = std::round(bottom_px_ + 0.55 * size + cap);
    font_.draw(canvas, unit_s, unit_x, row, palette_.ink);
    const double last_s = axes.first_s + (right_px_ - left_px_) / scale_.px_per_s;
    for (double k = std::ceil(axes.first_s / axes.step_s - 1e-9);
         k * axes.step_s <= last_s + 1e-9 * axes.step_s; ++k) {
        const double t = k * axes.step_s, x = scale_.px(t, axes.low_m).x();
        stroke({x, top_px_}, {x, bottom_px_}, 0.13);
        const TextRun number = font_.lay_out(number_text(t, axes.step_s));
        const double begin = x - 0.5 * number.width_px;
        if (begin + number.width_px + 0.4 * size < unit_x)
            font_.draw(canvas, number, begin, row, palette_.ink);
    }
    for (double k = std::round(axes.low_m / axes.step_m);
         k * axes.step_m <= axes.high_m * (1 + 1e-9); ++k) {
        const double height = k * axes.step_m, y = scale_.px(axes.first_s, height).y();
        stroke({left_px_, y}, {right_px_, y}, 0.13);
        const TextRun number = font_.lay_out(number_text(height, axes.step_m));
        font_.draw(canvas, number, left_px_ - 0.45 * size - number.width_px,
                   std::round(y + 0.5 * cap), palette_.ink);
    }
    stroke({left_px_, top_px_}, {left_px_, bottom_px_}, 0.7);
    stroke({left_px_, bottom_px_}, {right_px_, bottom_px_}, 0.7);
}

/// The balls' names with their colours, at the upper right of the axes; only if all have room.
void PlotElement::draw_names(Canvas& canvas) const {
    const double size = font_.size_px(), pitch = 1.35 * size, dash = 1.3 * size;
    // Curves of one name, those of a second run, are named once.
    std::vector<std::string> names;
    std::vector<Ink> inks;
    double widest = 0;
    for (std::size_t i = 0; i < inks_.size(); ++i) {
        const auto ball = static_cast<std::size_t>(scene_.overlay.plot->balls[i]);
        const std::string name = label_text(scene_.balls[ball].name);
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        names.push_back(name);
        inks.push_back(inks_[i]);
        widest = std::max(widest, font_.lay_out(name).width_px);
    }
    const double width = widest + dash + 0.9 * size;
    const double height = pitch * static_cast<double>(names.size()) + 0.3 * size;
    if (width > 0.6 * (right_px_ - left_px_) || height > bottom_px_ - top_px_) return;
    cairo_t* c = canvas.context();
    const double x = right_px_ - width;
    cairo_rectangle(c, x, top_px_, width, height);
    canvas.use(with_alpha(palette_.paper, 0.85));
    cairo_fill(c);
    double y = top_px_ + 0.15 * size + 0.5 * pitch;
    for (std::size_t i = 0; i < names.size(); ++i, y += pitch) {
        cairo_move_to(c, x + 0.2 * size, std::round(y));
        cairo_line_to(c, x + 0.2 * size + dash, std::round(y));
        canvas.use(inks[i]);
        cairo_set_line_width(c, std::max(kLinePx * unit_, 1.0) * 1.3);
        cairo_stroke(c);
        font_.draw(canvas, font_.lay_out(names[i]), x + dash + 0.6 * size,
                   std::round(y + 0.5 * font_.cap_height_px()), palette_.ink);
    }
}

void PlotElement::start_over() {
    lines_.clear();
    for (const int ball : scene_.overlay.plot->balls) {
        const auto i = static_cast<std::size_t>(ball);
        lines_.push_back(
            {PlotCurve(motion_.balls[i], scene_.balls[i].radius, scale_, motion_.duration), {}});
    }
}

void PlotElement::segment(std::size_t i, const TrailPoint& to, bool for_good) {
    const double half = 0.5 * std::max(kLinePx * unit_, 1.0);
    curves_->draw({static_cast<int>(i), lines_[i].last->px, to.px, kOpacity, kOpacity, half},
                  for_good);
}

double PlotElement::shown_instant(double t) const {
    return std::clamp(t, scene_.film.start, std::max(motion_.duration, scene_.film.start));
}

Appearance PlotElement::appearance(double t) {
    // A dot at a curve's end may reach over the plate's edge.
    const int around = static_cast<int>(std::ceil((kDotPx + 2) * unit_));
    return {
        {{rect_.left - around, rect_.top - around, rect_.right + around, rect_.bottom + around}},
        {shown_instant(t)}};
}

void PlotElement::draw(double t, Image& picture) {
    t = shown_instant(t);
    curves_->take_back();
    if (t < last_) {
        start_over();
        curves_->clear();
    }
    last_ = t;
    for (std::size_t i = 0; i < lines_.size(); ++i)
        while (const auto corner = lines_[i].curve.next(t)) {
            if (lines_[i].last) segment(i, *corner, true);
            lines_[i].last = corner;
        }
    // From the last corner to the ball: replaced by what the next corner makes of it. Only after
    // all that stays, which would otherwise be taken back with it.
    for (std::size_t i = 0; i < lines_.size(); ++i)
        if (lines_[i].last) segment(i, lines_[i].curve.at(t), false);
    lay_over(plate_, rect_.left, rect_.top, picture);
    lay_over(curves_->picture(), rect_.left, rect_.top, picture);

    Canvas canvas(picture);
    cairo_t* c = canvas.context();
    for (std::size_t i = lines_.size(); i-- > 0;) {
        const Vec2 at = lines_[i].curve.at(t).px;
        cairo_new_sub_path(c);
        cairo_arc(c, rect_.left + at.x(), rect_.top + at.y(), kDotPx * unit_, 0,
                  2 * std::numbers::pi);
        canvas.use(palette_.paper);
        cairo_set_line_width(c, 1.6 * unit_);
        cairo_stroke_preserve(c);
        canvas.use(inks_[i]);
        cairo_fill(c);
    }
    canvas.finish();
}

ElementKind plot_kind() {
    ElementKind kind;
    kind.keeps_place = true;
    kind.name = "plot";
    kind.wanted = [](const Scene& scene) { return scene.overlay.plot.has_value(); };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        if (context.scene.overlay.plot->balls.empty()) return nullptr;
        return std::make_unique<PlotElement>(context.traced_scene(), context.traced_motion(),
                                             context.view.width_px(), context.view.height_px(),
                                             context.taken, context.palette);
    };
    return kind;
}

}  // namespace carom
