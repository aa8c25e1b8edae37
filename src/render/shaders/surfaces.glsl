// Rays, shadows and distances of the static surfaces (surface_table.h says what a record holds).
// PLANES, BOXES, SPHERES and CAPSULES are defined where the scene has such; a software rasteriser
// runs through every branch, so that code for what is not there would cost as much as the rest. It
// also runs through a loop's body once more after the last lane has left at the top: loops leave at
// their end instead, and what a list does not hold is passed by in the body.

uniform samplerBuffer u_surfaces;
uniform ivec4 u_counts;  // planes, boxes, spheres, capsules

// Lists of bodies, part of the picture by part (surface_tiles.h): first entry, then where the entries of
// boxes, spheres and capsules end.
uniform samplerBuffer u_listed;
flat in ivec4 v_seen;     // bodies that rays may meet
flat in ivec4 v_shading;  // bodies that may take light
#ifdef MANY_PLANES
flat in ivec4 v_planes;   // planes that rays may meet, first and end; and those that make crevices
#endif

const float kFar = 1e30;
const int kSection = -2;  // and below: the cut through plane kSection - item
// An edge is sought this far around a pixel's centre, whose outermost samples lie 23 / 48 of a pixel
// from it along both axes: their diagonal and some, pixels, and where the change from pixel to pixel
// is known along both axes, in sums of these changes.
const float kEdgeReach = 0.74;
const float kEdgeSteps = 0.52;

#if defined(ORTHOGRAPHIC) || defined(REFLECTION)
vec3 g_start = vec3(0.0);  // of the ray that is followed; set before nearest_surface()
#else
const vec3 g_start = vec3(0.0);
#endif
#ifdef REFLECTION
// Of a ray from a mirror: the depth of the pixel's ray there, and the directions in which the rays of
// the neighbouring pixels differ from it.
float g_before = 0.0;
vec3 g_right = vec3(1, 0, 0), g_down = vec3(0, 1, 0);
float pixel_on(float t) { return pixel_at(g_before + t); }
#else
const vec3 g_right = vec3(1, 0, 0), g_down = vec3(0, 1, 0);
float pixel_on(float t) { return pixel_at(t); }  // width of a pixel at the depth t of the ray
#endif

vec4 surface(int item, int slot) { return texelFetch(u_surfaces, item * 8 + slot); }

int listed(int entry) { return int(texelFetch(u_listed, entry).x); }

struct Hit {
    float t;      // depth, kFar for the sky
    int item;     // record, -1 for the sky, kSection
    vec3 n;       // unit, towards the eye
    int axis;     // boxes: the face's axis
    bool edge;    // an edge may pass through this pixel
    vec2 slope;   // change of t to the neighbouring pixels
};

vec3 safe_direction(vec3 d) {
    return mix(d, vec3(1e-9), lessThan(abs(d), vec3(1e-9)));
}

// Takes a nearer surface into `hit`. Two surfaces at nearly the same depth meet in this pixel.
void take(inout Hit hit, float t, int item, vec3 n, int axis, vec3 d) {
    vec2 slope = -pixel_on(t) * vec2(dot(n, g_right), dot(n, g_down)) / min(dot(n, d), -1e-6);
    slope = abs(slope.x) + abs(slope.y) < kFar ? abs(slope) : vec2(kFar);
    if (abs(t - hit.t) < kEdgeSteps * (slope.x + slope.y + hit.slope.x + hit.slope.y))
        hit.edge = true;
    if (t < hit.t) {
        hit.t = t;
        hit.item = item;
        hit.n = n;
        hit.axis = axis;
        hit.slope = slope;
    }
}

