#include "host_stub/night_scene_shaders.h"

#include "host_stub/waves.h"

namespace seaglare::host {
namespace {

// The camera's response: photographic curve on luminance, hue kept, then 8-bit codes without bands.
constexpr const char* tone = R"glsl(
uniform float u_exposure;   // key / adaptation luminance, m2/cd
uniform float u_rods;       // weight of night vision, 0 by day
uniform int u_target;       // 0: sRGB values, 1: sRGB format, 2: linear

float hash(uvec2 p) {
    uint h = p.x * 0x9E3779B1u ^ p.y * 0x85EBCA77u;
    h ^= h >> 15; h *= 0x2C1B3C6Du; h ^= h >> 12; h *= 0x297A2D39u; h ^= h >> 15;
    return float(h >> 8) * (1.0 / 16777216.0);
}
vec3 srgb_from_linear(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-9)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
vec3 linear_from_srgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}
// cd/m2 to what the target stores. White is twice the adaptation luminance over the key.
vec4 host_colour(vec3 radiance) {
    const float white = 2.0;
    float y = max(dot(radiance, vec3(0.2126, 0.7152, 0.0722)), 1e-12);
    // By rods alone the world is grey with a tinge of blue; the tint has unit luminance.
    float rods = u_rods * 0.04 / (0.04 + y) ;
    vec3 hue = mix(radiance / y, vec3(0.90, 1.0, 1.29), 0.75 * rods);
    float r = u_exposure * y;
    float d = min(r * (1.0 + r / (white * white)) / (1.0 + r), 1.0);
    vec3 c = hue * d;
    c = max(c / max(1.0, max(c.r, max(c.g, c.b))), vec3(0.0));
    if (u_target == 2) return vec4(c, 1.0);
    // Triangular noise of one code to either side: the mean of the codes is the value, and no contour shows.
    uvec2 p = uvec2(gl_FragCoord.xy);
    vec3 n = vec3(hash(p) + hash(p + 7919u), hash(p + 104729u) + hash(p + 1299709u), hash(p + 15485863u) + hash(p + 32452843u)) - 1.0;
    vec3 coded = clamp(srgb_from_linear(c) + n / 255.0, 0.0, 1.0);
    return vec4(u_target == 1 ? linear_from_srgb(coded) : coded, 1.0);
}
)glsl";

constexpr const char* air = R"glsl(
uniform sampler2D u_sky;          // cd/m2 over azimuth and sqrt(elevation)
uniform vec2 u_sky_size;
uniform float u_extinction_per_m; // 3/V by Koschmieder's 5 % contrast; 0: clear

vec3 sky(vec3 direction) {
    float elevation = asin(clamp(direction.z, 0.0, 1.0)) * (2.0 / 3.14159265);
    float azimuth = atan(direction.x, direction.y) * (0.5 / 3.14159265);
    vec2 uv = vec2(azimuth + 0.5 / u_sky_size.x, (sqrt(elevation) * (u_sky_size.y - 1.0) + 0.5) / u_sky_size.y);
    return textureLod(u_sky, uv, 0.0).rgb;
}
// What is seen of `radiance` through `distance` of air that itself shines like the horizon behind it.
vec3 through_air(vec3 radiance, vec3 direction, float distance_m) {
    float clear = exp(-u_extinction_per_m * distance_m);
    return mix(sky(vec3(direction.xy, 0.0)), radiance, clear);
}
)glsl";

constexpr const char* backdrop = R"glsl(
uniform vec3 u_ray_origin, u_ray_x, u_ray_y;  // direction = origin + x * column + y * row, in pixels
uniform vec3 u_ahead;                          // unit view axis
uniform vec2 u_depth_terms;                    // clip_from_view [2][2] and [3][2]
uniform float u_eye_height_m, u_far_m, u_pixel_rad;
uniform vec4 u_wave[WAVE_COUNT];               // wave vector (rad/m), slope, phase at the eye
uniform float u_slope_variance, u_dome_lx;
uniform vec3 u_luminary[2];                    // directions of sun and moon
uniform vec2 u_luminary_light[2];              // disc luminance (cd/m2), normal illuminance (lx)
uniform vec3 u_luminary_colour[2];
uniform vec3 u_moon_lit_from;                  // direction from moon to sun
uniform mat3 u_stars_from_world;
uniform float u_star_gain;
out vec4 out_colour;

const float pi = 3.14159265;
const float disc_radius_rad = 0.00454;

