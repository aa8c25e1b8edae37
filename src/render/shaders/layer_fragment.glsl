// A layer of encoded, premultiplied colours, made linear for blending.

uniform sampler2D u_layer;

out vec4 out_color;

void main() {
    vec4 layer = texelFetch(u_layer, ivec2(gl_FragCoord.xy), 0);
    vec3 c = layer.rgb / max(layer.a, 1.0 / 255.0);
    // IEC 61966-2-1
    vec3 linear = mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThan(c, vec3(0.04045)));
    out_color = vec4(linear * layer.a, layer.a);
}
