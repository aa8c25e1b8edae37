// What is painted on a ball. STRIPED, BASKETBALL and so on are defined for the styles that a program
// draws; SEVERAL_STYLES where it is more than one.
//
// p is a point of the unit sphere in the ball's own axes; px and py are how far p moves from pixel to
// pixel. Every border is a function f of p that is 0 there; f / (extent of f in a pixel) is its
// distance in pixels, from which follows the part of the pixel on either side. So a marking fades
// into its mean colour with distance, and never flickers.

flat in vec3 v_color;   // the look's main colour
flat in vec3 v_second;  // its second one

// How far a function with gradient g reaches across a pixel (the width of a box of equal variance).
#ifdef SWEPT
vec3 g_moved = vec3(0.0);  // how far p moves while the shutter is open: one more way to reach
float extent(vec3 g, vec3 px, vec3 py) {
    return length(vec3(dot(g, px), dot(g, py), dot(g, g_moved))) + 1e-6;
}
float extent_of_all(vec3 px, vec3 py) {
    return length(vec3(length(px), length(py), length(g_moved)));
}
#else
float extent(vec3 g, vec3 px, vec3 py) {
    return length(vec2(dot(g, px), dot(g, py))) + 1e-6;
}
float extent_of_all(vec3 px, vec3 py) { return length(vec2(length(px), length(py))); }
#endif

// Part of the pixel where f > 0; where |f| < half_width.
float above(float f, float width) { return clamp(f / width + 0.5, 0.0, 1.0); }
float band(float f, float half_width, float width) {
    return above(f + half_width, width) - above(f - half_width, width);
}

// The same for a curved border: f is scaled to be a distance along the sphere.
float curve(float f, vec3 gradient, float half_width, vec3 p, vec3 px, vec3 py) {
    vec3 g = gradient - p * dot(gradient, p);
    float steepness = max(length(g), 1e-4);
    return band(f / steepness, half_width, extent(g / steepness, px, py));
}

// A round spot of the given angular radius (its chord, for small spots) around `center`.
float spot(vec3 p, vec3 center, float radius, vec3 px, vec3 py) {
    vec3 off = p - center;
    float d = length(off);
    return above(radius - d, extent(off / max(d, 1e-4), px, py));
}

#ifdef STRIPED
// A broad band, and a narrow one across it, so that no axis of spin goes unseen.
vec3 striped(vec3 p, vec3 px, vec3 py) {
    float broad = band(p.x, 0.27, extent(vec3(1, 0, 0), px, py));
    float narrow = band(p.z, 0.07, extent(vec3(0, 0, 1), px, py));
    return mix(v_color, v_second, max(broad, narrow));
}
#endif  // STRIPED

#ifdef BASKETBALL
// Eight panels: two great circles that cross, and on either side a closed oval seam. The oval
// |x| = 0.47 + 0.6 z^2 reaches 62 degrees from the pole of x along the equator and 42 towards z, as
// on the balls of the trade.
vec3 basketball(vec3 p, vec3 px, vec3 py) {
    const float kSeam = 0.021;  // half width, radians: 5 mm on a ball of 12 cm
    float seam = max(band(p.z, kSeam, extent(vec3(0, 0, 1), px, py)),
                     band(p.x, kSeam, extent(vec3(1, 0, 0), px, py)));
    float side = p.x < 0.0 ? -1.0 : 1.0;
    vec3 gradient = vec3(side, 0.0, -1.2 * p.z);
    seam = max(seam, curve(abs(p.x) - 0.47 - 0.6 * p.z * p.z, gradient, kSeam, p, px, py));

    // Pebbles: a fine relief, gone before it would flicker.
    const float kPebbles = 95.0;
    float fine = kPebbles * extent_of_all(px, py);
    float fade = clamp(1.6 - fine, 0.0, 1.0);
    float relief = sin(p.x * kPebbles) * sin(p.y * kPebbles) * sin(p.z * kPebbles);
    vec3 leather = v_color * (1.0 + 0.16 * fade * relief);
    return mix(leather, v_second, seam);
}
#endif  // BASKETBALL

#ifdef VOLLEYBALL
// 18 panels: six faces of three strips, the strips of neighbouring faces across one another. The
// middle strip of a face has the main colour, the outer ones the second colour and yellow.
const vec3 kYellow = vec3(0.85, 0.52, 0.035);

