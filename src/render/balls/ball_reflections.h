// The balls' mirror images in polished surfaces: looks with `reflection` on planes and boxes' tops.
#pragma once

#include <vector>

#include "core/pixel_rect.h"
#include "render/background/background_picture.h"
#include "render/balls/ball_billboards.h"
#include "render/balls/mirror_blend.h"
#include "render/balls/mirrors.h"
#include "render/view/picture_scale.h"

namespace carom {

/// Exact: a mirror image of a sphere is a sphere, under mirrored light. Each mirror's images are
/// drawn into a layer of their own, where no mirrored body hides them; what they hide of the
/// mirrored sky and bodies (BackgroundPicture::mirror) is taken away, and they are added.
/// A ball's shadow is not seen in a mirrored body.
class BallReflections {
  public:
    /// `gl` and `scene` must outlive it.
    BallReflections(const Gl& gl, const Scene& scene, const View& view, const Lights& lights,
                    const PictureScale& scale, const BallSurroundings& around);

    /// Another view of the same size and kind.
    void set_view(const View& view, const Lights& lights, const PictureScale& scale);

    /// Onto `frame`, which draws into `color`, over the background and the shadows.
    void draw(const std::vector<BallInView>& balls, const BackgroundPicture& background,
              const GlFramebuffer& frame, const GlTexture& color);

    /// Uses its program, for drivers that compile at the first use; the viewport is without extent,
    /// and `frame` is bound in the end.
    void compile(const BackgroundPicture& background, const GlFramebuffer& frame);

    /// All images that draw() would show.
    std::vector<BallInView> images(const std::vector<BallInView>& balls) const;

  private:
    /// Where the images are, in parts that do not overlap.
    std::vector<PixelRect> parts_of(const std::vector<BallInView>& images) const;
    void clear_layer(const PixelRect& part);
    void blend(const Mirror& mirror, const PixelRect& part, const BackgroundPicture& background,
               const GlFramebuffer& frame, const GlTexture& color);

    const Gl* gl_;
    const Scene* scene_;
    View view_;
    Lights lights_;
    PictureScale scale_;
    std::vector<Mirror> mirrors_;
    BallBillboards balls_;
    GlTexture layer_;
    GlFramebuffer layer_framebuffer_;
    MirrorPart read_;
};

}  // namespace carom
