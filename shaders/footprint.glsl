// The footprint of a light's core on pixels; glare/apply/footprint.h has the reasons and the same in C++.
const float two_pi = 6.28318531;
const float point_until_px = 0.03;
const float small_nodes_until_px = 0.7;
const float nodes_until_px = 2.0;
const float disc_from_px = 3.0;
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
    // Spares the sines of most nodes.
    if (abs(offset_px.x) >= kernel_reach_px || abs(offset_px.y) >= kernel_reach_px) return 0.0;
    return kernel(offset_px.x) * kernel(offset_px.y);
}
float kernel_integral(float x) {
    return clamp(0.5 * (hann_second_integral(x + 1.0) - hann_second_integral(x - 1.0)), 0.0, 1.0);
}

// Rings of 6, 12, 18 and 24 nodes around one, all of one weight: ring k lies in the middle of its share of the area.
const int disc_rings = 4;
const float disc_node_count = 61.0;
float disc_ring_radius(int ring) {
    float before = 1.0 + 3.0 * float(ring * (ring - 1));
    return sqrt((before + 3.0 * float(ring)) / disc_node_count);
}

// Sum over the disc's nodes of the kernel at a pixel.
float disc_weight(vec2 offset_px, mat2 px_from_disc, float disc_px) {
    if (disc_px <= point_until_px) return kernel_square(offset_px);
    if (disc_px <= small_nodes_until_px) {
        float sum = 0.25 * kernel_square(offset_px);
        for (int i = 0; i < 6; ++i) {
            float angle = float(i) * two_pi / 6.0;
            sum += 0.125 * kernel_square(offset_px - px_from_disc * (0.81649658 * vec2(cos(angle), sin(angle))));
        }
        return sum;
    }
    float sum = kernel_square(offset_px);
    for (int ring = 1; ring <= disc_rings; ++ring) {
        float radius = disc_ring_radius(ring);
        int count = 6 * ring;
        float step_rad = two_pi / float(count);
        vec2 turn = vec2(cos(step_rad), sin(step_rad));
        vec2 at = vec2(radius, 0.0);
        for (int i = 0; i < count; ++i) {
            sum += kernel_square(offset_px - px_from_disc * at);
            at = vec2(at.x * turn.x - at.y * turn.y, at.x * turn.y + at.y * turn.x);
        }
    }
    return sum / disc_node_count;
}