// The strips of the face around +-x, where `across` runs over the strips; `facing` is |x|.
vec3 face(float across, vec3 gradient, float facing, vec3 gradient_facing, vec3 px, vec3 py,
          inout float seam) {
    const float kThird = 0.267949;  // tan(15 degrees): strips of equal angle
    float upper = across - kThird * facing, lower = across + kThird * facing;
    float width_upper = extent(gradient - kThird * gradient_facing, px, py);
    float width_lower = extent(gradient + kThird * gradient_facing, px, py);
    const float kSeam = 0.010;
    seam = max(band(upper, kSeam, width_upper), band(lower, kSeam, width_lower));
    return mix(mix(v_second, v_color, above(lower, width_lower)), kYellow,
               above(upper, width_upper));
}

// Face k (0 x, 1 y, 2 z) of p: its strips lie across the next axis.
vec3 face_of(int k, vec3 p, vec3 px, vec3 py, out float seam) {
    vec3 axis = k == 0 ? vec3(1, 0, 0) : (k == 1 ? vec3(0, 1, 0) : vec3(0, 0, 1));
    vec3 next = axis.zxy;
    float sign_facing = dot(p, axis) < 0.0 ? -1.0 : 1.0;
    return face(dot(p, next), next, abs(dot(p, axis)), sign_facing * axis, px, py, seam);
}

vec3 volleyball(vec3 p, vec3 px, vec3 py) {
    vec3 a = abs(p);
    int first = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    float second_a = first == 0 ? max(a.y, a.z) : (first == 1 ? max(a.x, a.z) : max(a.x, a.y));
    int second = first != 0 && a.x == second_a ? 0 : (first != 1 && a.y == second_a ? 1 : 2);
    float seam = 0.0, other_seam = 0.0;
    vec3 color = face_of(first, p, px, py, seam);
    vec3 other = face_of(second, p, px, py, other_seam);

    // The border of two faces is the great circle |a| = |b|.
    vec3 sign_p = vec3(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0, p.z < 0.0 ? -1.0 : 1.0);
    vec3 axis_1 = first == 0 ? vec3(1, 0, 0) : (first == 1 ? vec3(0, 1, 0) : vec3(0, 0, 1));
    vec3 axis_2 = second == 0 ? vec3(1, 0, 0) : (second == 1 ? vec3(0, 1, 0) : vec3(0, 0, 1));
    vec3 gradient = (axis_1 - axis_2) * sign_p * 0.70710678;
    float f = dot(gradient, p);
    float width = extent(gradient, px, py);
    float mine = above(f, width);
    color = mix(other, color, mine);
    seam = max(mix(other_seam, seam, mine), band(f, 0.012, width));
    return color * (1.0 - 0.72 * seam);
}
#endif  // VOLLEYBALL

#ifdef FOOTBALL
// Truncated icosahedron: 12 pentagons in the second colour, 20 hexagons in the first. On the sphere
// its edges are great circles: the border of two hexagons lies midway between their centres f, that
// of a hexagon and a pentagon where p . (f - k v) = 0, v the pentagon's centre. p is folded into
// x, y, z > 0; there seven hexagons and three pentagons can be the nearest.
void nearer(vec3 f, vec3 p, inout vec3 first, inout float best, inout vec3 second,
            inout float next) {
    float x = dot(f, p);
    bool wins = x > best;
    second = wins ? first : (x > next ? f : second);
    next = wins ? best : max(next, x);
    first = wins ? f : first;
    best = max(best, x);
}

vec3 football(vec3 p, vec3 px, vec3 py) {
    const float g = 1.6180339887, s = 0.57735026919;  // golden section, 1 / sqrt(3)
    const float a = 0.52573111212, b = 0.85065080835;  // 1 and g over sqrt(1 + g^2)
    const float k = 0.97415421;  // the edge of the solid lies at this ratio of the two projections
    vec3 fold = vec3(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0, p.z < 0.0 ? -1.0 : 1.0);
    p *= fold;
    px *= fold;
    py *= fold;
#ifdef SWEPT
    vec3 moved = g_moved;
    g_moved *= fold;
#endif

    vec3 first = vec3(s), second = vec3(0.0);
    float best = dot(first, p), next = -1.0;
    nearer(vec3(0.0, s * g, s / g), p, first, best, second, next);
    nearer(vec3(s / g, 0.0, s * g), p, first, best, second, next);
    nearer(vec3(s * g, s / g, 0.0), p, first, best, second, next);
    nearer(vec3(0.0, s * g, -s / g), p, first, best, second, next);
    nearer(vec3(-s / g, 0.0, s * g), p, first, best, second, next);
    nearer(vec3(s * g, -s / g, 0.0), p, first, best, second, next);

    vec3 v = vec3(0.0, a, b);
    if (dot(vec3(b, 0.0, a), p) > dot(v, p)) v = vec3(b, 0.0, a);
    if (dot(vec3(a, b, 0.0), p) > dot(v, p)) v = vec3(a, b, 0.0);

    vec3 g_black = k * v - first, g_seam = first - second;
    g_black /= length(g_black);
    g_seam /= max(length(g_seam), 1e-4);
    float black = above(dot(g_black, p), extent(g_black, px, py));
    float seam = band(dot(g_seam, p), 0.013, extent(g_seam, px, py)) * (1.0 - black);
    float rim = band(dot(g_black, p), 0.013, extent(g_black, px, py));
#ifdef SWEPT
    g_moved = moved;  // for other styles
#endif
    vec3 grey = mix(v_color, v_second, 0.72);
    return mix(mix(v_color, grey, max(seam, rim * 0.8)), v_second, black);
}
#endif  // FOOTBALL

