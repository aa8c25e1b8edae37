#include "render/overlay.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "render/font.h"
#include "render/overlay_against.h"
#include "render/overlay_clock.h"
#include "render/overlay_labels.h"
#include "render/overlay_peaks.h"
#include "render/overlay_plot.h"
#include "render/overlay_ruler.h"
#include "render/overlay_style.h"
#include "render/overlay_text.h"
#include "render/overlay_trail.h"
#include "render/overlay_velocity.h"
#include "render/overlay_verdict.h"
#include "render/two_runs.h"

namespace carom {

namespace {

/// One rectangle of `layer`, on top of what is in `target` or in its place.
void lay_part(const Image& layer, const OverlayPainter::Rect& part, Image& target, bool over) {
    const auto length = 4 * static_cast<std::ptrdiff_t>(part.width);
    for (int y = part.y; y < part.bottom(); ++y) {
        const std::uint8_t* from = layer.row(y) + 4 * static_cast<std::ptrdiff_t>(part.x);
        std::uint8_t* to = target.row(y) + 4 * static_cast<std::ptrdiff_t>(part.x);
        if (!over) {
            std::copy_n(from, length, to);
            continue;
        }
        for (std::ptrdiff_t i = 0; i < length; i += 4) lay_pixel_over(from + i, to + i);
    }
}

}  // namespace

class OverlayPainter::Impl {
  public:
    Impl(const Scene& scene, const Motion& motion, const View& view, const Runs& runs)
        : view_(view),
          scene_(scene),
          ruler_scene_(runs.beside != nullptr ? runs.beside->scene : scene),
          ruler_motion_(runs.beside != nullptr ? runs.beside->motion : motion),
          palette_(palette_of(scene.overlay.theme)) {
        const Overlay& wanted = scene.overlay;
        if (runs.taken != nullptr) obstacles_ = *runs.taken;
        set_ruler();
        if (wanted.ruler && !has_room_for_ruler(view)) left_out_.emplace_back("ruler");
        if (wanted.clock) {
            clock_.emplace(*wanted.clock, motion.duration, view_.width_px(), view_.height_px(),
                           palette_);
            keep_if_whole(clock_, "clock");
        }
        set_text();
        const Scene& curves_scene = runs.curves ? runs.beside->scene : scene;
        const Motion& curves_motion = runs.curves ? runs.beside->motion : motion;
        if (wanted.plot && !wanted.plot->balls.empty()) {
            plot_.emplace(curves_scene, curves_motion, view_.width_px(), view_.height_px(),
                          obstacles_, palette_);
            keep_if_whole(plot_, "plot");
        }
        if (const auto verdict = judge_rebound(scene, motion)) {
            verdict_.emplace(scene, motion, *verdict, view_.width_px(), view_.height_px(),
                             obstacles_, around_ruler(), palette_);
            keep_if_whole(verdict_, "verdict");
        }
        if (runs.second != nullptr) {
            OverlayAgainst::Surroundings around{around_ruler(), {}};
            if (runs.curves) around.places = ball_places(motion, *runs.second, view_);
            against_.emplace(scene, motion, *runs.second, view_.width_px(), view_.height_px(),
                             around, palette_);
            keep_if_whole(against_, "against");
        }
        if (wanted.peaks && !scene.balls.empty())
            peaks_.emplace(scene, motion, view_, around_ruler(), palette_);
        if (wanted.velocity && !scene.balls.empty())
            velocity_.emplace(scene, motion, view_, palette_);
        if (wanted.labels && !scene.balls.empty()) labels_.emplace(scene, motion, view_);
        if (wanted.trail && !scene.balls.empty())
            trails_.emplace(curves_scene, curves_motion, view_);
    }

    /// Leaves out what the picture has no room for.
    template <class Element>
    void keep_if_whole(std::optional<Element>& element, const char* name) {
        const Rect rect = element->rect();
        const bool inside = !rect.empty() && rect.x >= 0 && rect.y >= 0 &&
                            rect.right() <= view_.width_px() && rect.bottom() <= view_.height_px();
        if (inside) {
            obstacles_.push_back(rect);
            return;
        }
        element.reset();
        left_out_.emplace_back(name);
    }

    void set_view(const View& view) {
        view_ = view;
        set_ruler();
        if (peaks_) peaks_->set_view(view, around_ruler());
        if (velocity_) velocity_->set_view(view);
        if (labels_) labels_->set_view(view);
        if (trails_) trails_->view_has_changed();
    }

    void set_ruler() {
        ruler_.reset();
        if (const auto staff = stand_ruler(ruler_scene_, ruler_motion_, view_))
            ruler_ = lay_out_ruler(*staff, view_);
        if (ruler_ && !ruler_font_) ruler_font_.emplace(ruler_font_px(view_));
    }

    /// The obstacles and the ruler with its numbers.
    std::vector<Rect> around_ruler() const {
        std::vector<Rect> taken = obstacles_;
        if (!ruler_) return taken;
        const double numbers = 3 * ruler_font_px(view_), staff = ruler_font_px(view_);
        const bool right = ruler_->staff.right_of_motion;
        const auto [left_px, right_px] = std::minmax(ruler_->low_px.x(), ruler_->high_px.x());
        const auto [top_px, bottom_px] = std::minmax(ruler_->low_px.y(), ruler_->high_px.y());
        const double begin = left_px - (right ? 0.2 * staff : numbers);
        const double end = right_px + (right ? numbers : 0.2 * staff);
        taken.push_back({static_cast<int>(begin), static_cast<int>(top_px - 2 * staff),
                         static_cast<int>(end - begin),
                         static_cast<int>(bottom_px - top_px + 3 * staff)});
        return taken;
    }

