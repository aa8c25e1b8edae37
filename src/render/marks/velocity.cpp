#include "render/marks/velocity.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>

#include "render/draw2d/round_steps.h"
#include "render/runs/motion_extent.h"

namespace carom {

namespace {

/// The greatest speed of any ball, m/s. Along a piece the speed is greatest at an end.
double greatest_speed(const Motion& motion) {
    double greatest = 0;
    for (const Trajectory& ball : motion.balls) {
        const auto& pieces = ball.pieces();
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const double end = i + 1 < pieces.size() ? pieces[i + 1].start : motion.duration;
            for (const double t : {pieces[i].start, std::min(end, motion.duration)})
                greatest = std::max(greatest, pieces[i].velocity_at(t).norm());
        }
    }
    return greatest;
}

double chosen_scale(const Scene& scene, const Motion& motion, const View& view) {
    constexpr double kLongest = 0.25;  // of the picture's height
    const double speed = greatest_speed(motion);
    if (!(speed > 0)) return 1;
    const Vec3 middle = MotionExtent(scene, motion).ball_box().center();
    const double depth = (middle - view.eye()).dot(view.forward());
    if (!(depth > 0)) return 1;
    return step_at_most(kLongest * view.height_px() / view.pixels_per_metre(depth) / speed);
}

/// The outline of an arrow of `length` px along +x.
void arrow_path(cairo_t* c, double length, double unit) {
    const double half = 1.5 * unit;
    const double head = std::min(11 * unit, 0.6 * length), wide = 0.42 * head;
    const double thin = std::min(half, 0.45 * wide);
    cairo_move_to(c, 0, -thin);
    cairo_line_to(c, length - head, -thin);
    cairo_line_to(c, length - head, -wide);
    cairo_line_to(c, length, 0);
    cairo_line_to(c, length - head, wide);
    cairo_line_to(c, length - head, thin);
    cairo_line_to(c, 0, thin);
    cairo_close_path(c);
}

}  // namespace

VelocityElement::VelocityElement(const Scene& scene, const Motion& motion, const View& view,
                                 const Palette& palette)
    : scene_(scene), motion_(motion), view_(view), palette_(palette) {
    const auto& wanted = scene.overlay.velocity->scale_s;
    scale_s_ = wanted ? *wanted : chosen_scale(scene, motion, view);
    for (const Ball& ball : scene.balls)
        inks_.push_back(
            trail_ink(scene.looks[static_cast<std::size_t>(ball.look)], scene.overlay.theme));
}

std::optional<VelocityArrow> VelocityElement::arrow(std::size_t ball, double t) const {
    const BallState state = motion_.balls[ball].at(t);
    const auto depth = [&](const Vec3& p) { return (p - view_.eye()).dot(view_.forward()); };
    Vec3 tip = state.position + scale_s_ * state.velocity;
    const double here = depth(state.position), there = depth(tip);
    if (!(here > scene_.balls[ball].radius)) return std::nullopt;
    // What reaches behind the eye ends before it, in the same direction on the screen.
    const double nearest = 0.02 * here;
    if (there < nearest)
        tip = state.position + (here - nearest) / (here - there) * (tip - state.position);
    const View::Projected a = view_.project(state.position), b = view_.project(tip);
    return VelocityArrow{Vec2(a.x_px, a.y_px), Vec2(b.x_px, b.y_px)};
}

void VelocityElement::set_view(const View& view, const std::vector<PixelRect>& /*around*/) {
    view_ = view;
}

double VelocityElement::unit_px() const { return std::max(overlay_px(1, view_.height_px()), 0.6); }

Appearance VelocityElement::appearance(double t) {
    constexpr double kWide = 8;  // units on either side: half a head, its outline and its joins
    const double around = kWide * unit_px() + 1;
    Appearance found;
    for (std::size_t i = 0; i < inks_.size(); ++i) {
        const auto shown = arrow(i, t);
        if (!shown) continue;
        for (const double px : {shown->from.x(), shown->from.y(), shown->to.x(), shown->to.y()})
            found.state.push_back(px);
        found.state.push_back(static_cast<double>(i));
        const Vec2 low = shown->from.cwiseMin(shown->to), high = shown->from.cwiseMax(shown->to);
        const auto px = [](double at, int size) {
            return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
        };
        found.parts.push_back({px(low.x() - around, view_.width_px()),
                               px(low.y() - around, view_.height_px()),
                               px(high.x() + around + 1, view_.width_px()),
                               px(high.y() + around + 1, view_.height_px())});
    }
    return found;
}

void VelocityElement::draw(double t, Image& picture) {
    const double unit = unit_px();
    const double far = 4.0 * (view_.width_px() + view_.height_px());
    Canvas canvas(picture);
    cairo_t* c = canvas.context();
    for (std::size_t i = 0; i < inks_.size(); ++i) {
        const auto found = arrow(i, t);
        if (!found) continue;
        const Vec2 along = found->to - found->from;
        const double length = along.norm();
        constexpr double kInvisible = 1.5, kPlain = 6;  // px
        const double alpha = std::clamp((length - kInvisible) / (kPlain - kInvisible), 0.0, 1.0);
        if (!(alpha > 0) || found->from.norm() > far) continue;
        cairo_save(c);
        cairo_translate(c, found->from.x(), found->from.y());
        cairo_rotate(c, std::atan2(along.y(), along.x()));
        arrow_path(c, std::min(length, far), unit);
        cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
        cairo_set_line_width(c, 2.2 * unit);
        canvas.use(with_alpha(palette_.paper, 0.85 * alpha));
        cairo_stroke_preserve(c);
        canvas.use(with_alpha(inks_[i], alpha));
        cairo_fill(c);
        cairo_restore(c);
    }
    canvas.finish();
}

ElementKind velocity_kind() {
    ElementKind kind;
    kind.name = "velocity";
    kind.wanted = [](const Scene& scene) { return scene.overlay.velocity.has_value(); };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        if (context.scene.balls.empty()) return nullptr;
        return std::make_unique<VelocityElement>(context.scene, context.motion, context.view,
                                                 context.palette);
    };
    return kind;
}

}  // namespace carom
