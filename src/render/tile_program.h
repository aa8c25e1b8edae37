// Programs that draw square tiles of the picture, one instance a tile.
#pragma once

#include "render/gl_program.h"

namespace carom {

struct TileProgram {
    const char* name = "";      ///< for messages
    const char* fragment = "";  ///< of src/render/shaders; its output is out_color
    const char* texture = "";   ///< its sampler, which reads unit 0
    int width_px = 0, height_px = 0, tile_px = 0;
};

/// Compiles it, and has `vertex_array` read four floats a tile from `tiles`: column, row and two of
/// the shader's own.
GlProgram make_tile_program(const Gl& gl, const TileProgram& wanted,
                            const GlVertexArray& vertex_array, const GlBuffer& tiles);

}  // namespace carom
