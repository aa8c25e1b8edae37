// What the balls take from the light of a static pixel, as a factor of its colour.

// In the order in which ball_fragment.glsl has them: llvmpipe counts what the program before has
// bound in a buffer's place as part of a shader, and would compile again.
uniform samplerBuffer u_casters;
uniform usampler2D u_g_buffer;  // background_picture.h

flat in ivec2 v_list;  // first caster, number of casters
#ifdef ONE_CASTER
flat in vec4 v_caster;  // most tiles have no other, and need not look for it at each pixel
#ifdef SWEPT
flat in vec3 v_sweep;
#endif
#endif

out vec4 out_factor;

const float kAmbientReach2 = 9.0;  // squared, in radii (shadow_tiles.cpp)

vec3 unpacked_normal(uint bits) {
    vec2 p = vec2(bits & 0xffffu, bits >> 16) * (2.0 / 65535.0) - 1.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float under = max(-n.z, 0.0);
    n.x += n.x < 0.0 ? under : -under;
    n.y += n.y < 0.0 ? under : -under;
    return normalize(n);
}

void main() {
    uvec4 g_buffer = texelFetch(u_g_buffer, ivec2(gl_FragCoord.xy), 0);
    vec3 d = ray_through(gl_FragCoord.xy), start = ray_start(gl_FragCoord.xy);
    vec3 n = unpacked_normal(g_buffer.w);
    float direct = float(g_buffer.z & 1023u) / 1023.0;
    float ambient = float((g_buffer.z >> 10) & 1023u) / 1023.0;
    float front_part = float(g_buffer.z >> 20) / 1023.0;

    // Where an edge passes, both layers take their share; elsewhere there is one.
    float factor = 1.0;
    int layers = g_buffer.x == g_buffer.y ? 1 : 2;
    int layer = 0;
    do {  // leaving at the end, as in surfaces.glsl
        float t = uintBitsToFloat(layer == 0 ? g_buffer.x : g_buffer.y);
        float part = layers == 1 ? 1.0 : (layer == 0 ? front_part : 1.0 - front_part);
        if (t > 1e29) continue;  // the sky
        vec3 p = start + t * d;
        float blur = pixel_at(t);
        float key = 1.0, open = 1.0;
        int i = 0;
        do {  // every tile has a caster
#ifdef ONE_CASTER
            vec4 caster = v_caster;
#elif defined(SWEPT)
            vec4 caster = texelFetch(u_casters, 2 * (v_list.x + i));
#else
            vec4 caster = texelFetch(u_casters, v_list.x + i);
#endif
            vec3 rel = caster.xyz - p;
            float along = dot(rel, u_light);
            float away2 = dot(rel, rel);
            float across = sqrt(max(away2 - along * along, 0.0));
#ifdef SWEPT
            // While the shutter is open the edge goes as far as the way leads towards it or away:
            // in the mean it is as much softer, by equal variances of a box and of hidden_by_ball()'s
            // edge of a half-width w, which is w^2 / 5.
#ifdef ONE_CASTER
            vec3 sweep = v_sweep;
#else
            vec3 sweep = texelFetch(u_casters, 2 * (v_list.x + i) + 1).xyz;
#endif
            float edge_way = dot(rel - along * u_light, sweep) / max(across, 1e-6 * caster.w);
            float hidden = hidden_by_ball(along, across, caster.w,
                                          sqrt(blur * blur + 0.41667 * edge_way * edge_way));
#else
            float hidden = hidden_by_ball(along, across, caster.w, blur);
#endif
            key *= along > 0.0 ? 1.0 - hidden : 1.0;
            // The part of the sky, weighted by its cosine, behind a ball: n . d (r / distance)^2.
            float near2 = min(caster.w * caster.w / away2, 1.0);
            float fade = max(1.0 - away2 / (kAmbientReach2 * caster.w * caster.w), 0.0);
            open *= 1.0 - 0.92 * fade * near2 * max(dot(n, rel), 0.0) * inversesqrt(away2);
#ifdef ONE_CASTER
        } while (false);
#else
        } while (++i < v_list.y);
#endif
        // Nothing is shaded in the sky: there both parts are 0.
        factor -= part * (direct * (1.0 - key) + ambient * (1.0 - open));
    } while (++layer < layers);
    out_factor = vec4(vec3(factor), 1.0 - factor);
}
