#include "render/balls/ball_shadows.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/check.h"
#include "render/background/common_uniforms.h"

namespace carom {

namespace {

GlProgram make_program(const Gl& gl, const View& view, const Lights& lights, bool one_caster,
                       bool swept) {
    GlProgram::Sources sources;
    sources.name = "ball shadows";
    std::vector<std::string> tile = {fmt::format("TILE_PX {}.0", ShadowTiles::kTilePx)};
    std::vector<std::string> pixel = view_defines(view);
    sources.attributes = {"a_tile"};
    if (one_caster) {
        tile.emplace_back("ONE_CASTER");
        pixel.emplace_back("ONE_CASTER");
        sources.attributes.emplace_back("a_caster");
        sources.attributes.emplace_back("a_sweep");
    }
    if (swept) {
        tile.emplace_back("SWEPT");
        pixel.emplace_back("SWEPT");
    }
    sources.vertex = assemble_shader(tile, {"tile_vertex"});
    sources.fragment = assemble_shader(pixel, {"ball_shadow_fragment"});
    sources.outputs = {"out_factor"};
    GlProgram program(gl, sources);
    set_common_uniforms(program, view, lights);
    program.set("u_size", Vec2(view.width_px(), view.height_px()));
    program.set("u_g_buffer", 0);
    program.set("u_casters", 2);
    return program;
}

/// Tiles that one ball alone casts a shadow into, as a rectangle: what is drawn at once costs less.
struct LoneTiles {
    int column, row, columns, rows;
    const float* caster;  ///< as ShadowTiles has it
    int floats;           ///< of it
    bool same_caster(const float* other) const {
        return std::equal(caster, caster + floats, other);
    }
};

/// Joins runs of a row, in order, with equal ones of the rows above.
void join_rows(std::vector<LoneTiles>& runs) {
    constexpr std::ptrdiff_t kNear = 100;  // of a crowd, what lies above is not far back
    std::vector<LoneTiles> joined;
    for (const LoneTiles& run : runs) {
        const auto end = joined.rbegin() + std::min(kNear, std::ssize(joined));
        const auto above = std::find_if(joined.rbegin(), end, [&](const LoneTiles& other) {
            return other.row + other.rows == run.row && other.column == run.column &&
                   other.columns == run.columns && run.same_caster(other.caster);
        });
        if (above != end)
            ++above->rows;
        else
            joined.push_back(run);
    }
    runs = std::move(joined);
}

constexpr std::size_t kTileFloats = 12;  ///< a tile, and its first caster with its way

void append(const float* tile, const float* caster, int floats, std::vector<float>& list) {
    list.insert(list.end(), tile, tile + 4);
    list.insert(list.end(), caster, caster + floats);
    list.resize((list.size() + kTileFloats - 1) / kTileFloats * kTileFloats);
}

}  // namespace

BallShadows::BallShadows(const Gl& gl, const Scene& scene, const View& view, const Lights& lights,
                         BallPrograms programs, std::vector<TileBound> seen)
    : gl_(&gl),
      one_program_(programs == BallPrograms::kOneForAll),
      tiles_(scene, view, lights, std::move(seen)),
      view_(view),
      lights_(lights),
      vertex_array_(gl),
      tile_buffer_(gl),
      caster_array_(gl) {
    program_of(false, false);
    gl.BindVertexArray(vertex_array_.name());
    for (const GLuint attribute : {0, 1, 2}) {
        gl.EnableVertexAttribArray(attribute);
        gl.VertexAttribDivisor(attribute, 1);
    }
    gl.check("preparing the shadows");
}

void BallShadows::set_view(const Scene& scene, const View& view, const Lights& lights,
                           std::vector<TileBound> seen) {
    tiles_ = ShadowTiles(scene, view, lights, std::move(seen));
    view_ = view;
    lights_ = lights;
    for (auto& [kind, program] : programs_) set_common_uniforms(program, view, lights);
}

GlProgram& BallShadows::program_of(bool one_caster, bool swept) {
    const auto found = programs_.find({one_caster, swept});
    if (found != programs_.end()) return found->second;
    return programs_
        .emplace(std::pair(one_caster, swept),
                 make_program(*gl_, view_, lights_, one_caster, swept))
        .first->second;
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
    draw_sorted(&mask, background);
}

void BallShadows::draw(const std::vector<BallInView>& balls, const BackgroundPicture& background) {
    tiles_.update(balls);
    draw_sorted(nullptr, background);
}

void BallShadows::draw_sorted(const TileMask* mask, const BackgroundPicture& background) {
    several_.clear();
    std::vector<LoneTiles> lone;
    const std::vector<float>& tiles = tiles_.tiles();
    const std::vector<float>& casters = tiles_.casters();
    const bool swept = tiles_.swept();
    const int floats = swept ? 8 : 4;
    for (std::size_t i = 0; i < tiles.size(); i += 4) {
        const float* tile = &tiles[i];
        if (mask != nullptr &&
            !mask->has_tile(static_cast<int>(tile[0]), static_cast<int>(tile[1])))
            continue;
        const float* caster =
            &casters[static_cast<std::size_t>(floats) * static_cast<std::size_t>(tile[2])];
        if (tile[3] != 1 || one_program_) {
            append(tile, caster, floats, several_);
            continue;
        }
        const int column = static_cast<int>(tile[0]), row = static_cast<int>(tile[1]);
        if (!lone.empty() && lone.back().row == row &&
            lone.back().column + lone.back().columns == column && lone.back().same_caster(caster))
            ++lone.back().columns;
        else
            lone.push_back({column, row, 1, 1, caster, floats});
    }
    join_rows(lone);
    lone_.clear();
    for (const LoneTiles& run : lone) {
        const float rectangle[] = {static_cast<float>(run.column), static_cast<float>(run.row),
                                   static_cast<float>(run.columns), static_cast<float>(run.rows)};
        append(rectangle, run.caster, floats, lone_);
    }
    if (!several_.empty()) draw_tiles(program_of(false, swept), several_, casters, background);
    if (!lone_.empty()) draw_tiles(program_of(true, swept), lone_, casters, background);
}

void BallShadows::compile(const BackgroundPicture& background) {
    draw_tiles(program_of(false, false), {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0}, {0, 0, 0, 1},
               background);
}

void BallShadows::draw_tiles(GlProgram& program, const std::vector<float>& tiles,
                             const std::vector<float>& casters,
                             const BackgroundPicture& background) {
    program.use();
    caster_array_.upload(casters);
    caster_array_.bind(2);
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, background.g_buffer().name());
    gl_->BindVertexArray(vertex_array_.name());
    gl_->BindBuffer(GL_ARRAY_BUFFER, tile_buffer_.name());
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tiles.size() * sizeof(float)),
                    tiles.data(), GL_STREAM_DRAW);
    for (const GLuint attribute : {0, 1, 2})
        gl_->VertexAttribPointer(
            attribute, 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(kTileFloats * sizeof(float)),
            reinterpret_cast<const void*>(std::size_t{attribute} * 4 * sizeof(float)));
    // Linear colour times the factor f. What is left of the light that shines through, 1 - alpha,
    // is lessened by f as well: alpha becomes (1 - f) + f alpha.
    gl_->Enable(GL_BLEND);
    gl_->BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4,
                             static_cast<GLsizei>(tiles.size() / kTileFloats));
}

}  // namespace carom
