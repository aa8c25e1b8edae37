#include "render/marks/ruler.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/draw2d/round_steps.h"
#include "render/draw2d/style.h"

namespace carom {

namespace {

constexpr double kNumbersPx = 14;      // letters, at 720
constexpr double kMajorPitch = 4.2;    // least distance of numbers, in letters
constexpr double kMinorPitchPx = 5.0;  // least distance of ticks, at 720; never below 3 pixels

/// The part of [low, high] where c0 + c1 h >= 0.
void keep_where(double c0, double c1, double& low, double& high) {
    if (c1 == 0) {
        if (c0 < 0) high = low - 1;
    } else if (c1 > 0) {
        low = std::max(low, -c0 / c1);
    } else {
        high = std::min(high, -c0 / c1);
    }
}

struct Interval {
    double low, high;
};

/// Heights of the staff that project into the picture, a little beyond its edges included. Depth
/// and lateral place are linear in the height, and so is each side of the frame.
std::optional<Interval> visible_heights(const RulerStaff& staff, const View& view) {
    double low = staff.from_m, high = staff.to_m;
    const Vec3 foot = Vec3(staff.foot.x(), staff.foot.y(), 0) - view.eye();
    const auto axis = [&](const Vec3& n) { return std::array{n.dot(foot), n.z()}; };
    const auto depth = axis(view.forward()), x = axis(view.right()), y = axis(view.up());
    constexpr double kBeyond = 1.1;  // of the half picture
    const double tan_y = kBeyond * view.tan_half_fov_y();
    const double tan_x = tan_y * view.width_px() / view.height_px();
    constexpr double kNear = 1e-3;  // of the distance to the staff; nearer to the eye is not drawn
    keep_where(depth[0] - kNear * foot.head<2>().norm(), depth[1], low, high);
    for (const double sign : {-1.0, 1.0}) {
        keep_where(tan_x * depth[0] + sign * x[0], tan_x * depth[1] + sign * x[1], low, high);
        keep_where(tan_y * depth[0] + sign * y[0], tan_y * depth[1] + sign * y[1], low, high);
    }
    if (!(high > low)) return std::nullopt;
    return Interval{low, high};
}

bool divides(double step, double into) {
    const double ratio = into / step;
    return std::abs(ratio - std::round(ratio)) < 1e-6;
}

/// The largest proper 1-2-5 divisor of `step` that is at most `most`, else 0.
double finer_step(double step, double most, double least) {
    for (double candidate = step_at_least(least); candidate <= most * (1 + 1e-9);
         candidate = step_at_least(candidate * 1.5))
        if (divides(candidate, step)) return candidate;
    return 0;
}

Vec2 staff_px(const RulerStaff& staff, const View& view, double height) {
    const View::Projected p = view.project(Vec3(staff.foot.x(), staff.foot.y(), height));
    return {p.x_px, p.y_px};
}

std::string number_text(double height, double step) {
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    const std::string text = fmt::format("{:.{}f}", std::abs(height), decimals);
    const bool negative = height < -0.5 * std::pow(10, -decimals);
    return negative ? "\u2212" + text : text;
}

}  // namespace

double ruler_font_px(const View& view) { return letters_px(kNumbersPx, view.height_px()); }

namespace {

/// For the staff and its numbers, px.
double room_px(const View& view) { return 3.5 * ruler_font_px(view); }

}  // namespace

bool has_room_for_ruler(const View& view) { return view.width_px() >= 2 * room_px(view); }

std::optional<RulerStaff> stand_ruler(const Scene& scene, const Motion& motion, const View& view) {
    if (!scene.overlay.ruler || !has_room_for_ruler(view)) return std::nullopt;
    const MotionExtent extent(scene, motion);
    const double room = room_px(view);
    const auto foot_px = [&](const RulerStaff& staff) {
        const double middle = std::clamp(extent.ball_box().center().z(), staff.from_m,
                                         std::max(staff.from_m, staff.to_m));
        return view.project(Vec3(staff.foot.x(), staff.foot.y(), middle));
    };
    auto left = place_ruler(scene, motion, extent, view.right());
    if (scene.overlay.ruler->at || foot_px(*left).x_px >= room) return left;
    const auto right = place_ruler(scene, motion, extent, view.right(), true);
    if (foot_px(*right).x_px <= view.width_px() - room) return right;
    // No room on either side: at the left edge, balls pass in front of it.
    const View::Projected at = foot_px(*left);
    if (at.depth_m > 0)
        left->foot +=
            ((room - at.x_px) / view.pixels_per_metre(at.depth_m) * view.right()).head<2>();
    return left;
}

std::optional<RulerLayout> lay_out_ruler(const RulerStaff& staff, const View& view) {
    const auto heights = visible_heights(staff, view);
    if (!heights) return std::nullopt;
    RulerLayout layout;
    layout.staff = staff;
    layout.low_px = staff_px(staff, view, heights->low);
    layout.high_px = staff_px(staff, view, heights->high);
    const double length_px = (layout.high_px - layout.low_px).norm();
    if (staff.band) {
        const double low = std::max((*staff.band)[0], heights->low);
        const double high = std::min((*staff.band)[1], heights->high);
        if (high > low) layout.band_px = {staff_px(staff, view, low), staff_px(staff, view, high)};
    }
    constexpr double kShortest = 8;  // px; a shorter staff has no room for two ticks
    if (!(length_px > kShortest) || !std::isfinite(length_px)) return std::nullopt;

    // Numbers first, then the finest ticks that have room, then those in between.
    const double m_per_px = (heights->high - heights->low) / length_px;
    const double major = step_at_least(kMajorPitch * ruler_font_px(view) * m_per_px);
    const double pitch = std::max(overlay_px(kMinorPitchPx, view.height_px()), 3.0);
    const double minor = finer_step(major, 0.5 * major, pitch * m_per_px);
    const double medium = minor > 0 ? finer_step(major, 0.5 * major, 2.5 * minor) : 0;
    layout.major_step_m = major;

    const double step = minor > 0 ? minor : major;
    constexpr double kRounding = 1e-6;  // of a step: a tick at the very end belongs to the staff
    const double first = std::ceil(heights->low / step - kRounding);
    const double last = std::floor(heights->high / step + kRounding);
    // So far up or down that marks are no longer apart by what a double can tell.
    constexpr double kMostMarks = 1e12;  // from height 0
    if (!(std::max(std::abs(first), std::abs(last)) < kMostMarks)) return std::nullopt;
    for (double k = first; k <= last; ++k) {
        RulerTick tick;
        tick.height_m = k * step;
        tick.px = staff_px(staff, view, tick.height_m);
        if (divides(major, tick.height_m)) {
            tick.rank = TickRank::kMajor;
            tick.label = number_text(tick.height_m, major);
        } else if (medium > 0 && divides(medium, tick.height_m)) {
            tick.rank = TickRank::kMedium;
        }
        layout.ticks.push_back(std::move(tick));
    }
    return layout;
}

namespace {

/// The marked part: a stripe from the staff's far edge to where the balls are.
void draw_band(Canvas& canvas, const RulerLayout& layout, double away, double width, double unit,
               const Ink& good) {
    if (!layout.band_px) return;
    constexpr double kTowardsBalls = 110;  // px at 720
    const Vec2 low = (*layout.band_px)[0], high = (*layout.band_px)[1];
    const double near = -away * kTowardsBalls * unit, far = away * width;
    cairo_t* c = canvas.context();
    cairo_move_to(c, low.x() + near, low.y());
    cairo_line_to(c, low.x() + far, low.y());
    cairo_line_to(c, high.x() + far, high.y());
    cairo_line_to(c, high.x() + near, high.y());
    cairo_close_path(c);
    canvas.use(with_alpha(good, 0.30));
    cairo_fill(c);
    for (const Vec2& end : {low, high}) {
        cairo_move_to(c, end.x() + near, end.y());
        cairo_line_to(c, end.x() + far, end.y());
    }
    canvas.use(with_alpha(good, 0.9));
    cairo_set_line_width(c, std::max(1.2 * unit, 1.0));
    cairo_stroke(c);
}

}  // namespace

void draw_ruler(const RulerLayout& layout, const View& view, const Font& font,
                const Palette& palette, Image& picture) {
    Canvas canvas(picture);
    cairo_t* c = canvas.context();
    const double unit = std::max(overlay_px(1, view.height_px()), 0.55);
    const double width = 11 * unit, line = std::max(1.4 * unit, 1.0);
    // From the edge of the staff that faces the balls, away from them.
    const double away = layout.staff.right_of_motion ? 1 : -1;

    // The staff: a light band with a dark edge towards the balls.
    const auto band = [&](double from, double to) {
        cairo_move_to(c, layout.low_px.x() + away * from, layout.low_px.y());
        cairo_line_to(c, layout.low_px.x() + away * to, layout.low_px.y());
        cairo_line_to(c, layout.high_px.x() + away * to, layout.high_px.y());
        cairo_line_to(c, layout.high_px.x() + away * from, layout.high_px.y());
        cairo_close_path(c);
    };
    band(-0.5 * line, width);
    canvas.use(with_alpha(palette.paper, 0.82));
    cairo_fill_preserve(c);
    canvas.use(with_alpha(palette.ink, 0.30));
    cairo_set_line_width(c, std::max(0.8 * unit, 0.7));
    cairo_stroke(c);
    canvas.use(with_alpha(palette.ink, 0.9));
    band(-0.5 * line, 0.5 * line);
    cairo_fill(c);

    draw_band(canvas, layout, away, width, unit, palette.good);

    for (const RulerTick& tick : layout.ticks) {
        const bool major = tick.rank == TickRank::kMajor;
        const double share = major ? 1.0 : tick.rank == TickRank::kMedium ? 0.62 : 0.36;
        canvas.use(with_alpha(palette.ink, major ? 1.0 : 0.75));
        cairo_set_line_width(c, major ? line : std::max(0.9 * unit, 0.8));
        cairo_move_to(c, tick.px.x(), tick.px.y());
        cairo_line_to(c, tick.px.x() + away * share * width, tick.px.y());
        cairo_stroke(c);
    }

    // The unit stands above the staff, or, where that is out of the picture, behind the top number.
    const double halo = 0.2 * font.size_px();
    const double unit_y = layout.high_px.y() - 0.6 * font.size_px();
    const bool above = unit_y - font.cap_height_px() - halo >= 0;
    const RulerTick* top = nullptr;
    for (const RulerTick& tick : layout.ticks)
        if (!tick.label.empty() && (top == nullptr || tick.px.y() < top->px.y())) top = &tick;
    for (const RulerTick& tick : layout.ticks) {
        if (tick.label.empty()) continue;
        const TextRun text = font.lay_out(tick.label + (&tick == top && !above ? " m" : ""));
        const double near_edge = tick.px.x() + away * (width + 6 * unit);
        font.draw(canvas, text, away > 0 ? near_edge : near_edge - text.width_px,
                  tick.px.y() + 0.5 * font.cap_height_px(), palette.ink, halo, palette.paper);
    }
    if (above) {
        const TextRun metres = font.lay_out("m");
        font.draw(canvas, metres, layout.high_px.x() + away * 0.5 * width - 0.5 * metres.width_px,
                  unit_y, palette.ink, halo, palette.paper);
    }
    canvas.finish();
}

RulerElement::RulerElement(const Scene& scene, const Motion& motion, const View& view,
                           const Palette& palette)
    : scene_(scene), motion_(motion), view_(view), palette_(palette) {
    RulerElement::set_view(view, {});
}

void RulerElement::set_view(const View& view, const std::vector<PixelRect>& /*around*/) {
    view_ = view;
    layout_.reset();
    if (const auto staff = stand_ruler(scene_, motion_, view_))
        layout_ = lay_out_ruler(*staff, view_);
    if (layout_ && !font_) font_.emplace(ruler_font_px(view_));
}

PixelRect RulerElement::rect() const {
    if (!layout_) return {};
    const double numbers = 3 * ruler_font_px(view_), staff = ruler_font_px(view_);
    const bool right = layout_->staff.right_of_motion;
    const auto [left_px, right_px] = std::minmax(layout_->low_px.x(), layout_->high_px.x());
    const auto [top_px, bottom_px] = std::minmax(layout_->low_px.y(), layout_->high_px.y());
    const double begin = left_px - (right ? 0.2 * staff : numbers);
    const double end = right_px + (right ? numbers : 0.2 * staff);
    return PixelRect::at(static_cast<int>(begin), static_cast<int>(top_px - 2 * staff),
                         static_cast<int>(end - begin),
                         static_cast<int>(bottom_px - top_px + 3 * staff));
}

void RulerElement::draw(double /*t*/, Image& picture) {
    if (layout_) draw_ruler(*layout_, view_, *font_, palette_, picture);
}

ElementKind ruler_kind() {
    ElementKind kind;
    kind.name = "ruler";
    kind.layer = Layer::kBackground;
    kind.has_room = has_room_for_ruler;
    kind.wanted = [](const Scene& scene) { return scene.overlay.ruler.has_value(); };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        const bool both = context.both != nullptr;
        return std::make_unique<RulerElement>(both ? context.both->scene : context.scene,
                                              both ? context.both->motion : context.motion,
                                              context.view, context.palette);
    };
    return kind;
}

}  // namespace carom
