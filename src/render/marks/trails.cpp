#include "render/marks/trails.h"

#include <algorithm>
#include <cmath>

#include "render/draw2d/style.h"

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

}  // namespace

TrailsElement::TrailsElement(const Scene& scene, const Motion& motion, const View& view)
    : motion_(motion),
      view_(view),
      seconds_(scene.overlay.trail->seconds),
      raster_(view.width_px(), view.height_px(), inks_of(scene)) {
    const double width = overlay_px(scene.overlay.trail->width_px, view.height_px());
    half_width_ = 0.5 * std::max(width, 1.0);
    start_over();
}

void TrailsElement::start_over() {
    lines_.clear();
    for (const Trajectory& ball : motion_.balls)
        lines_.push_back({TrailCurve(ball, view_, motion_.duration, seconds_), {}});
}

void TrailsElement::set_view(const View& view, const std::vector<PixelRect>& /*around*/) {
    view_ = view;
    start_over();
    raster_.clear();
}

PixelRect TrailsElement::update(double t) {
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

void TrailsElement::extend(std::size_t i, double t) {
    Line& line = lines_[i];
    while (const auto corner = line.curve.next(t)) {
        if (!line.corners.empty()) segment(i, line.corners.back(), *corner, t, true);
        line.corners = {*corner};
    }
}

void TrailsElement::draw_fading(std::size_t i, double t) {
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

void TrailsElement::segment(std::size_t i, const TrailPoint& from, const TrailPoint& to, double t,
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

ElementKind trails_kind() {
    ElementKind kind;
    kind.name = "trail";
    kind.layer = Layer::kBelowBalls;
    kind.wanted = [](const Scene& scene) { return scene.overlay.trail.has_value(); };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        if (context.scene.balls.empty()) return nullptr;
        return std::make_unique<TrailsElement>(context.traced_scene(), context.traced_motion(),
                                               context.view);
    };
    return kind;
}

}  // namespace carom
