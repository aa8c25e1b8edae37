#include "render/overlay_trail.h"

#include <algorithm>
#include <cmath>

#include "render/overlay_style.h"

namespace carom {

namespace {

constexpr double kOpacity = 0.80;

std::vector<Ink> inks_of(const Scene& scene) {
    std::vector<Ink> inks;
    for (const Ball& ball : scene.balls)
        inks.push_back(
            trail_ink(scene.looks[static_cast<std::size_t>(ball.look)], scene.overlay.theme));
    return inks;
}

double lightness(const Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

double saturation(const Color& c) {
    const double high = std::max({c.r, c.g, c.b}), low = std::min({c.r, c.g, c.b});
    return high > 0 ? (high - low) / high : 0;
}

}  // namespace

Ink trail_ink(const Look& look, Theme theme) {
    // A ball that is white in the main is known by its second colour, if that is one.
    Color color = look.color;
    constexpr double kGrey = 0.15;
    if (saturation(color) < kGrey && saturation(look.second_color) > kGrey)
        color = look.second_color;
    if (theme == Theme::kDark) {
        // Lightened as far as needed, by mixing in white.
        constexpr double kDarkest = 0.58;
        const double light = lightness(color);
        const double white = light < kDarkest ? (kDarkest - light) / (1 - light) : 0;
        return {color.r + white * (1 - color.r), color.g + white * (1 - color.g),
                color.b + white * (1 - color.b), 1};
    }
    // Darkened as far as needed, keeping the hue; grey gets a touch of the overlay's slate.
    constexpr double kLightest = 0.46;
    const double scale = std::min(1.0, kLightest / std::max(lightness(color), 1e-6));
    Ink ink{color.r * scale, color.g * scale, color.b * scale, 1};
    if (saturation(color) < kGrey) {
        ink.r = 0.5 * (ink.r + kSlate.r);
        ink.g = 0.5 * (ink.g + kSlate.g);
        ink.b = 0.5 * (ink.b + kSlate.b);
    }
    return ink;
}

OverlayTrails::OverlayTrails(const Scene& scene, const Motion& motion, const View& view)
    : motion_(motion),
      view_(view),
      seconds_(scene.overlay.trail->seconds),
      raster_(view.width_px(), view.height_px(), inks_of(scene)) {
    const double width = overlay_px(scene.overlay.trail->width_px, view.height_px());
    half_width_ = 0.5 * std::max(width, 1.0);
    start_over();
}

void OverlayTrails::start_over() {
    lines_.clear();
    for (const Trajectory& ball : motion_.balls)
        lines_.push_back({TrailCurve(ball, view_, motion_.duration, seconds_), {}});
}

void OverlayTrails::view_has_changed() {
    start_over();
    raster_.clear();
}

OverlayPainter::Rect OverlayTrails::update(double t) {
    t = std::clamp(t, 0.0, motion_.duration);
    raster_.take_back();
    if (t < last_) {
        start_over();
        if (std::isinf(seconds_)) raster_.clear();
    }
    last_ = t;
    for (std::size_t i = 0; i < lines_.size(); ++i)
        std::isinf(seconds_) ? extend(i, t) : draw_fading(i, t);
    // From the last corner to the ball: replaced by what the next corner makes of it. Only after
    // all that stays, which would otherwise be taken back with it.
    for (std::size_t i = 0; i < lines_.size() && std::isinf(seconds_); ++i) {
        const Line& line = lines_[i];
        if (!line.corners.empty()) segment(i, line.corners.back(), line.curve.at(t), t, false);
    }
    return raster_.take_changed();
}

void OverlayTrails::extend(std::size_t i, double t) {
    Line& line = lines_[i];
    while (const auto corner = line.curve.next(t)) {
        if (!line.corners.empty()) segment(i, line.corners.back(), *corner, t, true);
        line.corners = {*corner};
    }
}

void OverlayTrails::draw_fading(std::size_t i, double t) {
    Line& line = lines_[i];
    const double begin = t - seconds_;
    line.curve.skip_to(begin);
    while (const auto corner = line.curve.next(t)) line.corners.push_back(*corner);
    while (line.corners.size() > 1 && line.corners[1].time <= begin) line.corners.pop_front();
    if (line.corners.empty()) return;
    TrailPoint from = line.corners.front();
    if (from.time < begin) from = line.curve.at(begin);
    for (std::size_t k = 1; k < line.corners.size(); ++k) {
        segment(i, from, line.corners[k], t, false);
        from = line.corners[k];
    }
    segment(i, from, line.curve.at(t), t, false);
}

void OverlayTrails::segment(std::size_t i, const TrailPoint& from, const TrailPoint& to, double t,
                            bool for_good) {
    if (!from.visible || !to.visible) return;
    const auto opacity = [&](double time) {
        return std::isinf(seconds_) ? kOpacity
                                    : kOpacity * std::clamp(1 - (t - time) / seconds_, 0.0, 1.0);
    };
    raster_.draw(
        {static_cast<int>(i), from.px, to.px, opacity(from.time), opacity(to.time), half_width_},
        for_good);
}

}  // namespace carom
