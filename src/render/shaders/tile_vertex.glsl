// A square tile of the picture; the vertex array has one instance per tile.

uniform vec2 u_size;  // pixels

in vec4 a_tile;  // column, row, first entry, number of entries

flat out ivec2 v_list;
#ifdef ONE_CASTER
in vec4 a_caster;  // centre, radius
flat out vec4 v_caster;
#endif

void main() {
    v_list = ivec2(a_tile.zw);
#ifdef ONE_CASTER
    v_caster = a_caster;
#endif
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(2.0 * (a_tile.xy + corner) * TILE_PX / u_size - 1.0, 0.0, 1.0);
}