// A random star field, not the real one: one star at most in each cell of a cube's faces, magnitudes such that their
// number grows by 10^0.5 per magnitude, 4500 of them to 6.5 in a hemisphere.
vec3 stars(vec3 direction) {
    vec3 d = u_stars_from_world * direction;
    vec3 a = abs(d);
    float face = a.x > a.y && a.x > a.z ? (d.x > 0.0 ? 0.0 : 1.0) : a.y > a.z ? (d.y > 0.0 ? 2.0 : 3.0) : (d.z > 0.0 ? 4.0 : 5.0);
    vec3 f = face < 2.0 ? vec3(d.yz, a.x) : face < 4.0 ? vec3(d.xz, a.y) : vec3(d.xy, a.z);
    const float cells = 64.0;
    vec2 uv = (f.xy / f.z * 0.5 + 0.5) * cells;
    uvec2 cell = uvec2(uv) + uvec2(face * 977.0, 0.0);
    if (hash(cell) > 0.37) return vec3(0.0);
    float magnitude = 6.5 + 2.0 * log2(max(hash(cell + 31u), 1e-4)) / log2(10.0);
    vec2 at = 0.25 + 0.5 * vec2(hash(cell + 57u), hash(cell + 91u));
    // Gaussian footprint of about a pixel, so that a turning picture does not twinkle.
    float sigma_rad = 0.75 * u_pixel_rad;
    vec2 off = (uv - uvec2(uv) - at) * (2.0 / cells) * (f.z * f.z);
    float density = exp(-dot(off, off) / (2.0 * sigma_rad * sigma_rad)) / (2.0 * pi * sigma_rad * sigma_rad);
    // Magnitude 0 is 2.54e-6 lx (Allen, Astrophysical Quantities); 0.25 magnitudes per air mass.
    float air_mass = 1.0 / (max(direction.z, 0.0) + 0.03);
    float warmth = hash(cell + 113u);
    vec3 hue = mix(vec3(1.25, 0.95, 0.70), vec3(0.85, 0.99, 1.5), warmth);
    return hue * 2.54e-6 * exp2(-1.3288 * (magnitude + 0.25 * air_mass)) * density;
}

vec3 disc(int i, vec3 direction) {
    vec3 l = u_luminary[i];
    vec3 off = direction - l;
    float r = length(off) / disc_radius_rad;
    float soft = 0.5 * u_pixel_rad / disc_radius_rad;
    float cover = 1.0 - smoothstep(1.0 - soft, 1.0 + soft, r);
    if (cover <= 0.0 || dot(direction, l) < 0.0) return vec3(0.0);
    if (i == 1) {  // phase: the lit side of a sphere
        vec3 n = off / disc_radius_rad;
        n = n - l * sqrt(max(0.0, 1.0 - dot(n, n)));
        cover *= smoothstep(-0.05, 0.15, dot(normalize(n), u_moon_lit_from));
    }
    return u_luminary_colour[i] * u_luminary_light[i].x * cover;
}

float fresnel(float cosine) { return 0.0204 + 0.9796 * pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0); }

vec3 sea(vec3 direction, float distance_m) {
    // Waves that the pixel resolves tilt the surface; the rest widens the reflection.
    vec2 along = normalize(direction.xy), across = vec2(-along.y, along.x);
    float down = max(-direction.z, 1e-5);
    float footprint_along = 0.6 * u_pixel_rad * distance_m / down, footprint_across = 0.6 * u_pixel_rad * distance_m;
    vec2 slope = vec2(0.0);
    float variance = u_slope_variance;
    vec2 at = direction.xy * distance_m;
    // Crests are not ruler-straight: long waves push the short ones about.
    vec2 bend = 0.7 * sin(at.yx * vec2(0.043, 0.061) + u_wave[0].w) + 0.2 * sin(at * vec2(0.31, 0.23) + u_wave[3].w);
    for (int i = 0; i < WAVE_COUNT; ++i) {
        vec2 k = u_wave[i].xy;
        float ka = dot(k, along) * footprint_along, kc = dot(k, across) * footprint_across;
        float seen = exp(-0.5 * (ka * ka + kc * kc));
        slope += normalize(k) * (u_wave[i].z * seen * cos(dot(k, at + bend) + u_wave[i].w));
        variance -= 0.25 * u_wave[i].z * u_wave[i].z * seen * seen;
    }
    float sigma = sqrt(max(variance, 1e-4));
    // Mean over facets, weighted by how much of each the eye sees: Gauss-Hermite nodes along the line of sight.
    const float node[5] = float[](-2.85697, -1.355626, 0.0, 1.355626, 2.85697);
    const float weight[5] = float[](0.011257, 0.222076, 0.533333, 0.222076, 0.011257);
    vec3 reflected = vec3(0.0);
    float seen_sum = 0.0;
    for (int i = 0; i < 5; ++i) {
        vec2 s = slope + along * (node[i] * sigma);
        vec3 n = normalize(vec3(-s, 1.0));
        float facing = -dot(direction, n);
        float w = weight[i] * max(facing, 0.0) / n.z;
        vec3 r = reflect(direction, n);
        reflected += w * fresnel(facing) * sky(vec3(r.xy, abs(r.z)));
        seen_sum += w;
    }
    reflected /= max(seen_sum, 1e-6);
    // Glitter: the facets that mirror sun or moon, Cox and Munk's p / (4 cos^4 tilt).
    for (int i = 0; i < 2; ++i) {
        if (u_luminary_light[i].y <= 0.0) continue;
        vec3 h = normalize(u_luminary[i] - direction);
        if (h.z <= 0.0) continue;
        vec2 off = -h.xy / h.z - slope;
        float p = exp(-dot(off, off) / (2.0 * sigma * sigma)) / (2.0 * pi * sigma * sigma);
        reflected += u_luminary_colour[i] * u_luminary_light[i].y * fresnel(dot(h, u_luminary[i])) * p /
                     (4.0 * h.z * h.z * h.z * h.z * max(seen_sum, 0.02));
    }
    // A little light comes back out of the water: reflectance 1.5 %, greenish.
    return reflected + vec3(0.55, 1.12, 1.1) * (0.015 * u_dome_lx / pi);
}

