// The tone curve; glare/tone/operators.h has the same in double precision, with its sources.
uniform float tone_scale;            // relative luminance per cd/m2
uniform float tone_inverse_white2;
uniform float ldr_white;             // cd/m2 of a host pixel of 1; 0: the inverse of our own curve
uniform bool blue_shift;
uniform bool difference_mode;

const float overload_white = 0.03;
const float d65_scotopic_ratio = 2.464;
const vec3 rod_tint = vec3(1.05, 0.97, 1.27) / 1.0087;

float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

vec3 srgb_encode(vec3 linear) {
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec3 srgb_decode(vec3 encoded) {
    vec3 c = clamp(encoded, 0.0, 1.0);
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

float tone_map(float cd_m2) {
    float relative = clamp(tone_scale * cd_m2, 0.0, 1e15);
    return relative * (1.0 + relative * tone_inverse_white2) / (1.0 + relative);
}

float inverse_tone_map(float display) {
    float y = clamp(display, 0.0, 1.0);
    float rest = 1.0 - y;
    return y > 0.0 ? 2.0 * y / (rest + sqrt(rest * rest + 4.0 * y * tone_inverse_white2)) / tone_scale : 0.0;
}

vec3 blue_shifted(vec3 glare, float scotopic, float background_luminance) {
    float rods = 0.04 / (0.04 + background_luminance + max(luminance(glare), 0.0));
    return (1.0 - rods) * glare + rods * rod_tint * (max(scotopic, 0.0) / d65_scotopic_ratio);
}

vec3 mapped_into_gamut(vec3 rgb) {
    float grey = luminance(rgb);
    if (grey <= 0.0) return vec3(0.0);
    float lowest = min(rgb.r, min(rgb.g, rgb.b));
    if (lowest >= 0.0) return rgb;
    return max(vec3(0.0), grey + (rgb - grey) * (grey / (grey - lowest)));
}

vec3 tone_mapped_rgb(vec3 cd_m2) {
    vec3 rgb = mapped_into_gamut(cd_m2);
    float y = luminance(rgb);
    if (y <= 0.0) return vec3(0.0);
    return rgb * (tone_map(y) / y);
}

vec3 fitted_to_display(vec3 rgb) {
    float largest = max(1.0, max(rgb.r, max(rgb.g, rgb.b)));
    return mix(rgb / largest, vec3(1.0), overload_white * (1.0 - 1.0 / largest));
}

// What is added to the linear value of a host pixel; never negative.
vec3 display_delta(vec3 background_linear, vec3 glare, float scotopic) {
    float display = luminance(background_linear);
    float background_scale = ldr_white;
    if (ldr_white <= 0.0) background_scale = display > 0.0 ? inverse_tone_map(display) / display : 0.0;
    vec3 background = background_linear * background_scale;
    if (blue_shift) glare = blue_shifted(glare, scotopic, luminance(background));
    if (!difference_mode) return fitted_to_display(tone_mapped_rgb(glare));
    return fitted_to_display(max(vec3(0.0), tone_mapped_rgb(background + glare) - tone_mapped_rgb(background)));
}
