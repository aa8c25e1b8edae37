#include "render/tile_program.h"

#include <fmt/core.h>

namespace carom {

GlProgram make_tile_program(const Gl& gl, const TileProgram& wanted,
                            const GlVertexArray& vertex_array, const GlBuffer& tiles) {
    GlProgram::Sources sources;
    sources.name = wanted.name;
    sources.vertex =
        assemble_shader({fmt::format("TILE_PX {}.0", wanted.tile_px)}, {"tile_vertex"});
    sources.fragment = assemble_shader({}, {wanted.fragment});
    sources.attributes = {"a_tile"};
    sources.outputs = {"out_color"};
    GlProgram program(gl, sources);
    program.set("u_size", Vec2(wanted.width_px, wanted.height_px));
    program.set(wanted.texture, 0);
    gl.BindVertexArray(vertex_array.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, tiles.name());
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribDivisor(0, 1);
    gl.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
    return program;
}

}  // namespace carom