#ifdef PLANES
void meet_planes(inout Hit hit, vec3 d) {
#ifdef MANY_PLANES
    int entry = v_planes.x, end = v_planes.y;
#else
    int entry = 0, end = u_counts.x;
#endif
    do {
#ifdef MANY_PLANES
        bool here = entry < end;
        int i = listed(entry);
#else
        const bool here = true;
        int i = entry;
#endif
        vec4 plane = surface(i, 0);
        float toward = dot(plane.xyz, d), under = plane.w - dot(plane.xyz, g_start);
        if (here && toward < -1e-7) take(hit, under / toward, i, plane.xyz, 0, d);
#ifdef ORTHOGRAPHIC
        // Edge-on: the ground below the plane is cut open, as far away as the sky.
        if (here && abs(toward) <= 1e-7 && hit.item < 0) {
            if (abs(under) < kEdgeReach * u_pixel) hit.edge = true;
            if (under > 0.0) hit.item = kSection - i;
        }
#endif
    } while (++entry < end);
}
#endif

#ifdef BOXES
void meet_boxes(inout Hit hit, vec3 d) {
    int i = v_seen.x;
    do {
        bool here = i < v_seen.y;
        int item = listed(i);
        vec4 center = surface(item, 0) - vec4(g_start, 0.0);
        vec4 rx = surface(item, 1), ry = surface(item, 2), rz = surface(item, 3);
        vec3 half_edge = vec3(rx.w, ry.w, rz.w);
        vec3 rd = safe_direction(vec3(dot(rx.xyz, d), dot(ry.xyz, d), dot(rz.xyz, d)));
        vec3 ro = -vec3(dot(rx.xyz, center.xyz), dot(ry.xyz, center.xyz), dot(rz.xyz, center.xyz));
        vec3 inverse_rd = 1.0 / rd;
        vec3 middle = -ro * inverse_rd;
        vec3 reach = abs(inverse_rd) * half_edge;
        vec3 enter = middle - reach, leave = middle + reach;
        float t_in = max(max(enter.x, enter.y), enter.z);
        float t_out = min(min(leave.x, leave.y), leave.z);

        // Would a box that is a pixel's width larger be met?
        float depth = min(max(abs(t_in), abs(t_out)), length(center.xyz) + center.w);
        vec3 wider = abs(inverse_rd) * (half_edge + kEdgeReach * pixel_on(depth));
        vec3 enter_wide = middle - wider, leave_wide = middle + wider;
        float wide_in = max(max(enter_wide.x, enter_wide.y), enter_wide.z);
        float wide_out = min(min(leave_wide.x, leave_wide.y), leave_wide.z);
        bool near_miss = here && wide_in < wide_out && wide_out > 0.0;

        if (here && t_in < t_out && t_in > 0.0) {
            int axis = enter.x == t_in ? 0 : (enter.y == t_in ? 1 : 2);
            vec3 along = axis == 0 ? vec3(1, 0, 0) : (axis == 1 ? vec3(0, 1, 0) : vec3(0, 0, 1));
            vec3 n_box = -sign(rd) * along;
            vec3 n = n_box.x * rx.xyz + n_box.y * ry.xyz + n_box.z * rz.xyz;
            // How far the point on the face moves from pixel to pixel, along each axis of the box.
            float rd_axis = dot(rd, along);
            vec3 px = vec3(dot(rx.xyz, g_right), dot(ry.xyz, g_right), dot(rz.xyz, g_right));
            vec3 py = vec3(dot(rx.xyz, g_down), dot(ry.xyz, g_down), dot(rz.xyz, g_down));
            vec3 step_px = abs(px - rd * (dot(px, along) / rd_axis)) +
                           abs(py - rd * (dot(py, along) / rd_axis));
            vec3 inside = half_edge - abs(ro + t_in * rd) - kEdgeSteps * pixel_on(t_in) * step_px +
                          along * kFar;
            bool border = min(min(inside.x, inside.y), inside.z) < 0.0;
            if (t_in < hit.t && border) hit.edge = true;
            take(hit, t_in, item, n, axis, d);
        } else if (near_miss && wide_in < hit.t) {
            hit.edge = true;
        }
    } while (++i < v_seen.y);
}
#endif

