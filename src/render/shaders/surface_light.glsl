// Which surface a ray meets first, and what others take from the light there.

#ifdef OTHERS
void meet_others(inout Hit hit, vec3 d) {
    int i = v_seen.z;
    do {
        bool here = i < v_seen.w;
        int item = listed(i);
        vec4 a = surface(item, 0) - vec4(g_start, 0.0);
        vec4 b = surface(item, 1);
#ifdef CAPSULES
        if (b.w == kCapsule) meet_capsule(hit, d, item, here, a, b.xyz);
#endif
#ifdef CYLINDERS
        if (b.w == kCylinder) meet_cylinder(hit, d, item, here, a, b.xyz);
#endif
#ifdef SHELLS
        if (b.w >= kBowl) meet_shell(hit, d, item, here, shell_of(a, b, surface(item, 2)));
#endif
#ifdef RINGS
        if (b.w == kRing)
            meet_ring(hit, d, item, here, Ring(a.xyz, b.xyz, a.w, surface(item, 2).x));
#endif
    } while (++i < v_seen.w);
}
#endif

#if defined(GROUND)  // all pixels meet the plane
Hit nearest_surface(vec3 d) {
    vec4 plane = surface(0, 0);
    float under = plane.w - dot(plane.xyz, g_start);
    return Hit(under / dot(plane.xyz, d), 0, plane.xyz, 0, false, vec2(0.0));
}
#elif defined(SKY)  // and here none does
Hit nearest_surface(vec3 d) {
    return Hit(kFar, -1, vec3(0.0, 0.0, -1.0), 0, false, vec2(0.0));
}
#else
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
#ifdef OTHERS
    meet_others(hit, d);
#endif
    return hit;
}
#endif

vec2 turned(vec2 v, vec2 by) { return vec2(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x); }

#if defined(BOXES) || defined(CYLINDERS) || defined(SHELLS)
#define SAMPLED  // they hide parts of the lamp that are found ray by ray
// Sunflower spiral: even over the disc for any count. A step turns by the golden angle; the first one
// by half of it and by that of the rays before.
const vec2 kGolden = vec2(-0.73736888, 0.67549029);

// Of 64 rays to the lamp the one at `place` of 0.5 ... 63.5, whose spoke has come to `spoke`.
vec3 lamp_ray(float place, vec2 spoke, vec3 side, vec3 side2) {
    vec2 disc = sqrt(place / 64.0) * u_light_tan * spoke;
    return u_light + disc.x * side + disc.y * side2;
}

// Where it starts, from the middle of the pixel. Another turn than the spiral's, so that the two do
// not go together.
vec3 within_pixel(float place, vec3 px, vec3 py) {
    vec2 within = fract(vec2(place * 0.75487767, place * 0.56984029)) - 0.5;
    return within.x * px + within.y * py;
}
#endif

// Distance of a point from a box around the origin, given |point| - half the edges; negative inside.
float outside_box(vec3 q) { return length(max(q, 0.0)) + min(max(max(q.x, q.y), q.z), 0.0); }

// What other surfaces take from the light at p, whose normal is n; both lights are looked up in one
// pass over the bodies, since reading one costs more than what is done with it.
// x: the part of the key light that reaches the point, lifted by `lift`, past the static bodies. Planes
// cast no shadow: a wall between the lamp and the scene would put everything in the dark. Boxes,
// cylinders and hollow bodies are sampled over the lamp's disc and over the pixel, which reaches px and py along the
// surface, with 64 rays.
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
#ifdef SAMPLED
    vec3 side = normalize(abs(u_light.x) < 0.7 ? cross(u_light, vec3(1, 0, 0))
                                               : cross(u_light, vec3(0, 1, 0)));
    vec3 side2 = cross(u_light, side);
    int first = all ? 0 : (sample_index & 7) * 8, samples = all ? 64 : 8;
    vec2 first_spoke = vec2(0.36237489, 0.93203242);
    if ((first & 8) != 0) first_spoke = turned(first_spoke, vec2(0.93932130, 0.34303863));
    if ((first & 16) != 0) first_spoke = turned(first_spoke, vec2(0.76464899, 0.64444699));
    if ((first & 32) != 0) first_spoke = turned(first_spoke, vec2(0.16937616, 0.98555148));