void main() {
    vec3 direction = normalize(u_ray_origin + u_ray_x * gl_FragCoord.x + u_ray_y * gl_FragCoord.y);
    float depth = 1.0;
    vec3 radiance;
    // The horizon's pixel is half sky, half sea.
    float below = clamp(0.5 - direction.z / u_pixel_rad, 0.0, 1.0);
    vec3 up = vec3(direction.xy, max(direction.z, 0.0));
    radiance = below < 1.0 ? sky(up) : vec3(0.0);
    if (below <= 0.0) {
        for (int i = 0; i < 2; ++i)
            radiance += disc(i, direction);
        if (u_star_gain > 0.0) radiance += u_star_gain * stars(direction);
    } else {
        vec3 d = normalize(vec3(direction.xy, min(direction.z, -0.25 * u_pixel_rad)));
        float distance_m = u_eye_height_m / -d.z;
        radiance = mix(radiance, through_air(sea(d, distance_m), d, distance_m), below);
        if (direction.z < 0.0) {
            float ahead = u_eye_height_m / -direction.z * dot(direction, u_ahead);
            if (ahead < u_far_m) depth = ((u_depth_terms.x * -ahead + u_depth_terms.y) / ahead) * 0.5 + 0.5;
        }
    }
    gl_FragDepth = clamp(depth, 0.0, 1.0);
    out_colour = host_colour(radiance);
}
)glsl";

constexpr const char* land = R"glsl(
uniform float u_dome_lx;
uniform vec3 u_dome_colour;
uniform vec3 u_luminary[2];
uniform vec2 u_luminary_light[2];
uniform vec3 u_luminary_colour[2];
in vec3 v_from_eye;
in float v_albedo;
out vec4 out_colour;

void main() {
    vec3 n = normalize(cross(dFdx(v_from_eye), dFdy(v_from_eye)));
    if (dot(n, v_from_eye) > 0.0) n = -n;
    float distance_m = length(v_from_eye);
    // A slope sees the part of the dome above it.
    vec3 light = u_dome_colour * u_dome_lx * (0.5 + 0.5 * n.z);
    for (int i = 0; i < 2; ++i)
        light += u_luminary_colour[i] * u_luminary_light[i].y * max(dot(n, u_luminary[i]), 0.0);
    vec3 radiance = v_albedo / 3.14159265 * light;
    out_colour = host_colour(through_air(radiance, v_from_eye / distance_m, distance_m));
}
)glsl";

std::string with_waves(const char* text) {
    return "#version 330 core\n#define WAVE_COUNT " + std::to_string(wave_count) + "\n" + text;
}

}  // namespace

std::string backdrop_vertex_shader() {
    return R"glsl(#version 330 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)glsl";
}

std::string backdrop_fragment_shader() {
    return with_waves((std::string(tone) + air + backdrop).c_str());
}

std::string land_vertex_shader() {
    return R"glsl(#version 330 core
uniform mat4 u_clip_from_offset;  // from world axes with the origin at the eye
uniform vec3 u_eye_m;
layout(location = 0) in vec3 position_m;
layout(location = 1) in float albedo;
out vec3 v_from_eye;
out float v_albedo;
void main() {
    v_from_eye = position_m - u_eye_m;
    v_albedo = albedo;
    gl_Position = u_clip_from_offset * vec4(v_from_eye, 1.0);
}
)glsl";
}

std::string land_fragment_shader() {
    return with_waves((std::string(tone) + air + land).c_str());
}

}  // namespace seaglare::host
