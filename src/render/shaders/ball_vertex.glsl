// The octagon around a ball, and what its pixels need to know.

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
    // Corners at odd multiples of 22.5 degrees; drivers would compile much for a sine.
    const float kLong = 0.92387953, kShort = 0.38268343;
    int corner = gl_VertexID & 7, of_four = corner & 3;
    bool flat_one = of_four == 0 || of_four == 3;
    float x = flat_one ? kLong : kShort, y = flat_one ? kShort : kLong;
    if (corner >= 2 && corner < 6) x = -x;
    if (corner >= 4) y = -y;
    vec2 pixel = a_bound.xy + a_axes.xy * x + a_axes.zw * y;
    gl_Position = vec4(2.0 * pixel / u_size - 1.0, 0.0, 1.0);
}
