// A sphere met by the pixel's ray, its markings, its light, and an analytic edge.
//
// With c = k d_ref + offset the centre and d the pixel's ray, w = k (d - d_ref) - offset is the
// vector from the centre to a point of the ray, and u = w - d (w.d)/(d.d) the one to its nearest
// point; all in radii. |u| = 1 is the outline. The surface is met at u - h d/|d|, h^2 = 1 - |u|^2.

uniform samplerBuffer u_casters;
#ifdef OCCLUDED
uniform usampler2D u_g_buffer;  // background_picture.h
uniform sampler2D u_front;
#endif

#ifdef MIRRORED
uniform int u_is_image;      // 1: what is drawn are images in a mirror; 0: the balls themselves
uniform sampler2D u_mirror;  // background_picture.h
uniform vec3 u_mirror_normal;
uniform float u_mirror_offset;
#endif

flat in vec4 v_ray;      // pixel of d_ref, k, radius [m]
flat in vec3 v_offset;
flat in vec4 v_row_x;    // rows of ball-from-view; w: part of the key light that reaches the ball
flat in vec3 v_row_y;
flat in vec3 v_row_z;
flat in vec4 v_contact;  // towards the nearest surface, 1 where it touches
flat in ivec2 v_casters; // first, count

#ifdef SWEPT
flat in vec3 v_sweep;    // way of the centre while the shutter is open, radii
flat in vec3 v_turn;     // and turn of the ball, axis times angle
#endif

out vec4 out_color;

// Area of the part of a unit square that lies on the positive side of a line; x is the signed
// distance of the square's middle from the line, n the line's unit normal.
float square_part(float x, vec2 n) {
    float a = max(abs(n.x), abs(n.y)), b = max(min(abs(n.x), abs(n.y)), 1e-3);
    x = clamp(x, -1.0, 1.0);  // the square ends before; larger values would cancel badly
    vec4 ends = max(vec4(x) + 0.5 * vec4(a + b, a - b, b - a, -a - b), 0.0);
    ends *= ends;
    return clamp((ends.x - ends.y - ends.z + ends.w) / (2.0 * a * b), 0.0, 1.0);
}

// Part of the pixel that the ball covers. `edge` is the distance of the outline outside the pixel's
// middle, `size` the ball's radius, both in pixels.
float coverage(float edge, float size, vec2 n) {
    // The outline bends within the pixel: the mean sag of an arc under its chord of 1.
    float bend = size > 0.5 ? 1.0 / (24.0 * size) : 0.0;
    float covered = square_part(edge - bend, n);
    // A ball smaller than a pixel: also the far side cuts, and only a disc of the strip is left.
    if (size < 1.5) covered += square_part(2.0 * size - edge, n) - 1.0;
    return clamp(covered, 0.0, 1.0) * min(1.0, 1.5707963 * size);
}

#ifdef GHOST
// A translucent ball within an outline. The list of casters holds the solid balls that may hide it.
uniform vec3 u_ghost;     // of the outline
uniform float u_outline;  // its width, pixels

const float kFill = 0.34;  // opacity within
const float kRing = 0.92;  // and of the outline

// Part of the ghost at this pixel that no solid ball hides; u and d as above, `pixel` a pixel's
// width there, all in radii. Along the ray, counted from the point nearest to the ghost's centre,
// the ghost is met at -sqrt(1 - |u|^2), and a ball at rel with radius r at
// -(u - rel).d - sqrt(r^2 - |u - rel|^2 + ((u - rel).d)^2).
float seen_part(vec3 u, vec3 d, float pixel) {
    float front = -sqrt(max(1.0 - dot(u, u), 0.0));
    float seen = 1.0;
    for (int i = 0; i < v_casters.y; ++i) {
        vec4 hider = texelFetch(u_casters, v_casters.x + i);
        vec3 q = u - hider.xyz;
        float along = dot(q, d), across = length(q - d * along);
        float covered = clamp((hider.w - across) / pixel + 0.5, 0.0, 1.0);
        float depth = -along - sqrt(max(hider.w * hider.w - across * across, 0.0));
        // Where the surfaces meet, the solid one is in front; soft by a few pixels.
        float soft = 2.0 * pixel;
        seen *= 1.0 - covered * smoothstep(-2.0 * soft, 0.0, front - depth);
    }
    return seen;
}
#endif

