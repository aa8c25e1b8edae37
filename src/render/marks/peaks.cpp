#include "render/marks/peaks.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

constexpr std::size_t kMostMarks = 400;        // more than a picture has room for
constexpr std::size_t kMostLookedAt = 50'000;  // most of so many run together
constexpr double kLeastStep = 0.35;  // of the letters; marks of a ball that are closer run together

double line_px(const View& view) { return std::max(overlay_px(1.3, view.height_px()), 0.9); }

/// Decimals that give the highest peak three digits.
int decimals_for(const Motion& motion) {
    double highest = 0;
    for (const auto& peaks : motion.peaks)
        for (const Peak& peak : peaks) highest = std::max(highest, peak.height);
    if (!(highest > 0)) return 2;
    return std::clamp(2 - static_cast<int>(std::floor(std::log10(highest))), 0, 9);
}

struct BallPeak {
    int ball;
    Peak peak;
};

/// The first peaks of all balls, in order of time.
std::vector<BallPeak> peaks_in_order(const Motion& motion) {
    std::vector<BallPeak> all;
    for (std::size_t i = 0; i < motion.peaks.size(); ++i) {
        const std::size_t count = std::min(motion.peaks[i].size(), kMostLookedAt);
        for (std::size_t k = 0; k < count; ++k)
            all.push_back({static_cast<int>(i), motion.peaks[i][k]});
    }
    std::stable_sort(all.begin(), all.end(), [](const BallPeak& a, const BallPeak& b) {
        return a.peak.time < b.peak.time;
    });
    if (all.size() > kMostLookedAt) all.erase(all.begin() + kMostLookedAt, all.end());
    return all;
}

/// Finds the places of the numbers, one after another.
class Placer {
  public:
    Placer(const View& view, const Font& font, std::vector<PixelRect> taken)
        : view_(view), font_(font), taken_(std::move(taken)) {}

    /// `keep_clear` [px] to either side of the ball's centre stays free, for its label.
    void place(PeakMark& mark, double keep_clear) {
        const double size = font_.size_px();
        const double width = font_.lay_out(mark.text).width_px, margin = 0.25 * size;
        const double away = std::max(mark.radius_px, keep_clear) + 0.45 * size;
        const double height = font_.cap_height_px() + 2 * margin;
        for (const bool right : {true, false}) {
            const double x = mark.foot.x() + (right ? away : -away - width);
            const PixelRect rect =
                PixelRect::at(static_cast<int>(std::floor(x - margin)),
                              static_cast<int>(std::round(mark.foot.y() - 0.5 * height)),
                              static_cast<int>(std::ceil(width + 2 * margin)),
                              static_cast<int>(std::ceil(height)));
            if (rect.left < 0 || rect.top < 0 || rect.right > view_.width_px() ||
                rect.bottom > view_.height_px())
                continue;
            const auto in_the_way = [&](const PixelRect& other) { return rect.overlaps(other); };
            if (std::any_of(taken_.begin(), taken_.end(), in_the_way)) continue;
            mark.place = rect;
            mark.at_right = right;
            taken_.push_back(rect);
            return;
        }
    }

  private:
    const View& view_;
    const Font& font_;
    std::vector<PixelRect> taken_;
};

}  // namespace

std::vector<Vec2> silhouette(const Vec3& center, double radius, const View& view) {
    // The rays from the eye that touch the ball touch it on a circle: at c - (r^2/d^2)(c - e), in
    // the plane across c - e, of radius r sqrt(1 - r^2/d^2).
    const Vec3 axis = center - view.eye();
    const double share = radius * radius / axis.squaredNorm();
    if (!(share < 1)) return {};
    const Vec3 middle = center - share * axis;
    const Vec3 u = axis.cross(view.up()).normalized() * radius * std::sqrt(1 - share);
    const Vec3 v = axis.normalized().cross(u);
    constexpr int kCorners = 96;
    std::vector<Vec2> corners;
    for (int k = 0; k < kCorners; ++k) {
        const double angle = 2 * std::numbers::pi * k / kCorners;
        const View::Projected p = view.project(middle + std::cos(angle) * u + std::sin(angle) * v);
        if (!(p.depth_m > 0)) return {};
        corners.emplace_back(p.x_px, p.y_px);
    }
    return corners;
}