#ifdef TENNIS
// Felt, and one closed curve: z = 2.1 (y^2 - x^2) on the sphere, which winds as the seam does.
vec3 tennis(vec3 p, vec3 px, vec3 py) {
    const float kBend = 2.1;
    float f = p.z + kBend * (p.x * p.x - p.y * p.y);
    vec3 gradient = vec3(2.0 * kBend * p.x, -2.0 * kBend * p.y, 1.0);
    float line = curve(f, gradient, 0.055, p, px, py);

    const float kFibres = 60.0;
    float fine = kFibres * extent_of_all(px, py);
    float fade = clamp(1.6 - fine, 0.0, 1.0);
    float felt = sin(p.x * kFibres + 4.0 * p.y) * sin(p.y * kFibres + 5.0 * p.z) *
                 sin(p.z * kFibres + 3.0 * p.x);
    return mix(v_color * (1.0 + 0.10 * fade * felt), v_second, line);
}
#endif  // TENNIS

#ifdef TABLE_TENNIS
// A maker's mark on two sides: three dots over a bar.
vec3 table_tennis(vec3 p, vec3 px, vec3 py) {
    vec3 q = vec3(abs(p.x), p.y, p.z);
    vec3 qx = vec3(p.x < 0.0 ? -px.x : px.x, px.yz), qy = vec3(p.x < 0.0 ? -py.x : py.x, py.yz);
#ifdef SWEPT
    vec3 moved = g_moved;
    g_moved.x = p.x < 0.0 ? -moved.x : moved.x;
#endif
    float mark = spot(q, normalize(vec3(1.0, 0.0, 0.26)), 0.115, qx, qy);
    mark = max(mark, spot(q, normalize(vec3(1.0, 0.30, 0.26)), 0.115, qx, qy));
    mark = max(mark, spot(q, normalize(vec3(1.0, -0.30, 0.26)), 0.115, qx, qy));
    float bar = band(q.y, 0.42, extent(vec3(0, 1, 0), qx, qy)) *
                band(q.z + 0.13, 0.085, extent(vec3(0, 0, 1), qx, qy)) *
                above(q.x, extent(vec3(1, 0, 0), qx, qy));
#ifdef SWEPT
    g_moved = moved;
#endif
    return mix(v_color, v_second, max(mark, bar));
}
#endif  // TABLE_TENNIS

#ifdef SEVERAL_STYLES
flat in float v_style;  // the number of a LookStyle (scene/scene.h)
#define HAS_STYLE(number) (v_style == float(number))
#else
#define HAS_STYLE(number) true
#endif

#define MARK(number, drawn, shine) if (HAS_STYLE(number)) { gloss = shine; color = drawn(p, px, py); }

// The colour at p; `gloss` is exponent and strength of the highlight.
vec3 marking(vec3 p, vec3 px, vec3 py, out vec2 gloss) {
    gloss = vec2(48.0, 0.10);
    vec3 color = v_color;
#ifdef STRIPED
    MARK(1, striped, vec2(48.0, 0.10))
#endif
#ifdef BASKETBALL
    MARK(2, basketball, vec2(14.0, 0.05))
#endif
#ifdef VOLLEYBALL
    MARK(3, volleyball, vec2(24.0, 0.06))
#endif
#ifdef FOOTBALL
    MARK(4, football, vec2(32.0, 0.08))
#endif
#ifdef TENNIS
    MARK(5, tennis, vec2(4.0, 0.0))
#endif
#ifdef TABLE_TENNIS
    MARK(6, table_tennis, vec2(36.0, 0.08))
#endif
    return color;
}
