// A square tile of the picture, or with ONE_CASTER a rectangle of such; the vertex array has one
// instance per tile or rectangle.

uniform vec2 u_size;  // pixels

in vec4 a_tile;  // column, row, first entry, number of entries; or columns and rows of a rectangle

flat out ivec2 v_list;
#ifdef ONE_CASTER
in vec4 a_caster;  // centre, radius
flat out vec4 v_caster;
#ifdef SWEPT
in vec4 a_sweep;
flat out vec3 v_sweep;
#endif
#endif

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
#ifdef ONE_CASTER
    v_list = ivec2(0, 1);
    v_caster = a_caster;
#ifdef SWEPT
    v_sweep = a_sweep.xyz;
#endif
    corner *= a_tile.zw;
#else
    v_list = ivec2(a_tile.zw);
#endif
    gl_Position = vec4(2.0 * (a_tile.xy + corner) * TILE_PX / u_size - 1.0, 0.0, 1.0);
}
