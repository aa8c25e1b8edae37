// The background: sky, planes to the horizon and bodies, with what the passes of each frame need to
// know about it. Drawn once per camera.

uniform float u_fade_m;      // distance at which planes have mostly melted into the horizon
uniform float u_ao_reach_m;  // how far a crevice darkens

out vec4 out_color;
#ifdef FRONT
out vec4 out_front;  // colour of the nearer of two layers alone, where an edge passes
#endif
#ifndef COLOR_ALONE
out uvec4 out_g_buffer;  // depth of the nearer layer, of the farther one; fractions; normal
#endif

// Of the body, with its pattern. Reading a record takes longer than what is done with it, and is done
// for all bodies alike.
vec3 albedo(Hit hit, vec3 d, float part) {
    vec4 first = surface(hit.item, 4);
    vec3 color = first.rgb;
#ifdef PATTERNED  // planes and boxes alone
    bool is_plane = hit.item < u_counts.x;
    int slot_u = 6, slot_v = 7;
#ifdef BOXES
    if (!is_plane) {
        slot_u = hit.axis == 2 ? 1 : 2 + hit.axis;
        slot_v = hit.axis == 0 ? 3 : hit.axis;
    }
#endif
    vec4 u = surface(hit.item, slot_u), v = surface(hit.item, slot_v);
    vec2 origin = vec2(u.w, v.w);
#ifdef BOXES
    vec3 center = is_plane ? vec3(0.0) : surface(hit.item, 0).xyz;
    // Squares and planks begin at an edge; a court's middle is the top's, and the sides lie far
    // beyond its lines.
#ifdef COURT
    if (!is_plane && first.w == kCourtStyle)
        origin = vec2(dot(surface(hit.item, 7).xyz, hit.n) < 0.999 ? 100.0 : 0.0);
#endif
    origin -= vec2(dot(u.xyz, center), dot(v.xyz, center));
#endif
    if (hit.item < u_counts.x + u_counts.y) {
        float facing = min(dot(hit.n, d), -1e-6);
        vec3 dx = g_right - d * (dot(hit.n, g_right) / facing);
        vec3 dy = g_down - d * (dot(hit.n, g_down) / facing);
        mat2 step = pixel_on(hit.t) * part *
                    mat2(dot(u.xyz, dx), dot(v.xyz, dx), dot(u.xyz, dy), dot(v.xyz, dy));
        vec3 p = g_start + hit.t * d;
        color = pattern(first, surface(hit.item, 5), vec2(dot(u.xyz, p), dot(v.xyz, p)) + origin,
                        step);
    }
#endif
    return color;
}