    /// Title and caption.
    void set_text() {
        const auto add = [&](std::optional<OverlayText>& text, const OverlayText::Request& wish,
                             const char* name) {
            text.emplace(wish, view_.width_px(), view_.height_px(), obstacles_, palette_);
            keep_if_whole(text, name);
        };
        const Overlay& wanted = scene_.overlay;
        constexpr double kCaptionPx = 15;  // letters, at 720
        // Light letters want a plate on the light sky.
        const bool dark = wanted.theme == Theme::kDark;
        if (wanted.title) add(title_, {scene_.title, wanted.title->size_px, true, dark}, "title");
        if (!wanted.caption.empty())
            add(caption_, {wanted.caption, kCaptionPx, false, true}, "caption");
    }

    /// Makes the changed parts of `under_` again; returns the rectangle that holds them.
    Rect compose_under(const Rect& trails, const Rect& peaks) {
        if (under_.width_px == 0) under_ = Image(view_.width_px(), view_.height_px());
        Rect changed = trails.joined(peaks);
        const int right = std::min(changed.x + changed.width, under_.width_px);
        const int bottom = std::min(changed.y + changed.height, under_.height_px);
        changed.x = std::max(changed.x, 0);
        changed.y = std::max(changed.y, 0);
        changed.width = std::max(right - changed.x, 0);
        changed.height = std::max(bottom - changed.y, 0);
        if (changed.empty()) return {};
        lay_part(trails_->picture(), changed, under_, false);
        lay_part(peaks_->picture(), changed, under_, true);
        return changed;
    }

    View view_;
    const Scene& scene_;
    const Scene& ruler_scene_;  ///< of both runs, where there are two
    const Motion& ruler_motion_;
    const Palette palette_;
    std::optional<RulerLayout> ruler_;
    std::optional<Font> ruler_font_;
    std::optional<OverlayText> title_, caption_;
    std::optional<OverlayClock> clock_;
    std::vector<Rect> obstacles_;
    std::vector<std::string> left_out_;
    std::optional<OverlayVerdict> verdict_;
    std::optional<OverlayLabels> labels_;
    std::optional<OverlayTrails> trails_;
    std::optional<OverlayPeaks> peaks_;
    std::optional<OverlayVelocity> velocity_;
    std::optional<OverlayPlot> plot_;
    std::optional<OverlayAgainst> against_;
    Image under_;  ///< trails with the peaks over them, where there are both
    const Image nothing_;
};

OverlayPainter::OverlayPainter(const Scene& scene, const Motion& motion, const View& view,
                               const Runs& runs)
    : impl_(std::make_unique<Impl>(scene, motion, view, runs)) {}
OverlayPainter::~OverlayPainter() = default;
OverlayPainter::OverlayPainter(OverlayPainter&&) noexcept = default;
OverlayPainter& OverlayPainter::operator=(OverlayPainter&&) noexcept = default;

void OverlayPainter::set_view(const View& view) { impl_->set_view(view); }

const std::vector<OverlayPainter::Rect>& OverlayPainter::obstacles() const {
    return impl_->obstacles_;
}

const std::vector<std::string>& OverlayPainter::left_out() const { return impl_->left_out_; }

Image OverlayPainter::static_under_layer() const {
    if (!impl_->ruler_) return {};
    return draw_ruler(*impl_->ruler_, impl_->view_, *impl_->ruler_font_, impl_->palette_);
}

bool OverlayPainter::has_moving_under_layer() const { return impl_->trails_ || impl_->peaks_; }

OverlayPainter::Rect OverlayPainter::update_moving_under_layer(double t) {
    const Rect trails = impl_->trails_ ? impl_->trails_->update(t) : Rect{};
    if (!impl_->peaks_) return trails;
    const Rect peaks = impl_->peaks_->update(t);
    return impl_->trails_ ? impl_->compose_under(trails, peaks) : peaks;
}

const Image& OverlayPainter::moving_under_layer() const {
    if (impl_->trails_ && impl_->peaks_) return impl_->under_;
    if (impl_->peaks_) return impl_->peaks_->picture();
    return impl_->trails_ ? impl_->trails_->picture() : impl_->nothing_;
}

void OverlayPainter::draw_over(double t, Image& picture) const {
    if (impl_->clock_) impl_->clock_->draw(t, picture);
    if (impl_->velocity_) impl_->velocity_->draw(t, picture);
    if (impl_->title_) impl_->title_->draw(picture);
    if (impl_->caption_) impl_->caption_->draw(picture);
    if (impl_->plot_) impl_->plot_->draw(t, picture);
    if (impl_->against_) impl_->against_->draw(t, picture);
    if (impl_->verdict_ && impl_->verdict_->shown_at(t)) impl_->verdict_->draw(picture);
    if (impl_->labels_) impl_->labels_->draw(t, impl_->obstacles_, picture);
}

}  // namespace carom
