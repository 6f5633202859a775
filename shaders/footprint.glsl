// The footprint of a light's core on pixels; glare/apply/footprint.h has the reasons and the same in C++.
const float two_pi = 6.28318531;
const float point_until_px = 0.09;
const float mixed_from_px = 0.11;
const float smallest_disc_px = 1.8;
const float rows_until_px = 3.0;
const float disc_from_px = 4.0;
const float kernel_hann_px = 1.5;
const float kernel_reach_px = 1.75;
const float kernel_variance_px2 = 0.40684700;

float hann_integral(float x) {
    float t = clamp(x / kernel_hann_px, -0.5, 0.5);
    return 0.5 + t + sin(two_pi * t) / two_pi;
}

float hann_second_integral(float x) {
    float c = clamp(x / kernel_hann_px, -0.5, 0.5);
    float inside = c * c / 2.0 + c / 2.0 + 0.125 - (1.0 + cos(two_pi * c)) / (two_pi * two_pi);
    return x >= 0.5 * kernel_hann_px ? x : kernel_hann_px * inside;
}

float kernel(float x) { return 0.5 * (hann_integral(x + 1.0) - hann_integral(x - 1.0)); }
float kernel_square(vec2 offset_px) {
    // Spares the sines of most pixels.
    if (abs(offset_px.x) >= kernel_reach_px || abs(offset_px.y) >= kernel_reach_px) return 0.0;
    return kernel(offset_px.x) * kernel(offset_px.y);
}
float kernel_integral(float x) {
    return clamp(0.5 * (hann_second_integral(x + 1.0) - hann_second_integral(x - 1.0)), 0.0, 1.0);
}

// Of the light of a disc of this apparent radius, what is drawn as a disc; the rest is a point.
float disc_share(float disc_px) {
    float ratio = min(disc_px / smallest_disc_px, 1.0);
    float come_in = (disc_px - point_until_px) / (mixed_from_px - point_until_px);
    return clamp(come_in, 0.0, 1.0) * ratio * ratio;
}
// No disc is drawn smaller than the smallest; a point is none.
float drawn_scale(float disc_px) {
    return disc_px > point_until_px ? max(smallest_disc_px / disc_px, 1.0) : 1.0;
}
mat2 drawn_disc(mat2 px_from_disc, float disc_px) { return px_from_disc * drawn_scale(disc_px); }

// The upper half of the unit disc's rows: height, half width; the weights are 2/13 half_width^2.
const int disc_half_rows = 6;
const vec2 disc_row[6] = vec2[6](vec2(0.97094182, 0.23931566),
                                 vec2(0.88545603, 0.46472317),
                                 vec2(0.74851075, 0.66312266),
                                 vec2(0.56806475, 0.82298387),
                                 vec2(0.35460489, 0.93501624),
                                 vec2(0.12053668, 0.99270887));

// A disc convolved with the kernel, at a pixel.
float disc_weight(vec2 offset_px, mat2 px_from_disc) {
    vec2 along_x = vec2(px_from_disc[0].x, px_from_disc[1].x);
    vec2 along_y = vec2(px_from_disc[0].y, px_from_disc[1].y);
    float yy = dot(along_y, along_y);
    float xy = dot(along_x, along_y);
    float widest = sqrt(max(dot(along_x, along_x) - xy * xy / yy, 0.0));
    vec2 lean = vec2(xy / yy, 1.0) * sqrt(yy);
    float sum = 0.0;
    for (int i = 0; i < 2 * disc_half_rows; ++i) {
        vec2 row = disc_row[i / 2];
        if ((i & 1) == 1) row.x = -row.x;
        vec2 from_middle = offset_px - lean * row.x;
        float c = widest * row.y;
        // Spares the sines of most rows.
        if (abs(from_middle.y) >= kernel_reach_px || abs(from_middle.x) >= c + kernel_reach_px) continue;
        float along = kernel_integral(from_middle.x + c) - kernel_integral(from_middle.x - c);
        sum += row.y * row.y * kernel(from_middle.y) * along / (2.0 * c);
    }
    return sum * 2.0 / 13.0;
}

// Share of a light's core that falls into a pixel.
float core_weight(vec2 offset_px, mat2 px_from_disc, float disc_px) {
    float point = kernel_square(offset_px);
    if (disc_px <= point_until_px) return point;
    float share = disc_share(disc_px);
    float disc = disc_weight(offset_px, drawn_disc(px_from_disc, disc_px));
    return (1.0 - share) * point + share * disc;
}
