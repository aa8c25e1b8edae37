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

void meet_shell(inout Hit hit, vec3 d, int item, bool here, Shell s) {
    vec3 ways = through_shell(s, -s.middle, d);
    bool through = ways.z < s.radius;
    float outline = abs(ways.z - s.radius);
    for (int side = 0; side < 2; ++side) {
        float t = side == 0 ? ways.x : ways.y;
        vec3 p = t * d - s.middle;
        vec3 out_n = s.pipe ? p - dot(p, s.axis) * s.axis : p;
        vec3 n = normalize(out_n);
        if (dot(n, d) > 0.0) n = -n;
        // How far the point moves from pixel to pixel towards its borders.
        float facing = min(dot(n, d), -1e-3);
        vec3 px = g_right - d * (dot(n, g_right) / facing);
        vec3 py = g_down - d * (dot(n, g_down) / facing);
        vec2 moves = vec2(abs(dot(px, s.axis)) + abs(dot(py, s.axis)),
                          abs(dot(px, s.opening)) + abs(dot(py, s.opening)));
        float pixel = pixel_on(t);
        vec2 inside = inside_borders(s, p), reach = kEdgeSteps * pixel * moves;
        bool near = here && t > 0.0 && t < hit.t && all(greaterThan(inside, -reach - 2.0 * pixel));
        if (near && outline < kEdgeReach * pixel) hit.edge = true;
        if (near && through && any(lessThan(abs(inside), reach))) hit.edge = true;
        if (here && through && t > 0.0 && all(greaterThanEqual(inside, vec2(0.0))))
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
