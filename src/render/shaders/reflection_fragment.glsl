// A layer of mirror images laid over the surface that mirrors them (ball_reflections.h).

uniform usampler2D u_facts;  // static_picture.h
uniform sampler2D u_layer;   // premultiplied
uniform sampler2D u_mirror;  // what the surface mirrors without balls
uniform vec3 u_normal;       // of the mirror: normal . p = offset
uniform float u_offset;
uniform vec3 u_middle, u_axis_a, u_axis_b;  // |axis . (p - middle)| <= 1 on it
uniform float u_strength;
uniform float u_fade_m;   // 0 for a mirror that does not melt into the horizon
uniform int u_take_away;  // 1: the light that the images hide; 0: the images

out vec4 out_color;

void main() {
    vec4 image = texelFetch(u_layer, ivec2(gl_FragCoord.xy), 0);
    vec3 d = ray_through(gl_FragCoord.xy), start = ray_start(gl_FragCoord.xy);
    float facing = dot(u_normal, d);
    if (image.a <= 0.0 || facing >= -1e-7) discard;
    float t = (u_offset - dot(u_normal, start)) / facing;
    vec3 p = start + t * d;
    float aside = max(abs(dot(u_axis_a, p - u_middle)), abs(dot(u_axis_b, p - u_middle)));

    // The part of the pixel that shows the mirror: of either layer the one at the mirror's depth,
    // which changes by this much to the neighbouring pixels.
    uvec4 facts = texelFetch(u_facts, ivec2(gl_FragCoord.xy), 0);
    float near = uintBitsToFloat(facts.x), far = uintBitsToFloat(facts.y);
    float slope = pixel_at(t) * (abs(u_normal.x) + abs(u_normal.y)) / -facing;
    float near_part = near == far ? 1.0 : float(facts.z >> 20) / 1023.0;
    float reach = 1e-4 * t + 0.6 * slope;
    float part = (abs(near - t) < reach ? near_part : 0.0) +
                 (abs(far - t) < reach ? 1.0 - near_part : 0.0);
    if (part <= 0.0 || aside > 1.01) discard;

    float share = part * mirrored_share(u_strength, -facing * inversesqrt(dot(d, d)));
#ifndef ORTHOGRAPHIC
    float away = u_fade_m > 0.0 ? length(p) / u_fade_m : 0.0;
    share *= exp(-away * away);
#endif
    vec3 hidden = image.a * texelFetch(u_mirror, ivec2(gl_FragCoord.xy), 0).rgb;
    out_color = vec4(u_take_away == 1 ? hidden : share * image.rgb, 0.0);
}
