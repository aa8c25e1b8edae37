// The balls: spheres ray-cast on billboards, drawn from far to near, with analytic edges.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "render/background/background_picture.h"
#include "render/balls/ball_programs.h"
#include "render/balls/balls_in_view.h"
#include "render/balls/surface_shade.h"
#include "render/gl/gl_program.h"
#include "render/view/lights.h"

namespace carom {

/// How the balls of a second run look: translucent, within an outline.
struct GhostLook {
    Vec3 color = Vec3::Zero();  ///< of the outline, linear
    double outline_px = 2;
};

/// What the balls of a picture have to do with what is around them.
struct BallSurroundings {
    bool occluded = false;  ///< static bodies may stand before balls
    bool mirrored = false;  ///< there are images of the balls in mirrors
    BallPrograms programs = BallPrograms::kEachStyle;
};

/// Compiles programs for the styles of ball that the scene has, and for no other.
class BallBillboards {
  public:
    enum class Kind { kBalls, kImages };
    /// `gl` and `scene` must outlive it. Of images, set_mirror() says in which mirror. Balls and
    /// their images have the same programs, if these are to compile soon.
    BallBillboards(const Gl& gl, const Scene& scene, const View& view, const Lights& lights,
                   const BallSurroundings& around,
                   const std::optional<GhostLook>& ghost = std::nullopt, Kind kind = Kind::kBalls);

    /// Another view of the same size and kind.
    void set_view(const View& view, const Lights& lights);

    /// What is drawn from now on are mirror images behind the plane normal . p = offset of view
    /// space (their centres are already there): they get the light of the balls before it.
    void set_mirror(const Vec3& normal, double offset, const Lights& lights);

    /// Draws the balls into the framebuffer that is bound, sorted as balls_at() gives them.
    void draw(const std::vector<BallInView>& balls, const BackgroundPicture& background);

    /// The same for ghosts, after `solid` balls were drawn: of each ghost, what lies before them.
    void draw_ghosts(const std::vector<BallInView>& ghosts, const std::vector<BallInView>& solid,
                     const BackgroundPicture& background);

    /// Uses all programs, for drivers that compile at the first use; the viewport is without
    /// extent.
    void compile(const BackgroundPicture& background);

  private:
    struct Casters {
        std::vector<float> vec4s;       ///< centre and radius, relative to the shaded ball
        std::vector<int> first, count;  ///< per ball
    };
    Casters find_casters(const std::vector<BallInView>& balls) const;
    Casters find_hiders(const std::vector<BallInView>& ghosts,
                        const std::vector<BallInView>& solid) const;
    void draw_instances(const std::vector<BallInView>& balls, const Casters& casters,
                        const BackgroundPicture& background);
    /// One for the balls of a style that other balls may take light from or not, swept or not.
    struct ProgramKey {
        LookStyle style;
        bool casters, swept;
        bool operator<(const ProgramKey& other) const {
            return std::tie(style, casters, swept) <
                   std::tie(other.style, other.casters, other.swept);
        }
    };
    GlProgram& make_program(const ProgramKey& key);
    void set_mirror_uniforms(GlProgram& program) const;
    /// `programs`: of each instance, in the order in which they are drawn.
    void draw_runs(const std::vector<GlProgram*>& programs, const std::vector<float>& casters,
                   const BackgroundPicture& background);
    struct Bound {
        bool around_ellipse;        ///< otherwise the whole picture
        Vec2 middle, major, minor;  ///< of the ellipse, with its soft edge
        Vec2 half_way;              ///< of its two halves, away from the middle
    };
    Bound bound_around(const BallInView& ball) const;
    void append_instance(const BallInView& ball, const BallShade& shade, int first_caster,
                         int casters);
    BallShade shade_on(const BallInView& ball) const;
    LookStyle style_of(const BallInView& ball) const;
    GlProgram& program_of(ProgramKey key);

    const Gl* gl_;
    const Scene* scene_;
    View view_;
    SurfaceShade surface_shade_;
    Lights lights_;
    Vec3 to_light_;  ///< view space
    struct MirrorPlane {
        Vec3 normal;
        double offset;
        Vec3 flipped(const Vec3& v) const { return v - 2 * normal.dot(v) * normal; }
    };
    std::optional<MirrorPlane> mirror_;
    double light_tan_;
    bool with_static_, with_mirrors_;  ///< what its programs look at
    bool images_;
    std::optional<GhostLook> ghost_;
    bool for_all_;  ///< one program draws all
    std::map<ProgramKey, GlProgram> programs_;
    GlVertexArray vertex_array_;
    GlBuffer instance_buffer_;
    GlVec4Array caster_array_;
    std::vector<float> instances_;
};

}  // namespace carom
