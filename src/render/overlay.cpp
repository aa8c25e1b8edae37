#include "render/overlay.h"

#include <optional>

#include "render/font.h"
#include "render/overlay_clock.h"
#include "render/overlay_labels.h"
#include "render/overlay_ruler.h"
#include "render/overlay_trail.h"
#include "render/overlay_verdict.h"

namespace carom {

class OverlayPainter::Impl {
  public:
    Impl(const Scene& scene, const Motion& motion, const View& view) : view_(view) {
        const Overlay& wanted = scene.overlay;
        if (const auto staff = stand_ruler(scene, motion, view_))
            ruler_ = lay_out_ruler(*staff, view_);
        if (wanted.clock) {
            clock_.emplace(*wanted.clock, motion.duration, view_.width_px(), view_.height_px(),
                           kOverlayFontFamily);
            obstacles_.push_back(clock_->rect());
        }
        if (const auto verdict = judge_rebound(scene, motion)) {
            verdict_.emplace(scene, motion, *verdict, view_.width_px(), view_.height_px(),
                             obstacles_, kOverlayFontFamily);
            obstacles_.push_back(verdict_->rect());
        }
        if (wanted.labels && !scene.balls.empty())
            labels_.emplace(scene, motion, view_, kOverlayFontFamily);
        if (wanted.trail && !scene.balls.empty()) trails_.emplace(scene, motion, view_);
    }

    const View view_;
    std::optional<RulerLayout> ruler_;
    std::optional<OverlayClock> clock_;
    std::vector<Rect> obstacles_;
    std::optional<OverlayVerdict> verdict_;
    std::optional<OverlayLabels> labels_;
    std::optional<OverlayTrails> trails_;
    const Image nothing_;
};

OverlayPainter::OverlayPainter(const Scene& scene, const Motion& motion, const View& view)
    : impl_(std::make_unique<Impl>(scene, motion, view)) {}
OverlayPainter::~OverlayPainter() = default;
OverlayPainter::OverlayPainter(OverlayPainter&&) noexcept = default;
OverlayPainter& OverlayPainter::operator=(OverlayPainter&&) noexcept = default;

Image OverlayPainter::static_under_layer() const {
    if (!impl_->ruler_) return {};
    const View& view = impl_->view_;
    return draw_ruler(*impl_->ruler_, view, Font(kOverlayFontFamily, ruler_font_px(view)));
}

bool OverlayPainter::has_moving_under_layer() const { return impl_->trails_.has_value(); }

OverlayPainter::Rect OverlayPainter::update_moving_under_layer(double t) {
    return impl_->trails_ ? impl_->trails_->update(t) : Rect{};
}

const Image& OverlayPainter::moving_under_layer() const {
    return impl_->trails_ ? impl_->trails_->picture() : impl_->nothing_;
}

void OverlayPainter::draw_over(double t, Image& picture) const {
    if (impl_->clock_) impl_->clock_->draw(t, picture);
    if (impl_->verdict_ && impl_->verdict_->shown_at(t)) impl_->verdict_->draw(picture);
    if (impl_->labels_) impl_->labels_->draw(t, impl_->obstacles_, picture);
}

}  // namespace carom
