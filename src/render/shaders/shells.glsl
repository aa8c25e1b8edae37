// Rays and distances of bowls and pipes: walls without thickness, seen from both sides.

#ifdef SHELLS
// A wall that lies on a plane is seen before it, where both are at the same depth but for rounding.
const float kBefore = 1e-5;

// A part of a sphere around the middle, or of a cylinder around the axis.
struct Shell {
    vec3 middle, axis;  // the axis unit: a bowl's opening, a pipe's own
    float radius;
    bool pipe;
    float whole;         // length of a pipe
    vec3 opening;        // of a pipe
    float least;         // cosine of half a pipe's angle; a bowl's height of the rim
    float rim;           // radius of a bowl's
};

Shell shell_of(vec4 a, vec4 b, vec4 c) {
    bool pipe = b.w == kPipe;
    float whole = max(length(b.xyz), 1e-20);
    return Shell(a.xyz, b.xyz / whole, a.w, pipe, whole, c.xyz, pipe ? c.w : c.x, c.y);
}

// How far inside its borders a point of the whole sphere or cylinder is, from the middle: along both
// of the directions in which it may leave the wall. Negative outside.
vec2 inside_borders(Shell s, vec3 p) {
    float z = dot(p, s.axis);
    if (!s.pipe) return vec2(s.least - z, kFar);
    float slot = s.least < -1.0 ? kFar : -dot(p, s.opening) - s.least * s.radius;
    return vec2(min(z, s.whole - z), slot);
}

// Where the line p + t d, p from the shell's middle, meets the whole sphere or cylinder: both t, and
// how far it passes by the middle.
vec3 through_shell(Shell s, vec3 p, vec3 d) {
    if (s.pipe) {
        p -= dot(p, s.axis) * s.axis;
        d -= dot(d, s.axis) * s.axis;
    }
    float dd = max(dot(d, d), 1e-12);
    float middle = -dot(p, d) / dd;
    float passes = length(p + middle * d);
    float half_way = sqrt(max((s.radius - passes) * (s.radius + passes), 0.0) / dd);
    return vec3(middle - half_way, middle + half_way, passes);
}

// Whether the ray passes within a pixel by a place of the wall's border, before what it meets.
bool passes_border(Hit hit, Shell s, vec3 place, vec3 d) {
    vec3 seen = place + s.middle;
    float t = dot(seen, d) / dot(d, d);
    return t > 0.0 && t < hit.t && length(seen - t * d) < kEdgeReach * pixel_on(t);
}

// The same of the circle or arc at the height z, next to the point p.
bool passes_circle(Hit hit, Shell s, vec3 p, float z, vec3 d) {
    vec3 across = p - dot(p, s.axis) * s.axis;
    vec3 on = across * ((s.pipe ? s.radius : s.rim) / max(length(across), 1e-20)) + z * s.axis;
    return (!s.pipe || inside_borders(s, on).y >= 0.0) && passes_border(hit, s, on, d);
}

// The same of a pipe's straight edge from `end` on.
bool passes_edge(Hit hit, Shell s, vec3 end, vec3 d) {
    vec3 seen = end + s.middle;
    float dd = dot(d, d), along = dot(d, s.axis), det = dd - along * along;
    float z = (along * dot(seen, d) - dd * dot(seen, s.axis)) / max(det, 1e-12 * dd);
    return passes_border(hit, s, end + clamp(z, 0.0, s.whole) * s.axis, d);
}

// Where the ray comes through the plane of a circle, and where it meets the wall, its next point of the
// circle is sought: of these the first is the nearer, unless the circle is seen edge-on.
bool passes_borders(Hit hit, Shell s, vec3 one, vec3 two, vec3 d) {
    bool near = false;
    float dz = dot(d, s.axis), z0 = dot(s.middle, s.axis);
    dz = abs(dz) < 1e-9 ? 1e-9 : dz;
    for (int end = 0; end < (s.pipe ? 2 : 1); ++end) {
        float z = s.pipe ? float(end) * s.whole : s.least;
        vec3 through = ((z + z0) / dz) * d - s.middle;
        near = near || passes_circle(hit, s, through, z, d) || passes_circle(hit, s, one, z, d) ||
               passes_circle(hit, s, two, z, d);
    }
    if (s.pipe && s.least >= -1.0) {
        vec3 side = s.radius * sqrt(max(1.0 - s.least * s.least, 0.0)) * cross(s.axis, s.opening);
        vec3 back = -s.radius * s.least * s.opening;
        near = near || passes_edge(hit, s, back + side, d) || passes_edge(hit, s, back - side, d);
    }
    return near;
}

void meet_shell(inout Hit hit, vec3 d, int item, bool here, Shell s) {
    vec3 ways = through_shell(s, -s.middle, d);
    bool through = ways.z < s.radius;
    float middle = 0.5 * (ways.x + ways.y);
    bool outline = abs(ways.z - s.radius) < kEdgeReach * pixel_on(middle) &&
                   all(greaterThanEqual(inside_borders(s, middle * d - s.middle), vec2(0.0)));
    if (here && outline && middle > 0.0 && middle < hit.t) hit.edge = true;
    if (here && passes_borders(hit, s, ways.x * d - s.middle, ways.y * d - s.middle, d))
        hit.edge = true;
    for (int side = 0; side < 2; ++side) {
        float t = side == 0 ? ways.x : ways.y;
        vec3 p = t * d - s.middle;
        vec3 n = normalize(s.pipe ? p - dot(p, s.axis) * s.axis : p);
        if (dot(n, d) > 0.0) n = -n;
        if (here && through && t > 0.0 && all(greaterThanEqual(inside_borders(s, p), vec2(0.0))))
            take(hit, t * (1.0 - kBefore), item, n, 0, d);
    }
}

// Whether the wall stands in the way from p, seen from the middle, along l.
bool stands_in_way(Shell s, vec3 p, vec3 l) {
    vec3 ways = through_shell(s, p, l);
    bool one = ways.x > 0.0 && all(greaterThanEqual(inside_borders(s, p + ways.x * l), vec2(0.0)));
    bool two = ways.y > 0.0 && all(greaterThanEqual(inside_borders(s, p + ways.y * l), vec2(0.0)));
    return ways.z < s.radius && (one || two);
}

// Distance of a place from the wall.
float from_shell(Shell s, vec3 place) {
    vec3 p = place - s.middle;
    float z = dot(p, s.axis);
    vec3 across = p - z * s.axis;
    float away = length(across);
    if (!s.pipe) {
        float d = length(p);
        return z * s.radius <= s.least * d ? abs(d - s.radius) : length(vec2(away - s.rim, z - s.least));
    }
    float beyond = z - clamp(z, 0.0, s.whole), along = -dot(across, s.opening);
    float off = abs(away - s.radius);
    if (s.least >= -1.0 && along < s.least * away) {
        float aside = sqrt(max(away * away - along * along, 0.0));
        off = length(vec2(along - s.least * s.radius,
                          aside - sqrt(max(1.0 - s.least * s.least, 0.0)) * s.radius));
    }
    return length(vec2(off, beyond));
}
#endif
