// Rays and distances of the surfaces that are no planes, boxes or spheres: one list for all of them.
// Their records say of which kind they are, as OtherKind of surface_table.h numbers them.

#ifdef OTHERS
const float kCapsule = 0.0, kCylinder = 1.0, kRing = 2.0, kBowl = 3.0, kPipe = 4.0;
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

void meet_capsule(inout Hit hit, vec3 d, int item, bool here, vec4 a, vec3 b) {
    float dd = dot(d, d);
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
}
#endif

#if defined(CYLINDERS) || defined(RINGS)
struct Rod {
    vec3 middle, axis;  // the axis unit
    float half_length, radius;
};

Rod rod_of(vec4 a, vec3 b) {
    float whole = max(length(b), 1e-20);
    return Rod(a.xyz + 0.5 * b, b / whole, 0.5 * whole, a.w);
}

// Where the ray t d enters and leaves the cylinder, which is `wider` than it is: both depths, the first
// beyond the second where it is missed; 1 where it enters through an end; how far the ray's line passes
// by the axis.
vec4 through_cylinder(vec3 d, Rod rod, float wider) {
    float dz = dot(d, rod.axis), z = dot(rod.middle, rod.axis);
    vec3 d_across = d - dz * rod.axis, c_across = rod.middle - z * rod.axis;
    float qa = max(dot(d_across, d_across), 1e-12);
    float middle = dot(d_across, c_across) / qa;
    vec3 off = c_across - middle * d_across;
    float radius = rod.radius + wider, passes = length(off);
    float side = sqrt(max((radius - passes) * (radius + passes), 0.0) / qa);
    dz = abs(dz) < 1e-9 ? 1e-9 : dz;
    float slab = (rod.half_length + wider) / abs(dz), z_middle = z / dz;
    float enter_side = middle - side, enter_end = z_middle - slab;
    float leave = passes < radius ? min(middle + side, z_middle + slab) : -kFar;
    return vec4(max(enter_side, enter_end), leave, enter_end > enter_side ? 1.0 : 0.0, passes);
}

#endif

#ifdef CYLINDERS
void meet_cylinder(inout Hit hit, vec3 d, int item, bool here, vec4 a, vec3 b) {
    Rod rod = rod_of(a, b);
    vec4 way = through_cylinder(d, rod, 0.0);
    float t = way.x;
    if (here && t < way.y && t > 0.0) {
        vec3 p = t * d - rod.middle;
        float z = dot(p, rod.axis);
        vec3 across = p - z * rod.axis;
        float away = length(across);
        vec3 outward = across / max(away, 1e-20);
        bool end = way.z > 0.5;
        vec3 n = end ? (z < 0.0 ? -rod.axis : rod.axis) : outward;
        // How far the point moves from pixel to pixel towards the rim.
        vec3 to_rim = end ? outward : rod.axis;
        float facing = min(dot(n, d), -1e-6);
        vec3 px = g_right - d * (dot(n, g_right) / facing);
        vec3 py = g_down - d * (dot(n, g_down) / facing);
        float reach = kEdgeSteps * pixel_on(t) * (abs(dot(px, to_rim)) + abs(dot(py, to_rim)));
        float inside = end ? rod.radius - away : rod.half_length - abs(z);
        bool outline = !end && rod.radius - way.w < kEdgeReach * pixel_on(t);
        if (t < hit.t && (inside < reach || outline)) hit.edge = true;
        take(hit, t, item, n, 0, d);
    } else {
        // Would a cylinder that is a pixel's width larger be met? A pixel's width where it is.
        float farthest = length(rod.middle) + rod.half_length + rod.radius;
        vec4 wide = through_cylinder(d, rod, kEdgeReach * pixel_on(farthest));
        wide = through_cylinder(d, rod, kEdgeReach * pixel_on(clamp(wide.x, 0.0, farthest)));
        if (here && wide.x < wide.y && wide.y > 0.0 && wide.x < hit.t) hit.edge = true;
    }
}

// Distance of a place from the cylinder; negative inside.
float outside_cylinder(Rod rod, vec3 p) {
    vec3 from_middle = p - rod.middle;
    float z = dot(from_middle, rod.axis);
    vec2 q = vec2(length(from_middle - z * rod.axis) - rod.radius, abs(z) - rod.half_length);
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0);
}
#endif

#ifdef RINGS
struct Ring {
    vec3 center, axis;  // the axis unit
    float radius, tube;
};