// sRGB of linear light (IEC 61966-2-1), within 0.01 of a code of 255: of x^(1/2.4) a fit in quarter
// powers. The driver's own encoding takes approximate roots from the processor, which differ from
// maker to maker: 5 % of a picture's pixels would be off by one.
vec3 encoded(vec3 linear) {
    vec3 x = clamp(linear, 0.0, 1.0), half_power = sqrt(x), quarter = sqrt(half_power);
    vec3 root = -0.0646115 + 0.1961358 * quarter + 1.1226816 * half_power -
                0.3355010 * half_power * quarter + 0.0813297 * x;
    return mix(root, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}

#ifdef REFLECTION
// Linear colour of what is mirrored times the part of the light that it is; how far away what is
// mirrored lies from the mirror, in lengths of the pixel's ray (kFar for the sky).
out vec4 out_mirror;

// Part of the light from here that the surface mirrors.
float reflected_part(Hit hit, vec3 d) {
    if (hit.item < 0 || hit.item >= u_counts.x + u_counts.y) return 0.0;
    bool is_box = hit.item >= u_counts.x;
    float strength = surface(hit.item, is_box ? 6 : 1).x;
#ifdef BOXES
    // Of a box the top alone; which one that is stands beside the strength.
    if (is_box && dot(surface(hit.item, 7).xyz, hit.n) < 0.999) return 0.0;
#endif
    return mirrored_share(strength, -dot(hit.n, normalize(d)));
}
#endif

struct Shaded {
    vec3 color;
    float direct;   // part of the colour that is key light
    float ambient;  // part that is ambient light
#ifdef TRANSPARENT
    float opaque;   // 1 for a body; for a plane the part of its light that bodies take from it
#endif
};

#ifdef TRANSPARENT
#define SHADED(color, direct, ambient, opaque) Shaded(color, direct, ambient, opaque)
#else
#define SHADED(color, direct, ambient, opaque) Shaded(color, direct, ambient)
#endif

const vec3 kLuma = vec3(0.2126, 0.7152, 0.0722);

// How much of a plane has melted into the horizon.
float faded(Hit hit, vec3 p) {
#ifndef ORTHOGRAPHIC
    if (hit.item < u_counts.x) {
        float away = length(p) / u_fade_m;
        return 1.0 - exp(-away * away);
    }
#endif
    return 0.0;
}

// `sample_index` as open_to_light() has it; the sample is `part` of a pixel wide.
Shaded shade(Hit hit, vec3 d, float part, int sample_index) {
#ifdef ORTHOGRAPHIC
    if (hit.item <= kSection) {
        int plane = kSection - hit.item;
        return SHADED(0.62 * mean_color(plane), 0.0, 0.0, 0.0);
    }
#endif
    if (hit.item < 0) return SHADED(background(d), 0.0, 0.0, 0.0);
    vec3 p = g_start + hit.t * d;
    vec3 body = albedo(hit, d, part);
    float facing = max(dot(hit.n, u_light), 0.0);
    float tilt = min(dot(hit.n, d), -1e-3);
    vec3 px = pixel_on(hit.t) * part * (g_right - d * (dot(hit.n, g_right) / tilt));
    vec3 py = pixel_on(hit.t) * part * (g_down - d * (dot(hit.n, g_down) / tilt));
    float visible = 1.0, open = 1.0;
#ifdef SEVERAL
    vec2 lit = open_to_light(p, hit.n, 1e-4 * hit.t, px, py, hit.item, u_ao_reach_m, sample_index);
    visible = lit.x;
    open = lit.y;
#endif
    vec3 direct = body * kKey * (facing * visible);
    vec3 ambient = body * ambient_light(hit.n) * open;

    float fade = faded(hit, p);
    vec3 color = mix(direct + ambient, background(d), fade);
    float whole = max(dot(color, kLuma), 1e-6);
#ifdef TRANSPARENT
    float whole_light = dot(body * (kKey * facing + ambient_light(hit.n)), kLuma);
    float taken = (1.0 - fade) * (1.0 - dot(direct + ambient, kLuma) / max(whole_light, 1e-6));
    float opaque = hit.item < u_counts.x ? clamp(taken, 0.0, 1.0) : 1.0;
#endif
    return SHADED(color, (1.0 - fade) * dot(direct, kLuma) / whole,
                  (1.0 - fade) * dot(ambient, kLuma) / whole, opaque);
}

#ifdef REFLECTION
// Adds what a mirror shows to `s`, which was shaded without: of the colour, the horizon's part stays,
// and of the rest the mirrored part is exchanged. out_mirror's colour comes back.
vec3 add_mirrored(inout Shaded s, Hit hit, vec3 d, float share, vec3 seen) {
    float fade = faded(hit, g_start + hit.t * d);
    vec3 mirrored = share * (1.0 - fade) * seen;
    vec3 color = s.color - share * (s.color - fade * background(d)) + mirrored;
    float scale = (1.0 - share) * dot(s.color, kLuma) / max(dot(color, kLuma), 1e-6);
    s.direct *= scale;
    s.ambient *= scale;
    s.color = color;
    return mirrored;
}
#endif

uint packed_unit(float x, int bits) {
    return uint(clamp(x, 0.0, 1.0) * float((1 << bits) - 1) + 0.5);
}

// Octahedral map (Meyer et al., On floating-point normal vectors, 2010).
uint packed_normal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0)
        p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return packed_unit(0.5 + 0.5 * p.x, 16) | (packed_unit(0.5 + 0.5 * p.y, 16) << 16);
}

