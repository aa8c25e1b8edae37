// The mean of several pictures in linear light, tile by tile: motion blur.
#pragma once

#include <vector>

#include "render/gl_program.h"

namespace carom {

/// Tiles of the picture in which something moves.
class TileMask {
  public:
    TileMask(int width_px, int height_px, int tile_px);

    void add_all();
    /// Everything that a rectangle touches; may reach beyond the picture.
    void add(double left_px, double top_px, double right_px, double bottom_px);
    void add_tile(int column, int row);

    bool empty() const { return count_ == 0; }
    /// The picture's part that holds all tiles, pixels, half open.
    struct Bounds {
        int left = 0, top = 0, right = 0, bottom = 0;
    };
    Bounds bounds() const;
    /// Per tile: column, row, 0, 0.
    std::vector<float> tiles() const;

  private:
    int width_px_, height_px_, tile_px_, columns_, rows_;
    int count_ = 0;
    std::vector<bool> set_;
};

/// Sums pictures of the GPU in 32-bit floats, so that hundreds of them leave no steps.
class PictureMean {
  public:
    static constexpr int kTilePx = 16;

    /// `gl` must outlive it.
    PictureMean(const Gl& gl, int width_px, int height_px);

    /// Has the driver compile, in a viewport without extent, for such a picture and target.
    void compile(const GlTexture& picture, const GlFramebuffer& target);
    /// Begins a mean of `count` pictures in the tiles of `mask`.
    void begin(const TileMask& mask, int count);
    /// Adds a picture; its texture must not be bound for drawing when this is called.
    void add(const GlTexture& picture);
    /// Writes the mean into the framebuffer that is bound, in the tiles of the mask.
    void write(const GlFramebuffer& target);

  private:
    void draw_tiles(const GlTexture& from, double weight, bool added);

    const Gl* gl_;
    int width_px_, height_px_;
    int count_ = 1, added_ = 0;
    GLsizei tiles_ = 0;
    GlTexture sum_;
    GlFramebuffer framebuffer_;
    GlProgram program_;
    GlVertexArray vertex_array_;
    GlBuffer tile_buffer_;
};

}  // namespace carom