// Distance of a place from the circle in the middle of the tube.
float from_circle(Ring ring, vec3 p) {
    vec3 from_center = p - ring.center;
    float z = dot(from_center, ring.axis);
    return length(vec2(length(from_center - z * ring.axis) - ring.radius, z));
}

// The part of the ray t d that may meet the ring made wider: through the flat cylinder around it.
vec2 near_ring(vec3 d, Ring ring, float wider) {
    Rod around = Rod(ring.center, ring.axis, ring.tube + wider, ring.radius + ring.tube + wider);
    return through_cylinder(d, around, 0.0).xy;
}

void meet_ring(inout Hit hit, vec3 d, int item, bool here, Ring ring) {
    const int kSteps = 96;
    const float kMet = 0.01;  // pixels
    float speed = length(d);
    float farthest = length(ring.center) + ring.radius + ring.tube;
    float wider = kEdgeReach * pixel_on(farthest);
    vec2 way = near_ring(d, ring, wider);
    // Along the ray by the distance from the ring, which is how far it certainly does not meet it.
    float t = max(way.x, 0.0), last = kFar;
    bool met = false, passes = false;
    int step = 0;
    bool on = here && way.x < way.y;
    do {
        if (on) {
            float gap = from_circle(ring, t * d) - ring.tube;
            float pixel = pixel_on(t);
            // It has come near, and goes away again: what lies behind is seen past an edge.
            passes = passes || (last < kEdgeReach && gap > last * pixel);
            last = gap / pixel;
            met = gap < kMet * pixel;
            if (!met) t += max(gap, kMet * pixel) / speed;
            on = !met && t < way.y;
        }
    } while (++step < kSteps && on);
    if (met && t > 0.0) {
        vec3 p = t * d - ring.center;
        float z = dot(p, ring.axis);
        vec3 across = p - z * ring.axis;
        vec3 n = normalize(p - across * (ring.radius / max(length(across), 1e-20)));
        // How far the outline of the tube is from here, as seen.
        float facing = clamp(-dot(n, d) / speed, 0.0, 1.0);
        float to_outline = ring.tube * (1.0 - sqrt(1.0 - facing * facing));
        if (t < hit.t && to_outline < kEdgeReach * pixel_on(t)) hit.edge = true;
        take(hit, t, item, n, 0, d);
    }
    if (here && (passes || (!met && last < kEdgeReach)) && way.x < hit.t) hit.edge = true;
}

// Where the ray p + s l comes nearest to the circle between two places: distance and s. There is one
// such place on either side of the ring's middle.
vec2 nearest_to_circle(Ring ring, vec3 p, vec3 l, float low, float high) {
    for (int i = 0; i < 18; ++i) {
        float a = mix(low, high, 0.38), b = mix(low, high, 0.62);
        if (from_circle(ring, p + a * l) < from_circle(ring, p + b * l)) high = b; else low = a;
    }
    float s = 0.5 * (low + high);
    return vec2(from_circle(ring, p + s * l), s);
}

// Part of the key light that a rod hides, as hidden_by_ball(): a strip, softened over as much as the
// penumbra and a pixel are wide.
float hidden_by_tube(float along, float across, float radius, float blur) {
    float spread = max(along, 0.0) * u_light_tan;
    float width = sqrt(spread * spread + blur * blur) + 1e-6 * radius;
    return smoothstep(-width, width, across + radius) - smoothstep(-width, width, across - radius);
}

// Part of the key light that the ring leaves to the place p.
float light_past_ring(Ring ring, vec3 p, float blur) {
    vec3 to_center = ring.center - p;
    float middle = dot(to_center, u_light), around = ring.radius + ring.tube;
    float aside = length(to_center - middle * u_light);
    float spread = max(middle + around, 0.0) * u_light_tan + blur;
    if (middle < -around || aside > around + spread) return 1.0;
    float half_way = around + spread;
    vec2 one = nearest_to_circle(ring, p, u_light, max(middle - half_way, 0.0), max(middle, 0.0));
    vec2 two = nearest_to_circle(ring, p, u_light, max(middle, 0.0), max(middle + half_way, 0.0));
    float left = 1.0 - hidden_by_tube(two.y, two.x, ring.tube, blur);
    // Seen edge-on, or where a ray begins within the ring, both are one.
    if (abs(one.y - two.y) > ring.tube) left *= 1.0 - hidden_by_tube(one.y, one.x, ring.tube, blur);
    return left;
}
#endif
