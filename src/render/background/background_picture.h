// What does not move: drawn once per camera, copied below every frame.
#pragma once

#include <optional>
#include <vector>

#include "core/image.h"
#include "core/types.h"
#include "render/gl/gl.h"
#include "render/view/camera.h"

namespace carom {

/// A sphere around all that is seen of the static surfaces in one tile of the picture, view space.
struct TileBound {
    Vec3 center = Vec3::Zero();
    double radius = -1;  ///< negative: nothing but sky
};

/// What a background needs to have, by the scene and its looks.
struct BackgroundKind {
    bool occludes = false;  ///< balls can pass behind something
    bool mirrors = false;   ///< a look has a reflection
    bool transparent = false;
};

/// The background and, per pixel, what the passes of a frame need to know about it.
class BackgroundPicture {
  public:
    /// `gl` must outlive it. Nothing is in it until a BackgroundDrawing has drawn it. Its colours
    /// are drawn into `color`, which must outlive it, or, without, into a texture of its own.
    BackgroundPicture(const Gl& gl, int width_px, int height_px, const BackgroundKind& kind,
                      const GlTexture* color = nullptr);

    const BackgroundKind& kind() const { return kind_; }

    /// What a drawing of it fills.
    std::vector<const GlTexture*> targets() const;
    /// The same of a drawing where no edge is.
    std::vector<const GlTexture*> targets_without_edges() const;

    /// Lays a picture of the same size over the colours, in linear light: layers that do not move.
    void lay_over(const Image& layer);

    /// A framebuffer with the colours alone: the source of each frame's copy.
    const GlFramebuffer& color_framebuffer() const { return color_framebuffer_; }

    /// RGBA32UI: bits of the depth of the nearer and of the farther layer; 10 bits each of the
    /// parts of the colour that are key light and ambient light, and of the nearer layer's share of
    /// the pixel; normal, octahedral, 2 x 16 bits. Row 0 is the picture's top.
    const GlTexture& g_buffer() const { return g_buffer_; }
    /// Colour of the nearer layer alone; only where balls can pass behind it.
    const GlTexture& front() const { return *front_; }

    /// RGBA32F, only where a look has a reflection: the linear light that the surface mirrors of
    /// sky and bodies; how far these are from it, in lengths of the pixel's ray of depth 1.
    const GlTexture& mirror() const { return *mirror_; }

    /// For reading them back.
    const GlFramebuffer& g_buffer_framebuffer() const { return g_buffer_framebuffer_; }
    const GlFramebuffer& mirror_framebuffer() const { return mirror_framebuffer_; }

    /// Bounds of square tiles, row by row from the top left; reads the G-buffer back.
    std::vector<TileBound> tile_bounds(const View& view, int tile_px) const;

  private:
    const GlTexture& color() const { return given_color_ != nullptr ? *given_color_ : own_color_; }

    const Gl* gl_;
    BackgroundKind kind_;
    GlTexture own_color_, g_buffer_;
    const GlTexture* given_color_;
    std::optional<GlTexture> front_, mirror_;
    GlFramebuffer color_framebuffer_, g_buffer_framebuffer_, mirror_framebuffer_;
};

}  // namespace carom