// Light on the point with normal n (view space) of a body of the given colour and gloss.
vec3 lit(vec3 body, vec2 gloss, vec3 n, vec3 d_unit, float blur) {
    float key = v_row_x.w, open = 1.0;
#if !defined(GHOST) && !defined(NO_CASTERS)
    // A software rasteriser runs through this once even if there is none: most balls have another
    // program.
    for (int i = 0; i < v_casters.y; ++i) {
        vec4 caster = texelFetch(u_casters, v_casters.x + i);
        vec3 rel = caster.xyz - n;
        float along = dot(rel, u_light);
        float across = length(rel - along * u_light);
        if (along > 0.0) key *= 1.0 - hidden_by_ball(along, across, caster.w, blur);
        float away2 = dot(rel, rel);
        open *= 1.0 - 0.8 * max(dot(n, rel), 0.0) * inversesqrt(away2) *
                          min(caster.w * caster.w / away2, 1.0);
    }
#endif
    // The nearest surface takes the light of its half of the world away, most where it touches.
    float toward = 0.5 + 0.5 * dot(n, v_contact.xyz);
    open *= 1.0 - 0.72 * v_contact.w * toward * toward;

    vec3 light = kKey * (key * max(dot(n, u_light), 0.0)) + ambient_light(n) * open;
    float shine = max(dot(n, normalize(u_light - d_unit)), 0.0);
    return body * light + kKey * (gloss.y * key * pow(shine, gloss.x));
}

// Vector from the centre to the nearest point of a ray, and that point's depth; in radii.
vec4 nearest_on_ray(vec2 pixel, vec3 d) {
#ifdef ORTHOGRAPHIC
    return vec4((pixel - v_ray.xy) * (u_pixel / v_ray.w), 0.0, v_ray.z);
#endif
    vec3 w = v_ray.z * vec3((pixel - v_ray.xy) * u_pixel, 0.0) - v_offset;
    float s = dot(w, d) / dot(d, d);
    return vec4(w - d * s, v_ray.z - s);
}

// Width of a pixel at the depth t; in radii.
float pixel_in_radii(float t) {
#ifdef ORTHOGRAPHIC
    return u_pixel / v_ray.w;
#else
    return t * u_pixel;
#endif
}

#ifdef SWEPT
// While the shutter is open the centre goes along a line. At the moment x, -0.5 ... 0.5, u has changed
// by -x times the part of the way across the ray. x: the part of the time and of the pixel that the
// ball covers, from four parts of the time, in each of which the edge goes as far as it does at the
// middle; y: the moment in the middle of that.
// The outline lies `inset` pixels within the ball.
vec2 swept_coverage(vec3 u, vec3 across, float scale, float inset) {
    float covered = 0.0, moment = 0.0;
    for (int i = 0; i < 4; ++i) {
        float x = 0.25 * float(i) - 0.375;
        vec3 v = u - x * across;
        float rho = max(length(v), 1e-6), rho_picture = max(length(v.xy), 1e-6);
        float size = rho / (scale * rho_picture);
        float edge_way = 0.25 * size * abs(dot(v, across)) / rho;
        float part = coverage(((1.0 - rho) * size - inset) / (1.0 + edge_way), size,
                              v.xy / rho_picture);
        covered += part;
        moment += part * x;
    }
    return vec2(0.25 * covered, moment / max(covered, 1e-6));
}
#endif

