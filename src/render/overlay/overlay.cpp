#include "render/overlay/overlay.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "render/draw2d/canvas.h"
#include "render/overlay/elements.h"

namespace carom {

namespace {

/// One rectangle of `layer`, on top of what is in `target` or in its place.
void lay_part(const Image& layer, const PixelRect& part, Image& target, bool over) {
    const auto length = 4 * static_cast<std::ptrdiff_t>(part.width());
    for (int y = part.top; y < part.bottom; ++y) {
        const std::uint8_t* from = layer.row(y) + 4 * static_cast<std::ptrdiff_t>(part.left);
        std::uint8_t* to = target.row(y) + 4 * static_cast<std::ptrdiff_t>(part.left);
        if (!over) {
            std::copy_n(from, length, to);
            continue;
        }
        for (std::ptrdiff_t i = 0; i < length; i += 4) lay_pixel_over(from + i, to + i);
    }
}

bool belongs_to(PicturePart part, Repeat repeat) {
    if (part == PicturePart::kWhole) return true;
    return (part == PicturePart::kOverHalves) == (repeat == Repeat::kOncePerFilm);
}

}  // namespace

OverlayPainter::OverlayPainter(const Scene& scene, const Motion& motion, const View& view,
                               Runs runs)
    : view_(view), taken_(std::move(runs.taken)) {
    for (const ElementKind& kind : element_kinds()) {
        if (!belongs_to(runs.part, kind.repeat) || !kind.wanted(scene)) continue;
        if (kind.has_room != nullptr && !kind.has_room(view)) {
            leave_out(kind);
            continue;
        }
        std::unique_ptr<Element> made =
            kind.make({scene, motion, view, runs.part, runs.second, runs.both,
                       palette_of(scene.overlay.theme), taken_, around()});
        if (!made || (kind.keeps_place && !takes_place(kind, made->rect()))) continue;
        auto& layer = kind.layer == Layer::kBackground   ? background_
                      : kind.layer == Layer::kBelowBalls ? below_balls_
                                                         : over_;
        layer.push_back(std::move(made));
    }
    if (below_balls_.size() > 1) composed_ = Image(view.width_px(), view.height_px());
}

void OverlayPainter::leave_out(const ElementKind& kind) {
    if (kind.name != nullptr) left_out_.emplace_back(kind.name);
}

bool OverlayPainter::takes_place(const ElementKind& kind, const PixelRect& rect) {
    const PixelRect whole{0, 0, view_.width_px(), view_.height_px()};
    if (rect.empty() || rect.common(whole) != rect) {
        leave_out(kind);
        return false;
    }
    taken_.push_back(rect);
    return true;
}

std::vector<PixelRect> OverlayPainter::around() const {
    std::vector<PixelRect> all = taken_;
    for (const auto& element : background_)
        if (!element->rect().empty()) all.push_back(element->rect());
    return all;
}

void OverlayPainter::set_view(const View& view) {
    view_ = view;
    for (const auto& element : background_) element->set_view(view, taken_);
    const std::vector<PixelRect> taken = around();
    for (const auto* layer : {&below_balls_, &over_})
        for (const auto& element : *layer) element->set_view(view, taken);
}

Image OverlayPainter::background_layer() const {
    Image picture;
    for (const auto& element : background_) {
        if (element->rect().empty()) continue;
        if (picture.width_px == 0) picture = Image(view_.width_px(), view_.height_px());
        element->draw(0, picture);
    }
    return picture;
}

PixelRect OverlayPainter::update_moving_layer(double t) {
    PixelRect changed;
    for (const auto& element : below_balls_) changed = changed.joined(element->update(t));
    if (below_balls_.size() < 2) return changed;
    changed = changed.common({0, 0, composed_.width_px, composed_.height_px});
    if (changed.empty()) return {};
    for (std::size_t i = 0; i < below_balls_.size(); ++i)
        lay_part(below_balls_[i]->picture(), changed, composed_, i > 0);
    return changed;
}

const Image& OverlayPainter::moving_layer() const {
    if (below_balls_.empty()) return nothing_;
    return below_balls_.size() > 1 ? composed_ : below_balls_.front()->picture();
}

void OverlayPainter::find_changes_over(double t, TileMask& tiles) {
    const auto add = [&](const Appearance& appearance) {
        for (const PixelRect& part : appearance.parts) tiles.add(part);
    };
    const bool known = !shown_.empty();
    shown_.resize(over_.size());
    for (std::size_t i = 0; i < over_.size(); ++i) {
        Appearance now = over_[i]->appearance(t);
        shown_[i].redrawn = !known || now != shown_[i].appearance;
        if (!shown_[i].redrawn) continue;
        add(shown_[i].appearance);
        add(now);
        shown_[i].appearance = std::move(now);
    }
    // What lies over something that changes is drawn again as a whole, once.
    for (bool again = true; again;) {
        again = false;
        for (Shown& shown : shown_) {
            const auto& parts = shown.appearance.parts;
            if (shown.redrawn || std::none_of(parts.begin(), parts.end(), [&](const auto& part) {
                    return tiles.touches(part);
                }))
                continue;
            shown.redrawn = again = true;
            add(shown.appearance);
        }
    }
}

void OverlayPainter::redraw_over(double t, Image& picture) const {
    for (std::size_t i = 0; i < over_.size(); ++i)
        if (shown_[i].redrawn) over_[i]->draw(t, picture);
}

void OverlayPainter::draw_over(double t, Image& picture) const {
    for (const auto& element : over_) element->draw(t, picture);
}

}  // namespace carom
