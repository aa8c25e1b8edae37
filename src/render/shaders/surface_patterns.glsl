// What is painted on planes and boxes. CHECKER, GRID, WOOD and COURT are defined where the scene has
// such, and PATTERNED with any of them.
//
// Every pattern is filtered over the pixel: uv is the point [m], extent how far it reaches across a
// pixel along both axes. What is finer than a pixel melts into its mean.

const float kCheckerStyle = 1.0, kGridStyle = 2.0, kWoodStyle = 3.0, kCourtStyle = 4.0;

#ifdef CHECKER
// Integral of a checker of period 2 over a box of width w around x, -1 ... 1.
float filtered_wave(float x, float w) {
    vec2 ends = fract(vec2(x - 0.5 * w, x + 0.5 * w) * 0.5) - 0.5;
    return 2.0 * (abs(ends.x) - abs(ends.y)) / w;
}

#endif

#if defined(GRID) || defined(WOOD) || defined(COURT)
// Part of a box of width w around x that lies on lines of the given width around the integers.
float filtered_lines(float x, float w, float line) {
    vec2 ends = vec2(x - 0.5 * w, x + 0.5 * w) + 0.5 * line;
    vec2 covered = floor(ends) * line + min(fract(ends), line);
    return (covered.y - covered.x) / w;
}
#endif

#if defined(WOOD) || defined(COURT)
// The same for all drivers: 0 ... 1 from two whole numbers.
float hashed(float a, float b) {
    uint h = uint(int(a)) * 0x9e3779b9u ^ (uint(int(b)) + 0x7f4a7c15u) * 0x85ebca6bu;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return float((h ^ (h >> 15)) >> 8) / 16777216.0;
}

// A sine of frequency f, seen through a pixel of width w: a box's filter as a Gaussian one.
float filtered_sine(float x, float f, float w) {
    float reach = 3.14159265 * f * w;
    return sin(6.2831853 * f * x) * exp(-reach * reach / 6.0);
}

// Streaks along a plank, -1 ... 1 or so; x across and y along it, in widths of a plank.
float grain(vec2 x, vec2 w, float seed) {
    float a = 0.62 * x.y + 40.0 * seed, b = 0.23 * x.y + 91.0 * seed;
    float s = 3.1 * x.x + 0.30 * sin(a) + 0.55 * sin(b);
    float slope = 0.30 * 0.62 * cos(a) + 0.55 * 0.23 * cos(b);
    float width = length(vec2(3.1 * w.x, slope * w.y));
    return 0.50 * filtered_sine(s, 1.0, width) + 0.30 * filtered_sine(s + 0.31, 2.7, width) +
           0.20 * filtered_sine(s + 0.17, 6.1, width);
}

// Planks of width 1 along y, their ends at a different place in every row. `contrast` is how far
// their tones differ.
vec3 planks(vec2 x, vec2 w, vec3 light, vec3 dark, float contrast) {
    const float kLength = 11.0, kGap = 0.022;
    const float kMeanTone = 0.36;
    float tone = 0.0, gap = 0.0, all = 0.0;
    float first = floor(x.x - 0.5 * w.x), last = min(floor(x.x + 0.5 * w.x), first + 2.0);
    float row = first;
    do {
        float part = min(row + 1.0, x.x + 0.5 * w.x) - max(row, x.x - 0.5 * w.x);
        float y = x.y / kLength + hashed(row, -7.0), wy = w.y / kLength;
        float begin = floor(y - 0.5 * wy);
        float later = clamp((y + 0.5 * wy - (begin + 1.0)) / wy, 0.0, 1.0);
        float one = hashed(row, begin), other = hashed(row, begin + 1.0);
        float mine = floor(y) == begin ? one : other;
        tone += part * (mix(one, other, later) - 0.5 + 0.42 * grain(x - vec2(row, 0.0), w, mine));
        gap += part * filtered_lines(y, wy, kGap / kLength);
        all += part;
    } while (++row <= last);
    // More than two rows or planks in a pixel: their mean.
    float melt = max(smoothstep(1.0, 2.0, w.x), smoothstep(0.6, 1.5, w.y / kLength));
    tone = kMeanTone + contrast * (1.0 - melt) * tone / max(all, 1e-6);
    gap = mix(gap / max(all, 1e-6), kGap / kLength, smoothstep(1.0, 2.0, w.x));
    gap = 1.0 - (1.0 - gap) * (1.0 - filtered_lines(x.x, w.x, kGap));
    return mix(mix(light, dark, clamp(tone, 0.0, 1.0)), 0.30 * dark, 0.8 * gap);
}
#endif