void main() {
    vec2 pixel = gl_FragCoord.xy;
    vec3 d = ray_through(pixel);
    vec4 nearest = nearest_on_ray(pixel, d);
    if (nearest.w <= 0.0) discard;
    vec3 u = nearest.xyz;
#ifdef SWEPT
    float along = dot(v_sweep, d) / dot(d, d);
    vec3 across = v_sweep - d * along;
    vec3 u_middle = u;
    vec2 swept = swept_coverage(u, across, pixel_in_radii(nearest.w), 0.0);
    if (swept.x <= 0.0) discard;
    // From here on the ball stands where it is at the moment in the middle.
    nearest.w += swept.y * along;
    u -= swept.y * across;
#endif
    float rho = max(length(u), 1e-6), rho_picture = max(length(u.xy), 1e-6);

    // Distance from the outline in pixels: rho changes by 1 / size per pixel, along u.
    float scale = pixel_in_radii(nearest.w);
    float size = rho / (scale * rho_picture);
    float edge = (1.0 - rho) * size;
#ifdef SWEPT
    float alpha = swept.x;
#else
    float alpha = coverage(edge, size, u.xy / rho_picture);
    if (alpha <= 0.0) discard;
#endif

#ifdef GHOST
    float seen = seen_part(u, normalize(d), scale);
    if (seen <= 0.0) discard;
    // The outline lies within the ball, and leaves most of a small one open.
    float inset = min(u_outline, 0.4 * size);
#ifdef SWEPT
    float inner = swept_coverage(u_middle, across, scale, inset).x;
#else
    float inner = coverage(edge - inset, size, u.xy / rho_picture);
#endif
#endif

    // One point inside; at the outline four, since there colours change fast within a pixel.
    mat3 view_from_ball = mat3(v_row_x.xyz, v_row_y, v_row_z);
    int points = edge < 1.0 ? 4 : 1;
    float part = points == 1 ? 1.0 : 0.5;  // of a pixel's width
    vec3 color = vec3(0.0);
    float weight = 0.0, depth = 0.0;
    // A software rasteriser would run once more through a loop that is left at its top.
    int i = 0;
    do {
        vec2 at = vec2(i & 1, i >> 1) - 0.5;
        at = points == 1 ? vec2(0.0) : 0.5 * vec2(at.x - 0.5 * at.y, at.y + 0.5 * at.x);
        vec3 d_unit = normalize(ray_through(pixel + at));
        u = nearest_on_ray(pixel + at, d_unit).xyz;
#ifdef SWEPT
        u -= swept.y * across;
#endif
        float out_by = length(u);
        // A point beside the ball moves to its rim, and counts little.
        float inner = min(out_by, max(1.0 - 0.15 / size, 0.5));
        u *= inner / max(out_by, 1e-6);
        float h = sqrt(1.0 - inner * inner);
        vec3 n = u - d_unit * h;

        // How far n moves to the next point, with t the depth in radii and X a pixel on z = 1:
        // dn/dx = t (X - d^(d^.X) + d^ (u.X) / h), d^ the ray's unit vector.
        float t = nearest.w - h * inversesqrt(dot(d, d));
        float reach = part * pixel_in_radii(t);
        vec3 nx = reach * (vec3(1, 0, 0) + d_unit * (u.x / h - d_unit.x));
        vec3 ny = reach * (vec3(0, 1, 0) + d_unit * (u.y / h - d_unit.y));
#ifdef SWEPT
        // And how far it moves over the ball while the shutter is open, of which the turn is a part.
        vec3 nt = -across - d_unit * (dot(u, across) / h) - cross(v_turn, n);
        g_moved = swept.x * nt * view_from_ball;
#endif
        vec2 gloss;
        vec3 body = marking(n * view_from_ball, nx * view_from_ball, ny * view_from_ball, gloss);
        float counts = out_by < 1.0 ? 1.0 : 1e-3;
        color += counts * min(lit(body, gloss, n, d_unit, scale), 1.0);
        weight += counts;
        depth = v_ray.w * t;
    } while (++i < points);
    color /= weight;

#ifdef MIRRORED
    // From the mirror on, the ray goes as far as to what hides the ball, or not.
    bool is_image = u_is_image == 1;
    float to_mirror = (u_mirror_offset - dot(u_mirror_normal, ray_start(pixel))) /
                      dot(u_mirror_normal, d);
    if (is_image && depth - to_mirror > texelFetch(u_mirror, ivec2(pixel), 0).a) discard;
#else
    const bool is_image = false;
#endif
#ifdef OCCLUDED
    uvec4 g_buffer = texelFetch(u_g_buffer, ivec2(gl_FragCoord.xy), 0);
    float front_part = float(g_buffer.z >> 20) / 1023.0;
    if (!is_image && depth > uintBitsToFloat(g_buffer.y)) discard;
    if (!is_image && depth > uintBitsToFloat(g_buffer.x)) {
        // Within an edge of a body before the ball: the body keeps its share of the pixel.
#ifdef GHOST
        seen *= 1.0 - front_part;
#else
        color = mix(color, texelFetch(u_front, ivec2(gl_FragCoord.xy), 0).rgb, front_part);
#endif
    }
#endif
#ifdef GHOST
    float fill = kFill * inner, ring = kRing * (alpha - inner);
    out_color = seen * vec4(color * fill + u_ghost * ring, fill + ring);
#else
    out_color = vec4(color * alpha, alpha);
#endif
}
