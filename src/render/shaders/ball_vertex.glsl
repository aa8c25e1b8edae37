// The quadrangle around a ball, and what its pixels need to know.

uniform vec2 u_size;  // pixels

in vec4 a_bound;    // middle of the bound [px]; first caster, number of casters
in vec4 a_axes;     // semi-axes of the bound [px]
in vec4 a_ray;      // pixel of the reference ray; its depth at the centre / radius; radius [m]
in vec4 a_offset;   // centre - reference point, in radii
in vec4 a_row_x;    // rows of ball-from-view; w: part of the key light that reaches the ball
in vec4 a_row_y;
in vec4 a_row_z;
in vec4 a_color;    // w: number of the style
in vec4 a_second;
in vec4 a_contact;  // towards the nearest surface, and how close it is

#ifdef SWEPT
in vec4 a_sweep;    // way of the centre, radii; w: half of the way in the picture along x [px]
in vec4 a_turn;     // axis times angle; w: along y
flat out vec3 v_sweep;
flat out vec3 v_turn;
#endif

flat out vec4 v_ray;
flat out vec3 v_offset;
flat out vec4 v_row_x;
flat out vec3 v_row_y;
flat out vec3 v_row_z;
flat out vec3 v_color;
flat out vec3 v_second;
flat out vec4 v_contact;
flat out ivec2 v_casters;
#ifdef SEVERAL_STYLES
flat out float v_style;
#endif

void main() {
    v_ray = a_ray;
    v_offset = a_offset.xyz;
    v_row_x = a_row_x;
    v_row_y = a_row_y.xyz;
    v_row_z = a_row_z.xyz;
    v_color = a_color.rgb;
    v_second = a_second.rgb;
    v_contact = a_contact;
    v_casters = ivec2(a_bound.zw);
#ifdef SEVERAL_STYLES
    v_style = a_color.w;
#endif
    // Around the unit circle, one corner after another.
    int corner = gl_VertexID & 3;
    float x = corner == 1 || corner == 2 ? -1.0 : 1.0, y = corner >= 2 ? -1.0 : 1.0;
    vec2 pixel = a_bound.xy + a_axes.xy * x + a_axes.zw * y;
#ifdef SWEPT
    v_sweep = a_sweep.xyz;
    v_turn = a_turn.xyz;
    pixel += (x < 0.0 ? -1.0 : 1.0) * vec2(a_sweep.w, a_turn.w);
#endif
    gl_Position = vec4(2.0 * pixel / u_size - 1.0, 0.0, 1.0);
}
