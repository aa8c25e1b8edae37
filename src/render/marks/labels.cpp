#include "render/marks/labels.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/draw2d/style.h"
#include "render/marks/taken_places.h"
#include "scene/film_clock.h"

namespace carom {

namespace {

constexpr int kBetween = 1;  // px between two labels; keeps them apart after rounding

/// A label that looks for its place; y is its top edge.
struct Seeker {
    double x, y, width, height;
    const TakenPlaces& taken;

    PixelRect rounded() const {
        return PixelRect::at(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)),
                             static_cast<int>(width), static_cast<int>(height));
    }
    const PixelRect* in_the_way() const {
        const PixelRect here = rounded();
        const std::size_t first = taken.first_near(
            here, 0, 0, [&](const PixelRect& other) { return here.overlaps(other); });
        return first < taken.count() ? &taken[first] : nullptr;
    }

    /// Moves straight away from the centres of those in the way until it just touches them. With
    /// distances in units of half the sizes, the overlap is a square around the other's centre,
    /// and a point inside goes along its ray to the square's edge: continuous but in the centre.
    void give_way() {
        double dx = 0, dy = 0, inside = 0;
        const auto meets = [&](const PixelRect& other) {
            dx = x + 0.5 * width - other.middle_x();
            dy = y + 0.5 * height - other.middle_y();
            const double u = std::abs(dx) / (0.5 * (width + other.width()) + kBetween);
            const double v = std::abs(dy) / (0.5 * (height + other.height()) + kBetween);
            inside = std::max(u, v);
            return inside < 1 && inside > 0;
        };
        constexpr int kAround = kBetween + 1;  // and rounding
        for (std::size_t next = 0;; ++next) {
            next = taken.first_near(rounded(), kAround, next, meets);
            if (next >= taken.count()) return;
            meets(taken[next]);
            x += dx * (1 / inside - 1);
            y += dy * (1 / inside - 1);
        }
    }
    /// To the nearest free place in one direction.
    void evade(double direction) {
        for (std::size_t i = 0; i <= taken.count(); ++i) {
            const PixelRect* other = in_the_way();
            if (!other) return;
            y = direction < 0 ? other->top - height - kBetween : other->bottom + kBetween;
        }
    }
};

}  // namespace

std::vector<std::optional<LabelPlace>> place_labels(const std::vector<LabelWish>& wishes,
                                                    int width_px, int height_px,
                                                    const std::vector<PixelRect>& obstacles) {
    std::vector<std::optional<LabelPlace>> places(wishes.size());
    TakenPlaces taken(width_px, height_px, obstacles);
    for (std::size_t i = 0; i < wishes.size(); ++i) {
        const LabelWish& wish = wishes[i];
        if (!wish.in_picture || wish.width > width_px || wish.height > height_px) continue;
        Seeker label{wish.center_x - 0.5 * wish.width, wish.bottom_y - wish.height,
                     double(wish.width), double(wish.height), taken};
        const double lowest = height_px - wish.height, rightmost = width_px - wish.width;
        const auto stay_in_picture = [&] {
            label.x = std::clamp(label.x, 0.0, rightmost);
            label.y = std::clamp(label.y, 0.0, lowest);
        };
        stay_in_picture();
        // Between two others it takes a few turns to settle.
        for (int turn = 0; turn < 4 && label.in_the_way(); ++turn) label.give_way();
        stay_in_picture();
        const double settled = label.y;
        label.evade(-1);
        if (label.y < 0) {  // no room above: below what is in the way
            label.y = settled;
            label.evade(+1);
        }
        const PixelRect rect = label.rounded();
        if (rect.top < 0 || rect.top > lowest || label.in_the_way()) continue;
        places[i] = LabelPlace{rect};
        taken.add(rect);
    }
    return places;
}

