// One triangle over the whole texture.
uniform vec3 u_color;
uniform vec3 u_second;
flat out vec3 v_color;
flat out vec3 v_second;

void main() {
    v_color = u_color;
    v_second = u_second;
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
