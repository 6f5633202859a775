// HDR glare and coarse tail to what is added to the host's pixel. Software rasterisers compute every branch of every pixel:
// what a frame does not need is left out when the program is compiled.
//   ADDS   0 codes, to a target of sRGB values; 1 light, to an sRGB format, moved by the dither; 2 light
//   GRID   1: the far tails are on a coarse grid
uniform sampler2D hdr;
uniform sampler2D coarse;
uniform sampler2D background;
uniform int background_bottom;  // the row of the viewport that its first is
uniform int hdr_first_row;      // and that of `hdr`
uniform float cell_px;          // of the coarse grid
uniform ivec2 viewport_origin;
uniform float dither_step;      // one code of the target; 0: no dither
out vec4 added;

#if GRID
vec4 coarse_at(vec2 px) {
    vec2 at = px / cell_px;
    ivec2 i = ivec2(floor(at));
    vec2 t = at - vec2(i);
    return mix(mix(texelFetch(coarse, i, 0), texelFetch(coarse, i + ivec2(1, 0), 0), t.x),
               mix(texelFetch(coarse, i + ivec2(0, 1), 0), texelFetch(coarse, i + ivec2(1, 1), 0), t.x), t.y);
}
#endif

// A number in -1 ... 1 that depends on the pixel alone, evenly spread among neighbours (Jimenez 2014): the picture
// stands still while nothing changes.
vec3 pixel_noise(vec2 px) {
    vec3 along = vec3(dot(px, vec2(0.06711056, 0.00583715)), dot(px + 23.7, vec2(0.06711056, 0.00583715)),
                      dot(px + 61.3, vec2(0.06711056, 0.00583715)));
    return fract(52.9829189 * fract(along)) * 2.0 - 1.0;
}

// Moves what is added by less than half a code, and by less than itself, so that a pixel that glare reaches with less
// than a quarter of a code is never lit by the dither alone.
vec3 dithered(vec3 more, vec3 code) {
    return more + pixel_noise(gl_FragCoord.xy) * min(more, 0.5 * code);
}

void main() {
    ivec2 px = ivec2(gl_FragCoord.xy) - viewport_origin;
    vec4 glare = texelFetch(hdr, px - ivec2(0, hdr_first_row), 0);
#if GRID
    glare += coarse_at(vec2(px) + 0.5);
#endif
    // Unlit pixels keep every bit; a NaN fails the comparison and is unlit.
    if (!(dot(abs(glare), vec4(1.0)) > 0.0)) discard;
    glare = clamp(glare, vec4(-1e18), vec4(1e18));

    vec3 stored = texelFetch(background, px - ivec2(0, background_bottom), 0).rgb;
#if ADDS == 0
    vec3 before = srgb_decode(stored);
    vec3 code = srgb_encode(before + display_delta(before, glare));
    added = vec4(dithered(max(vec3(0.0), code - clamp(stored, 0.0, 1.0)), vec3(dither_step)), 0.0);
#else
    // An sRGB texture decodes itself.
    vec3 before = max(stored, vec3(0.0));
    vec3 delta = display_delta(before, glare);
#if ADDS == 1
    added = vec4(dithered(delta, dither_step * srgb_slope(before + delta)), 0.0);
#else
    added = vec4(dithered(delta, vec3(dither_step)), 0.0);
#endif
#endif
}
