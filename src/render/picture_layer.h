// A picture drawn by cairo, laid over what is in the framebuffer: the ruler, the trails.
#pragma once

#include <vector>

#include "core/image.h"
#include "render/gl_program.h"

namespace carom {

/// Keeps a copy of the layer on the GL side and knows which of its tiles hold anything; nothing is
/// uploaded or blended where the layer is empty or unchanged.
class PictureLayer {
  public:
    /// Of the framebuffer's size. `gl` must outlive it.
    PictureLayer(const Gl& gl, int width_px, int height_px);

    /// Takes over a rectangle of `layer` [px], which has the layer's size; clipped to it.
    void update(const Image& layer, int x, int y, int width, int height);

    /// Blends the layer in linear light into the framebuffer that is bound.
    void draw();

    /// Has the program compiled: draws a tile, for a viewport without extent.
    void compile();

  private:
    void draw_tiles(int count);

    static constexpr int kTilePx = 32;
    bool tile_is_empty(const Image& layer, int column, int row) const;

    const Gl* gl_;
    int width_px_, height_px_, columns_, rows_;
    std::vector<bool> filled_;  ///< per tile
    bool tiles_changed_ = false;
    int filled_count_ = 0;
    GlTexture texture_;
    GlProgram program_;
    GlVertexArray vertex_array_;
    GlBuffer tile_buffer_;
};

/// The same for a layer that is laid over one picture, by the processor: compiling a program would
/// take ten times as long. `target` draws into `color` alone.
void lay_over_once(const Gl& gl, const Image& layer, const GlFramebuffer& target,
                   const GlTexture& color);

}  // namespace carom