#ifdef SPHERES
void meet_spheres(inout Hit hit, vec3 d) {
    float dd = dot(d, d);
    int i = v_seen.y;
    do {
        bool here = i < v_seen.z;
        int item = listed(i);
        vec4 sphere = surface(item, 0) - vec4(g_start, 0.0);
        float middle = dot(sphere.xyz, d) / dd;
        vec3 across = sphere.xyz - d * middle;
        float q = dot(across, across);
        float reach = sphere.w * sphere.w - q;
        float t = middle - sqrt(max(reach, 0.0) / dd);
        if (here && abs(sqrt(q) - sphere.w) < kEdgeReach * pixel_on(middle) && t < hit.t) hit.edge = true;
        if (here && reach > 0.0 && t > 0.0)
            take(hit, t, item, (t * d - sphere.xyz) / sphere.w, 0, d);
    } while (++i < v_seen.z);
}
#endif

#ifdef CAPSULES
// Distance between the ray and the segment a ... a + b, as (distance, depth there).
vec2 ray_to_segment(vec3 d, vec3 a, vec3 b) {
    float dd = dot(d, d), bb = dot(b, b), db = dot(d, b);
    float det = dd * bb - db * db;
    float s = det > 1e-12 * dd * bb ? (db * dot(a, d) - dd * dot(a, b)) / det : 0.0;
    vec3 p = a + clamp(s, 0.0, 1.0) * b;
    float t = dot(p, d) / dd;
    return vec2(length(p - t * d), t);
}

void meet_capsules(inout Hit hit, vec3 d) {
    float dd = dot(d, d);
    int i = v_seen.z;
    do {
        bool here = i < v_seen.w;
        int item = listed(i);
        vec4 a = surface(item, 0) - vec4(g_start, 0.0);
        vec3 b = surface(item, 1).xyz;
        vec2 nearest = ray_to_segment(d, a.xyz, b);
        // The cylinder: |p - axis|^2 = r^2, with everything projected across the axis.
        float bb = max(dot(b, b), 1e-20);
        float t = kFar;
        vec3 d_across = d - b * (dot(d, b) / bb);
        vec3 a_across = a.xyz - b * (dot(a.xyz, b) / bb);
        float qa = dot(d_across, d_across);
        float qb = dot(d_across, a_across);
        float disc = qb * qb - qa * (dot(a_across, a_across) - a.w * a.w);
        if (disc > 0.0 && qa > 1e-12) {
            float t_side = (qb - sqrt(disc)) / qa;
            float s = dot(t_side * d - a.xyz, b) / bb;
            if (s >= 0.0 && s <= 1.0) t = t_side;
        }
        for (int end = 0; end < 2; ++end) {
            vec3 c = a.xyz + float(end) * b;
            float middle = dot(c, d) / dd;
            vec3 across = c - d * middle;
            float reach = a.w * a.w - dot(across, across);
            if (reach > 0.0) t = min(t, middle - sqrt(reach / dd));
        }
        if (here && abs(nearest.x - a.w) < kEdgeReach * pixel_on(nearest.y) && nearest.y - a.w < hit.t)
            hit.edge = true;
        if (here && t > 0.0 && t < kFar) {
            vec3 p = t * d - a.xyz;
            vec3 n = (p - b * clamp(dot(p, b) / bb, 0.0, 1.0)) / a.w;
            take(hit, t, item, n, 0, d);
        }
    } while (++i < v_seen.w);
}
#endif

Hit nearest_surface(vec3 d) {
    Hit hit = Hit(kFar, -1, vec3(0.0, 0.0, -1.0), 0, false, vec2(0.0));
#ifdef PLANES
    meet_planes(hit, d);
#endif
#ifdef BOXES
    meet_boxes(hit, d);
#endif
#ifdef SPHERES
    meet_spheres(hit, d);
#endif
#ifdef CAPSULES
    meet_capsules(hit, d);
#endif
    return hit;
}

vec2 turned(vec2 v, vec2 by) { return vec2(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x); }

// Distance of a point from a box around the origin, given |point| - half the edges; negative inside.
float outside_box(vec3 q) { return length(max(q, 0.0)) + min(max(max(q.x, q.y), q.z), 0.0); }

