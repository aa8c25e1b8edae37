#include "render/picture/moving_layer.h"

#include "render/blend/linear_layer.h"
#include "render/blend/picture_layer.h"

namespace carom {

PixelRect MovingLayer::update(double t) {
    if (!overlay_.has_moving_layer()) return {};
    const PixelRect changed = overlay_.update_moving_layer(t);
    const Image& layer = overlay_.moving_layer();
    const PixelRect within = changed.common({0, 0, layer.width_px, layer.height_px});
    constexpr std::size_t kMostParts = 16;
    if (view_moves_) {
        filled_ = {filled_part(layer)};
    } else if (!within.empty()) {
        filled_.push_back(within);
        filled_ = apart(filled_, kMostParts);
    }
    return within;
}

void MovingLayer::lay_over(const std::vector<PixelRect>& parts, const GlFramebuffer& frame,
                           const GlTexture& color) const {
    if (!overlay_.has_moving_layer()) return;
    for (const PixelRect& part : parts)
        for (const PixelRect& filled : filled_)
            carom::lay_over(gl_, overlay_.moving_layer(), filled.common(part), frame, color);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame.name());
}

}  // namespace carom