#ifdef COURT
// Part of the pixel in which f > 0, where f is that at its middle and g how it changes from pixel to
// pixel along x and y.
float half_plane(float f, vec2 g) {
    float a = max(max(abs(g.x), abs(g.y)), 1e-6), b = max(min(abs(g.x), abs(g.y)) / a, 1e-3);
    float x = clamp(f / a, -1.0, 1.0);
    vec4 ends = max(vec4(x) + 0.5 * vec4(1.0 + b, 1.0 - b, b - 1.0, -1.0 - b), 0.0);
    ends *= ends;
    return clamp((ends.x - ends.y - ends.z + ends.w) / (2.0 * b), 0.0, 1.0);
}
// The same for |f| below half a line's width.
float line_at(float f, vec2 g) {
    const float kHalf = 0.025;
    return half_plane(f + kHalf, g) - half_plane(f - kHalf, g);
}
float ring_at(vec2 p, float radius, mat2 step) {
    float r = max(length(p), 1e-3);
    return line_at(r - radius, (p / r) * step);
}

// The lines of a basketball court (FIBA, Official Basketball Rules 2022, 2.4), 5 cm wide, its
// length along x, its middle at the origin; metres. The columns of `step` are how p moves from
// pixel to pixel along x and y.
float court_lines(vec2 p, mat2 step) {
    vec2 a = abs(p), along = p.x < 0.0 ? vec2(-1, 0) * step : vec2(1, 0) * step;
    vec2 across = p.y < 0.0 ? vec2(0, -1) * step : vec2(0, 1) * step;
    mat2 folded = transpose(mat2(along, across));
    float in_court = half_plane(14.0 - a.x, along);
    // Half-way line, centre circle, side lines, end lines.
    float open = 1.0 - line_at(p.x, along) * half_plane(7.65 - a.y, across);
    open *= 1.0 - ring_at(p, 1.775, step);
    open *= 1.0 - line_at(a.y - 7.525, across) * half_plane(14.05 - a.x, along);
    open *= 1.0 - line_at(a.x - 14.025, along) * half_plane(7.55 - a.y, across);
    // Restricted area, free-throw line and its half circle.
    open *= 1.0 - line_at(a.y - 2.425, across) * in_court * half_plane(a.x - 8.2, along);
    open *= 1.0 - line_at(a.x - 8.225, along) * half_plane(2.45 - a.y, across);
    open *= 1.0 - ring_at(a - vec2(8.2, 0.0), 1.775, folded) * half_plane(8.2 - a.x, along);
    // Three points: an arc around the basket, then parallel to the side lines.
    open *= 1.0 - line_at(a.y - 6.575, across) * in_court * half_plane(a.x - 11.013, along);
    open *= 1.0 - ring_at(a - vec2(12.425, 0.0), 6.725, folded) * half_plane(11.013 - a.x, along);
    return 1.0 - open;
}
#endif

#ifdef PATTERNED
// The colour of a surface, whose record's slots 4 and 5 are `first` and `second`, at the pattern
// coordinate uv [m]; the columns of `step` are how uv moves from pixel to pixel along x and y.
vec3 pattern(vec4 first, vec4 second, vec2 uv, mat2 step) {
    vec2 extent = vec2(length(vec2(step[0].x, step[1].x)), length(vec2(step[0].y, step[1].y)));
    vec2 x = uv / second.w, w = max(extent / second.w, 1e-5);
#ifdef WOOD
    if (first.w == kWoodStyle) return planks(x, w, first.rgb, second.rgb, 0.62);
#endif
#ifdef COURT
    if (first.w == kCourtStyle) {
        vec3 strips = planks(x.yx, w.yx, first.rgb, 0.62 * first.rgb, 0.40);
        return mix(strips, second.rgb, court_lines(uv, step));
    }
#endif
#if defined(CHECKER) || defined(GRID)
    // Beyond a few squares a pixel, a box filter still leaves moire: melt into the mean.
    float melt = smoothstep(0.6, 2.0, max(w.x, w.y));
    float part = 0.0;
#ifdef CHECKER
    if (first.w == kCheckerStyle) {
        part = 0.5 - 0.5 * filtered_wave(x.x, w.x) * filtered_wave(x.y, w.y);
        part = mix(part, 0.5, melt);
    }
#endif
#ifdef GRID
    if (first.w == kGridStyle) {
        const float kLine = 0.024;
        float off = (1.0 - filtered_lines(x.x, w.x, kLine)) * (1.0 - filtered_lines(x.y, w.y, kLine));
        part = mix(1.0 - off, 1.0 - (1.0 - kLine) * (1.0 - kLine), melt);
    }
#endif
    return mix(first.rgb, second.rgb, part);
#else
    return first.rgb;
#endif
}
#endif

// Of the whole, where a surface is cut open.
vec3 mean_color(int item) {
    vec4 first = surface(item, 4);
    bool both = first.w > 0.0 && first.w != kCourtStyle;
    return both ? 0.5 * (first.rgb + surface(item, 5).rgb) : first.rgb;
}
