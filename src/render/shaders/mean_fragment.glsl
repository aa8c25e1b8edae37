// A picture, or a sum of pictures, times a weight; textures of sRGB come in linear.

uniform sampler2D u_picture;
uniform float u_weight;

out vec4 out_color;

void main() { out_color = u_weight * texelFetch(u_picture, ivec2(gl_FragCoord.xy), 0); }
