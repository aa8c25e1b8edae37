// Pictures drawn by cairo, laid over what a framebuffer holds: the ruler, the trails.
#pragma once

#include "core/image.h"
#include "core/pixel_rect.h"
#include "render/gl/gl.h"

namespace carom {

/// Lays `part` of a layer of the framebuffer's size over it in linear light, by the processor: most
/// of a layer is empty, and a program for the rest takes longer to compile than a film's layers to
/// lay. `target` draws into `color` alone.
void lay_over(const Gl& gl, const Image& layer, const PixelRect& part, const GlFramebuffer& target,
              const GlTexture& color);

}  // namespace carom
