// A rectangle of the background with its lists of bodies; one instance each.

uniform vec2 u_size;  // pixels

in vec4 a_rectangle;  // left, top, right, bottom
in vec4 a_seen;
in vec4 a_shading;
#ifdef MANY_PLANES
in vec4 a_planes;
#endif

flat out ivec4 v_seen;
flat out ivec4 v_shading;
#ifdef MANY_PLANES
flat out ivec4 v_planes;
#endif

void main() {
    v_seen = ivec4(a_seen);
    v_shading = ivec4(a_shading);
#ifdef MANY_PLANES
    v_planes = ivec4(a_planes);
#endif
    vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
    gl_Position = vec4(2.0 * mix(a_rectangle.xy, a_rectangle.zw, corner) / u_size - 1.0, 0.0, 1.0);
}