LabelsElement::LabelsElement(const Scene& scene, const Motion& motion, const View& view,
                             std::vector<PixelRect> taken)
    : scene_(scene),
      motion_(motion),
      view_(view),
      taken_(std::move(taken)),
      palette_(palette_of(scene.overlay.theme)),
      font_(letters_px(scene.overlay.labels->size_px, view.height_px())),
      halo_px_(0.2 * font_.size_px()),
      gap_px_(0.15 * font_.size_px()),
      pictures_(scene.balls.size()),
      rises_([this](double film_s) { return ways_up(film_s); }) {
    const double border = std::ceil(halo_px_);
    height_px_ =
        static_cast<int>(std::ceil(font_.cap_height_px() + font_.descent_px() + 2 * border));
    for (const Ball& ball : scene.balls) {
        const double text_px = font_.lay_out(label_text(ball.name)).width_px;
        widths_px_.push_back(static_cast<int>(std::ceil(text_px + 2 * border)));
    }
}

const Image& LabelsElement::picture_of(std::size_t ball) const {
    Image& picture = pictures_[ball];
    if (picture.width_px != 0) return picture;
    const double border = std::ceil(halo_px_);
    picture = Image(widths_px_[ball], height_px_);
    Canvas canvas(picture);
    const double base = std::round(height_px_ - border - font_.descent_px());
    font_.draw(canvas, font_.lay_out(label_text(scene_.balls[ball].name)), border, base,
               palette_.ink, halo_px_, palette_.paper);
    canvas.finish();
    return picture;
}

std::vector<LabelWish> LabelsElement::wishes(double t) const {
    std::vector<LabelWish> wishes(widths_px_.size());
    for (std::size_t i = 0; i < wishes.size(); ++i) {
        const View::Projected center = view_.project(motion_.balls[i].at(t).position);
        const double radius = scene_.balls[i].radius;
        const double radius_px = radius * view_.pixels_per_metre(center.depth_m);
        LabelWish& wish = wishes[i];
        wish.in_picture = center.depth_m > radius && center.x_px > -radius_px &&
                          center.x_px < view_.width_px() + radius_px && center.y_px > -radius_px &&
                          center.y_px < view_.height_px() + radius_px;
        wish.center_x = center.x_px;
        wish.bottom_y = center.y_px - radius_px - gap_px_;
        wish.width = widths_px_[i];
        wish.height = height_px_;
    }
    return wishes;
}

namespace {

/// 1 for labels that pass each other level, 0 for those at least two heights apart. `before` and
/// `after` are their distances in height at two instants: they may have crossed in between.
double level(double before, double after, double height) {
    if (before * after <= 0) return 1;
    const double apart = std::min(std::abs(before), std::abs(after)) / height;
    return std::clamp(2 - apart, 0.0, 1.0);
}

/// 1 at the instant itself, falling smoothly to 0 at the edge of what is looked at.
double nearness(double share) {
    const double rest = std::clamp(1 - share, 0.0, 1.0);
    return rest * rest * (3 - 2 * rest);
}

}  // namespace

Eigen::MatrixXd LabelsElement::closeness(double t) const {
    constexpr int kSteps = 16;  // to either side
    constexpr double kStep_s = kLevelReach_s / kSteps;
    const auto count = static_cast<Eigen::Index>(widths_px_.size());
    Eigen::MatrixXd close = Eigen::MatrixXd::Zero(count, count);
    std::vector<LabelWish> before, after;
    const double now_s = film_time(scene_.film, t);
    for (int k = -kSteps; k <= kSteps; ++k) {
        const double moment = motion_time(scene_.film, now_s + k * kStep_s);
        after = wishes(std::clamp(moment, 0.0, motion_.duration));
        const double weight = nearness(std::min(std::abs(k), std::abs(k - 1)) / double(kSteps));
        for (Eigen::Index i = 0; i < count && !before.empty(); ++i) {
            for (Eigen::Index j = i + 1; j < count; ++j) {
                const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
                const double height = after[a].height + kBetween;
                const double met = level(before[a].bottom_y - before[b].bottom_y,
                                         after[a].bottom_y - after[b].bottom_y, height);
                close(i, j) = std::max(close(i, j), weight * met);
            }
        }
        before.swap(after);
    }
    return close;
}

