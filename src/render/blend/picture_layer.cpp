#include "render/blend/picture_layer.h"

#include "core/check.h"
#include "render/blend/linear_layer.h"

namespace carom {

void lay_over(const Gl& gl, const Image& layer, const PixelRect& part, const GlFramebuffer& target,
              const GlTexture& color) {
    if (part.empty()) return;
    CAROM_CHECK(part.right, <=, layer.width_px);
    CAROM_CHECK(part.bottom, <=, layer.height_px);
    Image below(part.width(), part.height());
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, target.name());
    gl.ReadPixels(part.left, part.top, below.width_px, below.height_px, GL_BGRA, GL_UNSIGNED_BYTE,
                  below.bgra.data());
    lay_over_in_linear_light(layer, part.left, part.top, below);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, color.name());
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, part.left, part.top, below.width_px, below.height_px,
                     GL_BGRA, GL_UNSIGNED_BYTE, below.bgra.data());
    gl.check("laying a layer over a picture");
}

}  // namespace carom