#endif
#ifdef BOXES
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
            vec3 l = lamp_ray(place, spoke, side, side2);
            spoke = turned(spoke, kGolden);
            vec3 off = within_pixel(place, px, py);
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
#ifdef OTHERS
    int c = v_shading.z;
    do {
        int item = listed(c);
        vec4 a = surface(item, 0), b = surface(item, 1);
        bool other = c < v_shading.w && item != own;
        vec3 gap = vec3(kFar);
#ifdef CAPSULES
        if (b.w == kCapsule) {
            vec3 rel = p - a.xyz;
            vec3 at = clamp((dot(rel, b.xyz) + heights * dot(n, b.xyz)) / max(dot(b.xyz, b.xyz), 1e-20),
                            0.0, 1.0);
            gap = vec3(length(rel + heights.x * n - at.x * b.xyz),
                       length(rel + heights.y * n - at.y * b.xyz),
                       length(rel + heights.z * n - at.z * b.xyz)) - a.w;
            vec2 nearest = ray_to_segment(u_light, -rel - lift * n, b.xyz);
            if (other && nearest.y > 0.0)
                visible *= 1.0 - hidden_by_ball(nearest.y, nearest.x, a.w, blur);
        }
#endif
#ifdef CYLINDERS
        if (b.w == kCylinder) {
            Rod rod = rod_of(a, b.xyz);
            gap = vec3(outside_cylinder(rod, p + heights.x * n), outside_cylinder(rod, p + heights.y * n),
                       outside_cylinder(rod, p + heights.z * n));
            rod.middle -= p + lift * n;
            float along = dot(rod.middle, u_light), around = length(vec2(rod.half_length, rod.radius));
            // No ray strays further from the middle one than this.
            float stray = (along + around) * u_light_tan + 0.5 * (length(px) + length(py));
            bool near = other && along > -around &&
                        length(rod.middle - along * u_light) < around + max(stray, 0.0);
            int count = near ? samples : 0;
            float hidden = 0.0;
            vec2 spoke = first_spoke;
            int k = 0;
            do {
                float place = float(first + k) + 0.5;
                vec3 l = lamp_ray(place, spoke, side, side2);
                spoke = turned(spoke, kGolden);
                Rod seen = rod;
                seen.middle -= within_pixel(place, px, py);
                vec4 way = through_cylinder(l, seen, 0.0);
                hidden += k < count && way.x < way.y && way.y > 0.0 ? 1.0 : 0.0;
            } while (++k < count);
            visible *= 1.0 - hidden / float(max(count, 1));
        }
#endif
#ifdef RINGS
        if (b.w == kRing) {
            Ring ring = Ring(a.xyz, b.xyz, a.w, surface(item, 2).x);
            gap = vec3(from_circle(ring, p + heights.x * n), from_circle(ring, p + heights.y * n),
                       from_circle(ring, p + heights.z * n)) - ring.tube;
            if (other) visible *= light_past_ring(ring, p + lift * n, blur);
        }
#endif
#ifdef SHELLS
        if (b.w >= kBowl) {
            // Hollow: it takes light from itself too.
            bool listed_here = c < v_shading.w;
            Shell shell = shell_of(a, b, surface(item, 2));
            gap = vec3(from_shell(shell, p + heights.x * n), from_shell(shell, p + heights.y * n),
                       from_shell(shell, p + heights.z * n));
            vec3 from = p + lift * n - shell.middle;
            int count = listed_here ? samples : 0;
            float hidden = 0.0;
            vec2 spoke = first_spoke;
            int k = 0;
            do {
                float place = float(first + k) + 0.5;
                vec3 l = lamp_ray(place, spoke, side, side2);
                spoke = turned(spoke, kGolden);
                // On the wall itself the pixel's width would lead through it.
                vec3 off = item == own ? vec3(0.0) : within_pixel(place, px, py);
                hidden += k < count && stands_in_way(shell, from + off, l) ? 1.0 : 0.0;
            } while (++k < count);
            visible *= 1.0 - hidden / float(max(count, 1));
        }
#endif
        if (other) away = min(away, gap);
    } while (++c < v_shading.w);
#endif
    vec3 closed = 1.0 - clamp(away, vec3(0.0), heights) / heights;
    float one = mod(float(max(sample_index, 0)), 3.0);
    float taken = one < 0.5 ? closed.x : (one < 1.5 ? closed.y : closed.z);
    if (all) taken = (closed.x + closed.y + closed.z) / 3.0;
    return vec2(visible, 1.0 - 0.75 * taken);
}
