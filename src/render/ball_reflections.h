// The balls' mirror images in polished surfaces: looks with `reflection` on planes and boxes' tops.
#pragma once

#include <vector>

#include "render/ball_billboards.h"
#include "render/gl_program.h"
#include "render/picture_scale.h"
#include "render/static_picture.h"

namespace carom {

/// A flat part of a surface that mirrors; view space, metres.
struct Mirror {
    Vec3 normal = Vec3::UnitZ();  ///< unit
    double offset = 0;            ///< points p with normal . p = offset
    double strength = 0;          ///< Look::reflection
    /// Of a box's top: its middle, and its axes over their half lengths, so that inside
    /// |axis . (p - middle)| <= 1 holds for both. 0 on a plane.
    Vec3 middle = Vec3::Zero(), axis_a = Vec3::Zero(), axis_b = Vec3::Zero();
    bool fades = false;  ///< a plane, which melts into the horizon
};

/// The mirrors of a scene that this view sees from their front.
std::vector<Mirror> find_mirrors(const Scene& scene, const View& view);

/// The balls behind the mirror, in the order in which they must be drawn.
std::vector<BallInView> mirror_images(const std::vector<BallInView>& balls, const Mirror& mirror,
                                      const View& view);

/// Exact: a mirror image of a sphere is a sphere, under mirrored light. Each mirror's images are
/// drawn into a layer of their own, where no mirrored body hides them; what they hide of the
/// mirrored sky and bodies (StaticPicture::mirror) is taken away, and they are added.
/// A ball's shadow is not seen in a mirrored body.
class BallReflections {
  public:
    /// `gl` and `scene` must outlive it.
    BallReflections(const Gl& gl, const Scene& scene, const View& view, const Lights& lights,
                    const PictureScale& scale, const BallSurroundings& around);

    /// Another view of the same size and kind.
    void set_view(const View& view, const Lights& lights, const PictureScale& scale);

    /// Onto `frame`, over the static picture and the shadows.
    void draw(const std::vector<BallInView>& balls, const StaticPicture& background,
              const GlFramebuffer& frame);

    /// Has its programs compiled, without drawing anything: into a viewport without extent, which
    /// is the whole picture then.
    void compile(const StaticPicture& background, const GlFramebuffer& frame);
    void compile_blending(const StaticPicture& background, const GlFramebuffer& frame);

    /// All images that draw() would show.
    std::vector<BallInView> images(const std::vector<BallInView>& balls) const;

  private:
    struct Part {
        int left, top, right, bottom;  ///< px, half open
    };
    /// Where the images are, in parts that do not overlap.
    std::vector<Part> parts_of(const std::vector<BallInView>& images) const;
    void blend_layer(const Mirror& mirror, const std::vector<Part>& parts,
                     const StaticPicture& background);

    const Gl* gl_;
    const Scene* scene_;
    View view_;
    Lights lights_;
    PictureScale scale_;
    std::vector<Mirror> mirrors_;
    BallBillboards balls_;
    GlTexture layer_;
    GlFramebuffer layer_framebuffer_;
    GlProgram program_;
    GlVertexArray nothing_;
};

/// True where a look asks for a reflection on a plane or a box.
bool wants_reflection(const Scene& scene);

}  // namespace carom