void spread_labels(std::vector<LabelWish>& wishes, const Eigen::MatrixXd& close) {
    const std::vector<LabelWish> balls = wishes;
    constexpr int kTurns = 40;  // a row of a dozen labels has settled to a fraction of a pixel
    for (int turn = 0; turn < kTurns; ++turn) {
        for (std::size_t i = 0; i < wishes.size(); ++i) {
            for (std::size_t j = i + 1; j < wishes.size(); ++j) {
                const double share =
                    close(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                if (share == 0 || !balls[i].in_picture || !balls[j].in_picture) continue;
                const double apart = 0.5 * (balls[i].width + balls[j].width) + kBetween + 1;
                // In the order of their balls; each goes half of the way.
                const double order = balls[j].center_x >= balls[i].center_x ? 1 : -1;
                const double lacking =
                    share * apart - order * (wishes[j].center_x - wishes[i].center_x);
                if (lacking <= 0) continue;
                wishes[i].center_x -= 0.5 * order * lacking;
                wishes[j].center_x += 0.5 * order * lacking;
            }
        }
    }
}

std::vector<LabelWish> LabelsElement::spread_wishes(double t) const {
    std::vector<LabelWish> wanted = wishes(t);
    constexpr std::size_t kMany = 24;  // more names than anyone reads: not worth the time
    if (wanted.size() > 1 && wanted.size() <= kMany) spread_labels(wanted, closeness(t));
    return wanted;
}

std::vector<double> LabelsElement::ways_up(double film_s) const {
    const double t = motion_time(scene_.film, film_s);
    std::vector<double> ways(widths_px_.size(), 0.0);
    if (t < 0 || t > motion_.duration) return ways;  // nothing lasts beyond the motion
    // Under a camera that moves all is asked again for each picture, and neighbours are left out.
    const std::vector<LabelWish> wanted = view_moves_ ? wishes(t) : spread_wishes(t);
    std::vector<BallDisc> discs(wanted.size());
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const View::Projected center = view_.project(motion_.balls[i].at(t).position);
        discs[i] = {Vec2(center.x_px, center.y_px),
                    scene_.balls[i].radius * view_.pixels_per_metre(center.depth_m),
                    wanted[i].in_picture};
    }
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const LabelWish& wish = wanted[i];
        if (wish.in_picture)
            ways[i] =
                rise_over_balls({wish.center_x - 0.5 * wish.width, wish.center_x + 0.5 * wish.width,
                                 wish.bottom_y, static_cast<double>(wish.height)},
                                i, discs);
    }
    return ways;
}

std::vector<std::optional<LabelPlace>> LabelsElement::place(
    double t, const std::vector<PixelRect>& obstacles) const {
    std::vector<LabelWish> wanted = spread_wishes(t);
    constexpr std::size_t kMany = 200;  // beyond, names are noise, and each pair would be asked
    std::vector<double> opacities(wanted.size(), 1.0);
    if (wanted.size() > 1 && wanted.size() <= kMany) {
        const std::vector<double> rises = rises_.at(film_time(scene_.film, t));
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            opacities[i] = opacity_of_risen(rises[i], wanted[i].height);
            wanted[i].bottom_y -= rises[i];
            wanted[i].in_picture &= opacities[i] > 0;
        }
    }
    auto places = place_labels(wanted, view_.width_px(), view_.height_px(), obstacles);
    // What counts for the line is the distance from the ball, however the label came there.
    const std::vector<LabelWish> balls = wishes(t);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!places[i]) continue;
        const PixelRect& rect = places[i]->rect;
        const double aside = std::abs(rect.middle_x() - balls[i].center_x);
        const double aloft = std::abs(rect.bottom - balls[i].bottom_y);
        places[i]->opacity = opacities[i];
        places[i]->away = aside > 0.6 * rect.width() || aloft > 0.8 * rect.height();
    }
    return places;
}

