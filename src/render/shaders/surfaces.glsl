// Rays that meet the static surfaces (surface_table.h says what a record holds).
// PLANES, BOXES, SPHERES and OTHERS, and among these CAPSULES, CYLINDERS, RINGS and SHELLS, are defined where the
// scene has such (other_surfaces.glsl has their rays and distances); a software rasteriser
// runs through every branch, so that code for what is not there would cost as much as the rest. It
// also runs through a loop's body once more after the last lane has left at the top: loops leave at
// their end instead, and what a list does not hold is passed by in the body.

uniform samplerBuffer u_surfaces;
uniform ivec4 u_counts;  // planes, boxes, spheres, others

// Lists of bodies, part of the picture by part (surface_tiles.h): first entry, then where the entries of
// boxes, spheres and others end.
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

#ifdef ONE_PLANE
// There is nothing but a plane, the same for all pixels, and the sky.
uniform vec4 u_plane[8];
vec4 surface(int item, int slot) { return u_plane[slot]; }
#else
vec4 surface(int item, int slot) { return texelFetch(u_surfaces, item * 8 + slot); }
#endif

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
#elif defined(ONE_PLANE)
    int entry = 0;
    const int end = 1;
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