void main() {
    // Sample 0 is the pixel's centre. Where it finds an edge, four more look for the depths of the two
    // layers, and 24 more are averaged instead of it.
    const int kProbes = 4, kSamples = 24;
    vec3 color = vec3(0.0), n_near = vec3(0.0), n_far = vec3(0.0);
    float direct = 0.0, ambient = 0.0, weight = 0.0, front_weight = 0.0;
#ifdef FRONT
    vec3 front = vec3(0.0);
#endif
    float t_near = 0.0, t_far = 0.0, split = 0.0, opaque = 0.0;
#ifdef REFLECTION
    vec4 mirror = vec4(0.0);
#endif
    int last = 1;
    int i = 0;
    do {
        vec2 at = vec2(0.0);
        int fine = i - 1 - kProbes;
        if (i > 0) {
            // A lattice: 24 different places along x and along y, evenly spread along all other
            // directions too. The probes lie around all of it: a line that cuts off a sample cuts off
            // a probe.
            float k = float(fine);
            at = fine < 0 ? vec2(i & 1, (i >> 1) & 1) * 23.0 : vec2(k, mod(5.0 * k + 8.0, 24.0));
            at = (at - 11.5) / 24.0;
        }
        vec3 d = ray_through(gl_FragCoord.xy + at);
#ifdef ORTHOGRAPHIC
        g_start = ray_start(gl_FragCoord.xy + at);
#endif
#if defined(REFLECTION) && defined(SEVERAL)
        // The pixel's ray, and where a mirror is met the ray from there: one after the other, so
        // that the code for both is there only once.
        Hit hit;
        Shaded s;
        bool whole;
        vec4 m = vec4(0.0, 0.0, 0.0, kFar);
        vec3 ray = d, eye = g_start;
        float share = 0.0;
        int ways = 1, way = 0;
        do {
            Hit met = nearest_surface(ray);
            if (way == 0) whole = i == 0 && !met.edge;
            Shaded seen = shade(met, ray, whole ? 1.0 : 0.25, whole ? -1 : max(fine, 0));
            if (way == 0) {
                hit = met;
                s = seen;
                share = reflected_part(hit, d);
                if (share > 0.0) {
                    ways = 2;
                    ray = reflect(d, hit.n);
                    g_start = g_start + hit.t * d + hit.n * (1e-4 * hit.t);
                    g_before = hit.t;
                    g_right = reflect(g_right, hit.n);
                    g_down = reflect(g_down, hit.n);
                }
            } else {
                g_start = eye;
                g_before = 0.0;
                g_right = vec3(1, 0, 0);
                g_down = vec3(0, 1, 0);
                bool sky = met.item < 0;
                m = vec4(add_mirrored(s, hit, d, share, sky ? background(ray) : seen.color),
                         sky ? kFar : met.t);
                if (met.edge) whole = false;
            }
        } while (++way < ways);
        if (i == 0 && !whole) last = 1 + kProbes + kSamples;
#else
        Hit hit = nearest_surface(d);
#ifdef SEVERAL
        bool whole = i == 0 && !hit.edge;
        if (i == 0 && hit.edge) last = 1 + kProbes + kSamples;
#else
        const bool whole = true;  // one plane has no edge
#endif
        Shaded s = shade(hit, d, whole ? 1.0 : 0.25, whole ? -1 : max(fine, 0));
#ifdef REFLECTION
        vec4 m = vec4(0.0, 0.0, 0.0, kFar);
        float share = reflected_part(hit, d);
        if (share > 0.0)
            m.rgb = add_mirrored(s, hit, d, share, background(reflect(d, hit.n)));
#endif
#endif
#ifdef REFLECTION
        if (i == 0) mirror.a = m.a;
        if (whole || fine >= 0) mirror.rgb += m.rgb;
#endif
        if (i == 0) {
            t_near = t_far = hit.t;
            n_near = n_far = hit.n;
        } else if (fine < 0) {
            if (hit.t < t_near) n_near = hit.n;
            if (hit.t > t_far) n_far = hit.n;
            t_near = min(t_near, hit.t);
            t_far = max(t_far, hit.t);
        }
        split = 0.5 * t_near + 0.5 * t_far;
        if (whole || fine >= 0) {
#ifdef TRANSPARENT
            if (hit.item < u_counts.x) s.color = vec3(0.0);  // sky and planes: only shadows
            opaque += s.opaque;
#endif
            color += s.color;
            direct += s.direct;
            ambient += s.ambient;
            weight += 1.0;
            if (whole || hit.t <= split) {
#ifdef FRONT
                front += s.color;
#endif
                front_weight += 1.0;
            }
        }
    } while (++i < last);
    float front_part = front_weight / weight;
#ifdef TRANSPARENT
    out_color = vec4(encoded(color / weight), opaque / weight);
#else
    out_color = vec4(encoded(color / weight), 1.0);
#endif
#ifdef REFLECTION
    out_mirror = vec4(mirror.rgb / weight, mirror.a);
#endif
#ifdef FRONT
    out_front = vec4(encoded(front / max(front_weight, 1.0)), 1.0);
#endif
#ifndef COLOR_ALONE
    out_g_buffer = uvec4(floatBitsToUint(t_near), floatBitsToUint(t_far),
                      packed_unit(direct / weight, 10) | (packed_unit(ambient / weight, 10) << 10) |
                          (packed_unit(front_part, 10) << 20),
                      packed_normal(front_part >= 0.5 ? n_near : n_far));
#endif
}
