#include "render/balls/ball_shadows.h"

#include <fmt/core.h>

#include <utility>

#include "core/check.h"
#include "render/background/common_uniforms.h"

namespace carom {

namespace {

GlProgram make_program(const Gl& gl, const View& view) {
    GlProgram::Sources sources;
    sources.name = "ball shadows";
    sources.vertex =
        assemble_shader({fmt::format("TILE_PX {}.0", ShadowTiles::kTilePx)}, {"tile_vertex"});
    sources.fragment = assemble_shader(view_defines(view), {"ball_shadow_fragment"});
    sources.attributes = {"a_tile"};
    sources.outputs = {"out_factor"};
    return GlProgram(gl, sources);
}

}  // namespace

BallShadows::BallShadows(const Gl& gl, const Scene& scene, const View& view, const Lights& lights,
                         std::vector<TileBound> seen)
    : gl_(&gl),
      tiles_(scene, view, lights, std::move(seen)),
      program_(make_program(gl, view)),
      vertex_array_(gl),
      tile_buffer_(gl),
      caster_array_(gl) {
    set_common_uniforms(program_, view, lights);
    program_.set("u_size", Vec2(view.width_px(), view.height_px()));
    program_.set("u_g_buffer", 0);
    program_.set("u_casters", 2);
    gl.BindVertexArray(vertex_array_.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, tile_buffer_.name());
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribDivisor(0, 1);
    gl.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl.check("preparing the shadows");
}

void BallShadows::set_view(const Scene& scene, const View& view, const Lights& lights,
                           std::vector<TileBound> seen) {
    tiles_ = ShadowTiles(scene, view, lights, std::move(seen));
    set_common_uniforms(program_, view, lights);
}

void BallShadows::mark(const std::vector<BallInView>& balls, TileOwners& owners) {
    CAROM_CHECK(owners.tile_px(), ==, ShadowTiles::kTilePx);
    tiles_.update(balls);
    const std::vector<float>& tiles = tiles_.tiles();
    for (std::size_t i = 0; i < tiles.size(); i += 4)
        for (int k = 0; k < static_cast<int>(tiles[i + 3]); ++k)
            owners.add_tile(static_cast<std::size_t>(tiles_.caster_balls()[static_cast<std::size_t>(
                                static_cast<int>(tiles[i + 2]) + k)]),
                            static_cast<int>(tiles[i]), static_cast<int>(tiles[i + 1]));
}

const ShadowTiles& BallShadows::cast(const std::vector<BallInView>& balls) {
    tiles_.update(balls);
    return tiles_;
}

void BallShadows::draw_within(const TileMask& mask, const BackgroundPicture& background) {
    within_.clear();
    const std::vector<float>& tiles = tiles_.tiles();
    for (std::size_t i = 0; i < tiles.size(); i += 4)
        if (mask.has_tile(static_cast<int>(tiles[i]), static_cast<int>(tiles[i + 1])))
            within_.insert(within_.end(), &tiles[i], &tiles[i] + 4);
    if (!within_.empty()) draw_tiles(within_, tiles_.casters(), background);
}

void BallShadows::draw(const std::vector<BallInView>& balls, const BackgroundPicture& background) {
    tiles_.update(balls);
    if (!tiles_.tiles().empty()) draw_tiles(tiles_.tiles(), tiles_.casters(), background);
}

void BallShadows::compile(const BackgroundPicture& background) {
    draw_tiles({0, 0, 0, 1}, {0, 0, 0, 1}, background);
}

void BallShadows::draw_tiles(const std::vector<float>& tiles, const std::vector<float>& casters,
                             const BackgroundPicture& background) {
    program_.use();
    caster_array_.upload(casters);
    caster_array_.bind(2);
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, background.g_buffer().name());
    gl_->BindVertexArray(vertex_array_.name());
    gl_->BindBuffer(GL_ARRAY_BUFFER, tile_buffer_.name());
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tiles.size() * sizeof(float)),
                    tiles.data(), GL_STREAM_DRAW);
    // Linear colour times the factor f. What is left of the light that shines through, 1 - alpha,
    // is lessened by f as well: alpha becomes (1 - f) + f alpha.
    gl_->Enable(GL_BLEND);
    gl_->BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(tiles.size() / 4));
}

}  // namespace carom
