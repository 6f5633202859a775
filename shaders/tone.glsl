// The tone curve; glare/tone/operators.h has the same in double precision, with its sources. What is here is arranged for
// speed, and a test holds the two together: luminances are in units of the curve (times `tone_scale`), and the powers of
// sRGB are polynomials.
uniform float tone_scale;  // relative luminance per cd/m2
uniform float tone_inverse_white2;
uniform float ldr_white;   // of a host pixel of 1, relative; 0: the inverse of our own curve
uniform float rod_light;   // half of vision is by rods at this relative luminance; 0: no rod hue
uniform float difference;  // 1: beside the host's light; 0: the glare alone, as if the host's pixel were black

const float overload_white = 0.03;
const float d65_scotopic_ratio = 2.464;
const vec3 rod_tint = vec3(1.05, 0.97, 1.27) / 1.0087;

float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

// Polynomials of least largest error (Lawson's algorithm) where IEC 61966-2-1 has powers: in the fourth root of the linear
// value, off by 0.002 codes of 8 bits at most, ...
vec3 srgb_encode(vec3 linear) {
    vec3 c = clamp(linear, 0.0, 1.0);
    vec3 t = sqrt(sqrt(c));
    vec3 power = ((((-0.0681474035 * t + 0.2895332813) * t - 0.5774830163) * t + 1.2554045402) * t + 0.1620262430) * t -
                 0.0613402153;
    return mix(power, 12.92 * c, lessThan(c, vec3(0.0031308)));
}

// ... and in the encoded one, off by 0.004 codes. One after the other, by 0.006.
vec3 srgb_decode(vec3 encoded) {
    vec3 c = clamp(encoded, 0.0, 1.0);
    vec3 power = (((((-0.0876796679 * c + 0.3234342505) * c - 0.5411758735) * c + 0.7718922937) * c + 0.4981247509) * c +
                  0.0345012163) * c + 0.0008716144;
    return mix(power, c / 12.92, lessThan(c, vec3(0.04045)));
}

// d linear/d encoded, within 7 %: enough for a dither.
vec3 srgb_slope(vec3 linear) {
    vec3 c = clamp(linear, 0.0, 1.0);
    return max(1.4447 * sqrt(c) + 0.97998 * c, vec3(1.0 / 12.92));
}

// The curve over its argument.
float tone_ratio(float relative) { return (1.0 + relative * tone_inverse_white2) / (1.0 + relative); }

// The inverse of the curve over its argument; beyond 1 the inverse stays that of 1.
float inverse_tone_ratio(float display) {
    float y = clamp(display, 0.0, 1.0);
    float rest = 1.0 - y;
    return 2.0 / (max(display, 1.0) * (rest + sqrt(rest * rest + 4.0 * y * tone_inverse_white2)));
}

// What rods make of the glare before a background: what is to be added to the glare itself.
vec3 blue_shift(vec3 glare, float scotopic, float background_luminance) {
    float all = rod_light + background_luminance + max(luminance(glare), 0.0);
    float rods = rod_light / max(all, 1e-30);
    return rods * (rod_tint * (max(scotopic, 0.0) / d65_scotopic_ratio) - glare);
}

// Into the gamut along the line to grey, then the curve on its luminance.
vec3 tone_mapped_rgb(vec3 rgb) {
    float grey = max(luminance(rgb), 0.0);
    float outside = grey - min(min(rgb.r, rgb.g), min(rgb.b, 0.0));
    vec3 inside = max(vec3(0.0), grey + (rgb - grey) * (grey / max(outside, 1e-30)));
    return inside * tone_ratio(grey);
}

vec3 fitted_to_display(vec3 rgb) {
    float fits = 1.0 / max(max(1.0, rgb.r), max(rgb.g, rgb.b));
    float white = overload_white - overload_white * fits;
    return rgb * (fits - white * fits) + white;
}

// What is added to the linear value of a host pixel; never negative. `glare`: luminance, and scotopic luminance.
vec3 display_delta(vec3 background_linear, vec4 glare) {
    vec4 relative = glare * tone_scale;
    float up = ldr_white > 0.0 ? ldr_white : inverse_tone_ratio(luminance(background_linear));
    vec3 background = background_linear * up;
    float background_luminance = luminance(background);
    vec3 shifted = relative.rgb + blue_shift(relative.rgb, relative.a, background_luminance);
    // The host's colours are inside the gamut: of the curve only its ratio is left.
    vec3 before = background * (difference * tone_ratio(background_luminance));
    return fitted_to_display(max(vec3(0.0), tone_mapped_rgb(background * difference + shifted) - before));
}
