// The markings of a ball over its longitude and latitude: column x of n is the longitude
// 2 pi (x + 1/2) / n - pi, row y of m the latitude pi/2 - pi (y + 1/2) / m.
uniform vec2 u_size;
out vec4 out_color;

void main() {
    const float kPi = 3.14159265;
    float longitude = 2.0 * kPi * gl_FragCoord.x / u_size.x - kPi;
    float latitude = 0.5 * kPi - kPi * gl_FragCoord.y / u_size.y;
    vec2 east = vec2(cos(longitude), sin(longitude)), up = vec2(cos(latitude), sin(latitude));
    vec3 p = vec3(up.x * east, up.y);
    vec3 px = 2.0 * kPi / u_size.x * up.x * vec3(-east.y, east.x, 0.0);
    vec3 py = -kPi / u_size.y * vec3(-up.y * east, up.x);
    vec2 gloss;
    out_color = vec4(marking(p, px, py, gloss), 1.0);
}