std::vector<PeakMark> lay_out_peaks(const Scene& scene, const Motion& motion, const View& view,
                                    const Font& font, const std::vector<PixelRect>& taken) {
    const int decimals = decimals_for(motion);
    const double step = kLeastStep * font.size_px();
    std::optional<Font> label_font;
    if (scene.overlay.labels)
        label_font.emplace(letters_px(scene.overlay.labels->size_px, view.height_px()));
    Placer placer(view, font, taken);
    std::vector<PeakMark> marks;
    for (const auto& ranked : peaks_in_order(motion)) {
        const int ball = ranked.ball;
        const Peak& peak = ranked.peak;
        if (marks.size() == kMostMarks) break;
        const auto index = static_cast<std::size_t>(ball);
        const double radius = scene.balls[index].radius;
        PeakMark mark;
        mark.ball = ball;
        mark.time = peak.time;
        mark.center = motion.balls[index].at(peak.time).position;
        const View::Projected middle = view.project(mark.center);
        const View::Projected foot = view.project(mark.center - Vec3(0, 0, radius));
        if (!(middle.depth_m > radius) || !(foot.depth_m > 0)) continue;
        mark.foot = Vec2(foot.x_px, foot.y_px);
        mark.radius_px = radius * view.pixels_per_metre(middle.depth_m);
        if (peak.height * view.pixels_per_metre(middle.depth_m) < 2 * step) continue;
        const bool runs_together =
            std::any_of(marks.begin(), marks.end(), [&](const PeakMark& other) {
                return other.ball == ball && (other.foot - mark.foot).norm() < step;
            });
        if (runs_together) continue;
        mark.text = fmt::format("{:.{}f} m", peak.height, decimals);
        double keep_clear = 0;
        if (label_font)
            keep_clear = 0.5 * label_font->lay_out(label_text(scene.balls[index].name)).width_px +
                         0.2 * label_font->size_px();
        placer.place(mark, keep_clear);
        marks.push_back(std::move(mark));
    }
    return marks;
}

PeaksElement::PeaksElement(const Scene& scene, const Motion& motion, const View& view,
                           const std::vector<PixelRect>& taken, const Palette& palette)
    : scene_(scene),
      motion_(motion),
      view_(view),
      palette_(palette),
      font_(letters_px(scene.overlay.peaks->size_px, view.height_px())),
      marks_(lay_out_peaks(scene, motion, view, font_, taken)),
      picture_(view.width_px(), view.height_px()) {}

void PeaksElement::set_view(const View& view, const std::vector<PixelRect>& around) {
    view_ = view;
    marks_ = lay_out_peaks(scene_, motion_, view, font_, around);
    stale_ = stale_ || drawn_ > 0;
    drawn_ = 0;
}

PixelRect PeaksElement::update(double t) {
    PixelRect changed;
    if (stale_ || (drawn_ > 0 && marks_[drawn_ - 1].time > t)) {
        stale_ = false;
        std::fill(picture_.bgra.begin(), picture_.bgra.end(), std::uint8_t{0});
        drawn_ = 0;
        changed = {0, 0, picture_.width_px, picture_.height_px};
    }
    if (drawn_ == marks_.size() || marks_[drawn_].time > t) return changed;
    Canvas canvas(picture_);
    for (; drawn_ < marks_.size() && marks_[drawn_].time <= t; ++drawn_) {
        const PeakMark& mark = marks_[drawn_];
        draw_mark(canvas, mark);
        const double reach = 1.5 * mark.radius_px + font_.size_px();
        const PixelRect ring = PixelRect::at(
            static_cast<int>(std::floor(mark.foot.x() - reach)),
            static_cast<int>(std::floor(mark.foot.y() - 2 * reach)),
            static_cast<int>(std::ceil(2 * reach)) + 1, static_cast<int>(std::ceil(3 * reach)) + 1);
        changed = changed.joined(ring).joined(mark.place);
    }
    canvas.finish();
    return changed;
}

void PeaksElement::draw_mark(Canvas& canvas, const PeakMark& mark) const {
    cairo_t* c = canvas.context();
    const Ball& ball = scene_.balls[static_cast<std::size_t>(mark.ball)];
    const Ink ink =
        trail_ink(scene_.looks[static_cast<std::size_t>(ball.look)], scene_.overlay.theme);
    const double line = line_px(view_);
    cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);  // whatever was drawn before
    for (const Vec2& corner : silhouette(mark.center, ball.radius, view_))
        cairo_line_to(c, corner.x(), corner.y());
    cairo_close_path(c);
    canvas.use(with_alpha(ink, 0.10));
    cairo_fill_preserve(c);
    canvas.use(with_alpha(ink, 0.60));
    cairo_set_line_width(c, line);
    cairo_stroke(c);
    if (mark.place.empty()) return;

    // From below the ball to the number.
    const double size = font_.size_px(), margin = 0.25 * size;
    const double near = mark.at_right ? mark.place.left + margin : mark.place.right - margin;
    const double sign = mark.at_right ? 1 : -1;
    cairo_move_to(c, mark.foot.x() - sign * 0.5 * mark.radius_px, mark.foot.y());
    cairo_line_to(c, near - sign * 0.2 * size, mark.foot.y());
    canvas.use(with_alpha(ink, 0.85));
    cairo_stroke(c);
    font_.draw(canvas, font_.lay_out(mark.text), mark.place.left + margin,
               std::round(mark.place.top + margin + font_.cap_height_px()), palette_.ink,
               0.2 * size, palette_.paper);
}

ElementKind peaks_kind() {
    ElementKind kind;
    kind.name = "peaks";
    kind.layer = Layer::kBelowBalls;
    kind.wanted = [](const Scene& scene) { return scene.overlay.peaks.has_value(); };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        if (context.scene.balls.empty()) return nullptr;
        return std::make_unique<PeaksElement>(context.scene, context.motion, context.view,
                                              context.around, context.palette);
    };
    return kind;
}

}  // namespace carom