void LabelsElement::set_view(const View& view, const std::vector<PixelRect>& /*around*/) {
    view_ = view;
    view_moves_ = true;
    rises_.forget();
    drawn_.reset();
}

void LabelsElement::draw_lines(const std::vector<std::optional<LabelPlace>>& places,
                               const std::vector<LabelWish>& balls, Image& picture) const {
    std::optional<Canvas> canvas;
    const auto stroke = [&](double opacity) {
        canvas->use(with_alpha(palette_.ink, 0.55 * opacity));
        cairo_set_line_width(canvas->context(), std::max(1.0, overlay_px(1, view_.height_px())));
        cairo_stroke(canvas->context());
    };
    for (const bool faded : {false, true}) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!places[i] || !places[i]->away || (places[i]->opacity < 1) != faded) continue;
            if (!canvas) canvas.emplace(picture);
            // The shortest way from the ball's top to the label.
            const PixelRect& rect = places[i]->rect;
            const double x = balls[i].center_x, y = balls[i].bottom_y + gap_px_;
            cairo_move_to(canvas->context(), std::clamp(x, double(rect.left), double(rect.right)),
                          std::clamp(y, rect.top + gap_px_, rect.bottom - gap_px_));
            cairo_line_to(canvas->context(), x, y);
            if (faded) stroke(places[i]->opacity);
        }
        if (canvas && !faded) stroke(1);
    }
    if (canvas) canvas->finish();
}

const LabelsElement::Drawn& LabelsElement::drawn_at(double t) {
    if (!drawn_ || drawn_->t != t) drawn_ = Drawn{t, place(t, taken_), wishes(t)};
    return *drawn_;
}

Appearance LabelsElement::appearance(double t) {
    const Drawn& drawn = drawn_at(t);
    Appearance found;
    for (std::size_t i = 0; i < drawn.places.size(); ++i) {
        const std::optional<LabelPlace>& place = drawn.places[i];
        if (!place) continue;
        const PixelRect& rect = place->rect;
        for (const int px : {static_cast<int>(i), rect.left, rect.top, int{place->away}})
            found.state.push_back(px);
        found.state.push_back(place->opacity);
        found.parts.push_back(rect);
        if (!place->away) continue;
        // The line to its ball, and half its width.
        const double x = drawn.balls[i].center_x, y = drawn.balls[i].bottom_y + gap_px_;
        found.state.insert(found.state.end(), {x, y});
        constexpr int kLine = 4;
        const auto px = [](double at, int size) {
            return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
        };
        const int left = px(x, view_.width_px()), top = px(y, view_.height_px());
        const PixelRect line =
            PixelRect{left, top, left + 1, top + 1}.joined(rect.empty() ? PixelRect{} : rect);
        found.parts.push_back(
            {line.left - kLine, line.top - kLine, line.right + kLine, line.bottom + kLine});
    }
    return found;
}

void LabelsElement::draw(double t, Image& picture) {
    const Drawn& drawn = drawn_at(t);
    const auto& places = drawn.places;
    draw_lines(places, drawn.balls, picture);  // first, so that names stay legible above them
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!places[i]) continue;
        const PixelRect& rect = places[i]->rect;
        if (places[i]->opacity < 1) {
            Image faded = picture_of(i);
            for (std::uint8_t& byte : faded.bgra)
                byte = static_cast<std::uint8_t>(std::lround(places[i]->opacity * byte));
            lay_over(faded, rect.left, rect.top, picture);
        } else {
            lay_over(picture_of(i), rect.left, rect.top, picture);
        }
    }
}

ElementKind labels_kind() {
    ElementKind kind;
    kind.name = "labels";
    kind.wanted = [](const Scene& scene) { return scene.overlay.labels.has_value(); };
    kind.make = [](const ElementContext& context) -> std::unique_ptr<Element> {
        if (context.scene.balls.empty()) return nullptr;
        return std::make_unique<LabelsElement>(context.scene, context.motion, context.view,
                                               context.taken);
    };
    return kind;
}

}  // namespace carom
