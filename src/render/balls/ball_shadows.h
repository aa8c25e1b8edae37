// The balls' shadows on everything that stands still: key light and ambient light, once per pixel.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "render/background/background_picture.h"
#include "render/balls/ball_programs.h"
#include "render/balls/shadow_tiles.h"
#include "render/gl/gl_program.h"
#include "render/tile/tile_mask.h"
#include "render/tile/tile_owners.h"

namespace carom {

/// Drawn in the tiles that a shadow may reach, each with the balls that cast one there.
class BallShadows {
  public:
    /// `gl` must outlive it. `seen`: see ShadowTiles.
    BallShadows(const Gl& gl, const Scene& scene, const View& view, const Lights& lights,
                BallPrograms programs, std::vector<TileBound> seen = {});

    /// Another view of the same size and kind.
    void set_view(const Scene& scene, const View& view, const Lights& lights,
                  std::vector<TileBound> seen = {});

    /// Darkens the copy of the background in the framebuffer that is bound. All casters of a
    /// pixel are combined before the colour is changed, so that shadows that overlap are not darker
    /// than the light that is left.
    void draw(const std::vector<BallInView>& balls, const BackgroundPicture& background);
    /// The same of the balls of the last cast(), in the tiles of a mask alone.
    void draw_within(const TileMask& mask, const BackgroundPicture& background);
    /// Finds which shadow falls where.
    const ShadowTiles& cast(const std::vector<BallInView>& balls);

    /// Of the last cast().
    const ShadowTiles& tiles() const { return tiles_; }

    /// Uses the program, for drivers that compile at the first use; the viewport is without extent.
    void compile(const BackgroundPicture& background);

    /// Adds the tiles that draw() may change. Ball i of the scene is body i.
    void mark(const std::vector<BallInView>& balls, TileOwners& owners);

  private:
    GlProgram& program_of(bool one_caster, bool swept);
    void draw_sorted(const TileMask* mask, const BackgroundPicture& background);
    /// Of each tile twelve numbers: those of ShadowTiles::tiles(), and its first caster with its
    /// way.
    void draw_tiles(GlProgram& program, const std::vector<float>& tiles,
                    const std::vector<float>& casters, const BackgroundPicture& background);

    const Gl* gl_;
    bool one_program_;
    ShadowTiles tiles_;
    View view_;
    Lights lights_;
    /// By whether one caster is all, and whether it is swept; made when there are such.
    std::map<std::pair<bool, bool>, GlProgram> programs_;
    GlVertexArray vertex_array_;
    GlBuffer tile_buffer_;
    GlVec4Array caster_array_;
    std::vector<float> lone_, several_;
};

}  // namespace carom
