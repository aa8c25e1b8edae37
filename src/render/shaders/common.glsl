// Shared by all fragment shaders: the pixel's ray, the light, the sky.
//
// View space: the eye is the origin, x to the right, y down, z forward, metres. Framebuffer row 0 is
// the top row of the picture, so gl_FragCoord counts down like y. A ray is r(t) = start + t d with
// d.z = 1, so that t is the depth along the view axis; start is the eye, and with ORTHOGRAPHIC the
// pixel's own place on the plane z = 0. Colours are linear; the framebuffer encodes sRGB, for the
// background the shader.

uniform vec2 u_center;    // middle of the picture, pixels
uniform float u_pixel;    // width of a pixel on the plane z = 1, or everywhere
uniform vec3 u_up;        // world z, unit
uniform vec3 u_light;     // towards the key light, unit
uniform float u_light_tan;  // tangent of the key light's angular radius

// Irradiance / pi of each light: a white body under all of them stays below 1.
const vec3 kKey = vec3(0.70, 0.68, 0.645);
const vec3 kSkyLight = vec3(0.33, 0.355, 0.39);
const vec3 kGroundLight = vec3(0.235, 0.225, 0.215);
const vec3 kHorizon = vec3(0.79, 0.80, 0.805);
const vec3 kZenith = vec3(0.42, 0.54, 0.665);
const vec3 kNadir = vec3(0.60, 0.61, 0.62);

#ifdef ORTHOGRAPHIC
vec3 ray_through(vec2 pixel) { return vec3(0.0, 0.0, 1.0); }
vec3 ray_start(vec2 pixel) { return vec3((pixel - u_center) * u_pixel, 0.0); }
float pixel_at(float depth) { return u_pixel; }
#else
vec3 ray_through(vec2 pixel) { return vec3((pixel - u_center) * u_pixel, 1.0); }
vec3 ray_start(vec2 pixel) { return vec3(0.0); }
float pixel_at(float depth) { return depth * u_pixel; }
#endif

// Light of sky above and of lit ground below, for a surface with normal n.
vec3 ambient_light(vec3 n) { return mix(kGroundLight, kSkyLight, 0.5 + 0.5 * dot(n, u_up)); }

vec3 background(vec3 d) {
    float up = dot(d, u_up) * inversesqrt(dot(d, d));
    return up > 0.0 ? mix(kHorizon, kZenith, smoothstep(0.0, 0.62, up))
                    : mix(kHorizon, kNadir, smoothstep(0.0, 0.6, -up));
}

// Part of its light that a surface mirrors, seen at the angle whose cosine is given: after Schlick,
// An inexpensive BRDF model (1994), gentler near the grazing angle.
float mirrored_share(float strength, float cosine) {
    float away = 1.0 - clamp(cosine, 0.0, 1.0);
    float away2 = away * away;
    return strength * (0.06 + 0.84 * away2 * away2);
}

// Part of the key light that a ball hides from a point: the ball's centre lies `along` towards the
// light and `across` from the line to it; the penumbra widens with the distance. `blur` is a pixel's
// width there, so that the shadow of a far ball does not alias.
float hidden_by_ball(float along, float across, float radius, float blur) {
    float spread = max(along, 0.0) * u_light_tan;
    float width = sqrt(spread * spread + blur * blur) + 1e-6 * radius;
    float covered = smoothstep(-width, width, radius - across);
    // A ball that looks smaller than the light never hides all of it.
    return covered * min(1.0, radius * radius / (spread * spread + 1e-12));
}
