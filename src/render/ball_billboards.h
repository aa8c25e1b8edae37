// The balls: spheres ray-cast on billboards, drawn from far to near, with analytic edges.
#pragma once

#include <map>
#include <vector>

#include "render/balls_in_view.h"
#include "render/body_shade.h"
#include "render/gl.h"
#include "render/lights.h"
#include "render/static_picture.h"

namespace carom {

/// Compiles one program per style of ball that the scene has, and no other.
class BallBillboards {
  public:
    /// `gl` and `scene` must outlive it. `occluded`: static bodies may stand before balls.
    BallBillboards(const Gl& gl, const Scene& scene, const View& view, const Lights& lights,
                   bool occluded);

    /// Another view of the same size and kind.
    void set_view(const View& view, const Lights& lights);

    /// Draws the balls into the framebuffer that is bound, sorted as balls_at() gives them.
    void draw(const std::vector<BallInView>& balls, const StaticPicture& background);

  private:
    struct Casters {
        std::vector<float> vec4s;       ///< centre and radius, relative to the shaded ball
        std::vector<int> first, count;  ///< per ball
    };
    Casters find_casters(const std::vector<BallInView>& balls) const;
    void append_instance(const BallInView& ball, const BallShade& shade, int first_caster,
                         int casters);
    LookStyle style_of(const BallInView& ball) const;

    const Gl* gl_;
    const Scene* scene_;
    View view_;
    BodyShade body_shade_;
    Vec3 to_light_;  ///< view space
    double light_tan_;
    bool occluded_;
    std::map<LookStyle, GlProgram> programs_;
    GlVertexArray vertex_array_;
    GlBuffer instance_buffer_;
    GlVec4Array caster_array_;
    std::vector<float> instances_;
};

}  // namespace carom