// What other surfaces take from the light at p, whose normal is n; both lights are looked up in one
// pass over the bodies, since reading one costs more than what is done with it.
// x: the part of the key light that reaches the point, lifted by `lift`, past the static bodies. Planes
// cast no shadow: a wall between the lamp and the scene would put everything in the dark. Boxes are
// sampled over the lamp's disc and over the pixel, which reaches px and py along the surface, with
// 64 rays.
// y: 1 in the open, less where other surfaces come close within `reach` above the point, looked up at
// three heights.
// `sample_index` 0 ... 23 takes an eighth of the rays and one of the heights, which differ from one
// sample of an edge to the next; -1 takes all of them.
vec2 open_to_light(vec3 p, vec3 n, float lift, vec3 px, vec3 py, int own, float reach, int sample_index) {
    bool all = sample_index < 0;
    float blur = sqrt(0.5 * (dot(px, px) + dot(py, py)));
    vec3 heights = reach * vec3(1.0, 4.0, 9.0) / 9.0;
    vec3 away = vec3(kFar);  // of the nearest other surface, at each height
    float visible = 1.0;
#ifdef PLANES
#ifdef MANY_PLANES
    int plane_entry = v_planes.z, plane_end = v_planes.w;
#else
    int plane_entry = 0, plane_end = u_counts.x;
#endif
    do {
#ifdef MANY_PLANES
        int plane_item = plane_entry < plane_end ? listed(plane_entry) : own;
#else
        int plane_item = plane_entry;
#endif
        vec4 plane = surface(plane_item, 0);
        vec3 above = dot(plane.xyz, p) - plane.w + dot(plane.xyz, n) * heights;
        if (plane_item != own) away = min(away, above);
    } while (++plane_entry < plane_end);
#endif
#ifdef BOXES
    vec3 side = normalize(abs(u_light.x) < 0.7 ? cross(u_light, vec3(1, 0, 0))
                                               : cross(u_light, vec3(0, 1, 0)));
    vec3 side2 = cross(u_light, side);
    // Sunflower spiral: even over the disc for any count. A step turns by the golden angle; the first
    // one by half of it and by that of the rays before.
    const vec2 kGolden = vec2(-0.73736888, 0.67549029);
    int first = all ? 0 : (sample_index & 7) * 8, samples = all ? 64 : 8;
    vec2 first_spoke = vec2(0.36237489, 0.93203242);
    if ((first & 8) != 0) first_spoke = turned(first_spoke, vec2(0.93932130, 0.34303863));
    if ((first & 16) != 0) first_spoke = turned(first_spoke, vec2(0.76464899, 0.64444699));
    if ((first & 32) != 0) first_spoke = turned(first_spoke, vec2(0.16937616, 0.98555148));
    int i = v_shading.x;
    do {
        int item = listed(i);
        bool other = i < v_shading.y && item != own;
        vec4 center = surface(item, 0);
        vec4 rx = surface(item, 1), ry = surface(item, 2), rz = surface(item, 3);
        vec3 half_edge = vec3(rx.w, ry.w, rz.w);
        vec3 rel = p - center.xyz;
        vec3 at = vec3(dot(rx.xyz, rel), dot(ry.xyz, rel), dot(rz.xyz, rel));
        vec3 up = vec3(dot(rx.xyz, n), dot(ry.xyz, n), dot(rz.xyz, n));
        vec3 gap = vec3(outside_box(abs(at + heights.x * up) - half_edge),
                        outside_box(abs(at + heights.y * up) - half_edge),
                        outside_box(abs(at + heights.z * up) - half_edge));
        if (other) away = min(away, gap);

        vec3 ro = at + lift * up;
        rel += lift * n;
        float along = -dot(rel, u_light);
        bool near = other && along > -center.w &&
                    length(rel + along * u_light) < center.w + max(along, 0.0) * u_light_tan;
        // No ray strays further from the middle one than this: where that one passes a box which is
        // so much larger, all do.
        float stray = (along + center.w) * u_light_tan + 0.5 * (length(px) + length(py));
        vec3 ld = safe_direction(vec3(dot(rx.xyz, u_light), dot(ry.xyz, u_light),
                                      dot(rz.xyz, u_light)));
        vec3 mid = -ro / ld, wide = (half_edge + stray) / abs(ld);
        vec3 from_wide = mid - wide, to_wide = mid + wide;
        near = near && max(max(from_wide.x, from_wide.y), from_wide.z) <
                           min(min(to_wide.x, to_wide.y), to_wide.z);
        int count = near ? samples : 0;
        float hidden = 0.0;
        vec2 spoke = first_spoke;
        int k = 0;
        do {
            float place = float(first + k) + 0.5;
            vec2 disc = sqrt(place / 64.0) * u_light_tan * spoke;
            spoke = turned(spoke, kGolden);
            vec3 l = u_light + disc.x * side + disc.y * side2;
            // Another turn for the place within the pixel, so that the two do not go together.
            vec2 within = fract(vec2(place * 0.75487767, place * 0.56984029)) - 0.5;
            vec3 off = within.x * px + within.y * py;
            vec3 from = ro + vec3(dot(rx.xyz, off), dot(ry.xyz, off), dot(rz.xyz, off));
            vec3 rd = safe_direction(vec3(dot(rx.xyz, l), dot(ry.xyz, l), dot(rz.xyz, l)));
            vec3 middle = -from / rd, half_way = abs(half_edge / rd);
            vec3 enter = middle - half_way, leave = middle + half_way;
            float t_in = max(max(enter.x, enter.y), enter.z);
            float t_out = min(min(leave.x, leave.y), leave.z);
            hidden += k < count && t_in < t_out && t_out > 0.0 ? 1.0 : 0.0;
        } while (++k < count);
        visible *= 1.0 - hidden / float(max(count, 1));
    } while (++i < v_shading.y);
#endif
#ifdef SPHERES
    int j = v_shading.y;
    do {
        int item = listed(j);
        vec4 sphere = surface(item, 0);
        bool other = j < v_shading.z && item != own;
        vec3 rel = sphere.xyz - p;
        vec3 gap = sqrt(max(dot(rel, rel) + heights * (heights - 2.0 * dot(rel, n)), 0.0)) - sphere.w;
        if (other) away = min(away, gap);
        rel -= lift * n;
        float along = dot(rel, u_light);
        if (other && along > 0.0)
            visible *= 1.0 - hidden_by_ball(along, length(rel - along * u_light), sphere.w, blur);
    } while (++j < v_shading.z);
#endif
#ifdef CAPSULES
    int c = v_shading.z;
    do {
        int item = listed(c);
        vec4 a = surface(item, 0);
        vec3 b = surface(item, 1).xyz;
        bool other = c < v_shading.w && item != own;
        vec3 rel = p - a.xyz;
        vec3 at = clamp((dot(rel, b) + heights * dot(n, b)) / max(dot(b, b), 1e-20), 0.0, 1.0);
        vec3 gap = vec3(length(rel + heights.x * n - at.x * b), length(rel + heights.y * n - at.y * b),
                        length(rel + heights.z * n - at.z * b)) - a.w;
        if (other) away = min(away, gap);
        vec2 nearest = ray_to_segment(u_light, -rel - lift * n, b);
        if (other && nearest.y > 0.0)
            visible *= 1.0 - hidden_by_ball(nearest.y, nearest.x, a.w, blur);
    } while (++c < v_shading.w);
#endif
    vec3 closed = 1.0 - clamp(away, vec3(0.0), heights) / heights;
    float one = mod(float(max(sample_index, 0)), 3.0);
    float taken = one < 0.5 ? closed.x : (one < 1.5 ? closed.y : closed.z);
    if (all) taken = (closed.x + closed.y + closed.z) / 3.0;
    return vec2(visible, 1.0 - 0.75 * taken);
}
