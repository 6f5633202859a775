// The CIE 135/1-1999 total glare spread function where the simulated skirt ends; glare/psf/cie_curve has it in C++.
uniform float tail_scale;    // 0: no tail
uniform float tail_age4;     // (age/70)^4
uniform float tail_pigment;
uniform float window_inner;  // sin(angle): the skirt fades out between the two
uniform float window_outer;

float falloff(float t) { return 1.0 / (1.0 + t * t); }

float cie_glare(float angle_deg) {
    float core = falloff(angle_deg / 0.0046);
    float ring = falloff(angle_deg / 0.045);
    float wide = falloff(angle_deg / 0.1);
    float a = tail_age4;
    float p = tail_pigment;
    return ((1.0 - 0.08 * a) * (9.2e6 * core * sqrt(core) + 1.5e5 * ring * sqrt(ring)) +
            (1.0 + 1.6 * a) * (400.0 * wide + 3e-8 * angle_deg * angle_deg +
                               p * (1300.0 * wide * sqrt(wide) + 0.8 * sqrt(wide))) +
            2.5e-3 * p) / (1.0 + p * (0.0417 + 0.055 * a));
}

// 1 below low, 0 above high, half a cosine between.
float cosine_window(float x, float low, float high) {
    if (x <= low) return 1.0;
    if (x >= high) return 0.0;
    return 0.5 + 0.5 * cos(3.14159265 * (x - low) / (high - low));
}

// Glare goes no further than a quarter turn; the last ten degrees fade, so that no edge shows.
float tail(float cosine, float sine) {
    float angle_deg = degrees(cosine > 0.7 ? asin(min(sine, 1.0)) : acos(clamp(cosine, -1.0, 1.0)));
    return tail_scale * cie_glare(angle_deg) * smoothstep(0.0, 0.17, cosine);
}
