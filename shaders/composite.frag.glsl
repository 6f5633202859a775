// HDR glare and coarse tail to what is added to the host's pixel.
uniform sampler2D hdr;
uniform sampler2D coarse;
uniform sampler2D background;
uniform int background_bottom;  // the row of the viewport that its first is
uniform int hdr_first_row;      // and that of `hdr`
uniform float cell_px;         // of the coarse grid; 0: there is none
uniform ivec2 viewport_origin;
uniform int encoding;          // 0 sRGB values, 1 sRGB format, 2 linear
uniform float dither_step;     // one code of the target; 0: no dither
out vec4 added;

vec4 coarse_at(vec2 px) {
    vec2 at = px / cell_px;
    ivec2 i = ivec2(floor(at));
    vec2 t = at - vec2(i);
    return mix(mix(texelFetch(coarse, i, 0), texelFetch(coarse, i + ivec2(1, 0), 0), t.x),
               mix(texelFetch(coarse, i + ivec2(0, 1), 0), texelFetch(coarse, i + ivec2(1, 1), 0), t.x), t.y);
}

// A number in 0 ... 1 that depends on the pixel alone, evenly spread among neighbours (Jimenez 2014): the picture
// stands still while nothing changes.
vec3 pixel_noise(vec2 px) {
    vec3 along = vec3(dot(px, vec2(0.06711056, 0.00583715)), dot(px + 23.7, vec2(0.06711056, 0.00583715)),
                      dot(px + 61.3, vec2(0.06711056, 0.00583715)));
    return fract(52.9829189 * fract(along));
}

// Moves a stored value by less than half a code, and by less than itself, so that a pixel that glare reaches with less
// than a quarter of a code is never lit by the dither alone.
vec3 dithered(vec3 step_stored, vec2 px) {
    vec3 amplitude = min(step_stored, vec3(0.5 * dither_step));
    return step_stored + (pixel_noise(px) * 2.0 - 1.0) * amplitude;
}

void main() {
    ivec2 px = ivec2(gl_FragCoord.xy) - viewport_origin;
    vec4 glare = texelFetch(hdr, px - ivec2(0, hdr_first_row), 0);
    if (cell_px > 0.0) glare += coarse_at(vec2(px) + 0.5);
    // Unlit pixels keep every bit; a NaN fails the comparison and is unlit.
    if (!(dot(abs(glare), vec4(1.0)) > 0.0)) discard;
    glare = clamp(glare, vec4(-1e18), vec4(1e18));

    vec3 stored = texelFetch(background, px - ivec2(0, background_bottom), 0).rgb;
    // An sRGB texture decodes itself.
    vec3 before = encoding == 0 ? srgb_decode(stored) : max(stored, vec3(0.0));
    vec3 delta = display_delta(before, glare.rgb, glare.a);
    if (encoding == 0) {
        vec3 step_stored = max(vec3(0.0), srgb_encode(before + delta) - clamp(stored, 0.0, 1.0));
        added = vec4(dithered(step_stored, gl_FragCoord.xy), 0.0);
    } else if (encoding == 1 && dither_step > 0.0) {
        vec3 code = srgb_encode(before);
        vec3 step_stored = max(vec3(0.0), srgb_encode(before + delta) - code);
        added = vec4(max(vec3(0.0), srgb_decode(code + dithered(step_stored, gl_FragCoord.xy)) - before), 0.0);
    } else {
        added = vec4(dithered(delta, gl_FragCoord.xy), 0.0);
    }
}
