// How much of each light the host's picture leaves free, one texel per light. Needs footprint, geometry, lights.
// SEAGLARE_DEPTH_MS: the depth is multisampled.
#ifdef SEAGLARE_DEPTH_MS
uniform sampler2DMS depth;
#else
uniform sampler2D depth;
#endif
uniform int first_row;         // of these lights in the texture drawn to
uniform int light_count;
uniform int depth_samples;
uniform float body_m;          // what stands no further before a lamp is its own body
uniform ivec2 depth_origin;    // of the viewport in the depth image
uniform ivec2 depth_size;
uniform bool depth_logarithmic;
uniform vec2 depth_log;        // c, ln(c far + 1)
// Along a unit ray: distance = (z_constant - z w_constant)/(step w + offset . ray), step = scale (depth - anchor),
// z = far_z + step: anchored at the far plane, where floats would cancel.
uniform vec2 depth_scale_anchor;
uniform float depth_far_z;
uniform vec3 depth_offset;
uniform vec2 depth_constants;  // z_constant, w_constant
uniform vec3 depth_row_w;
uniform float depth_quantum;   // steps of the stored value that may be wrong
uniform float depth_quantum_relative;
// The values of the frame before, in its order; where each light stood in it, -1: nowhere; and how much of what is seen now
// counts.
uniform sampler2D seen_before;
uniform isamplerBuffer previous;
uniform float blend;
out vec4 visible;

const float unlimited = 1e30;

// Where a disc is looked at: rings of 6, 12, 18 and 24 points around one, all of one weight; ring k lies in the middle of
// its share of the area.
const int disc_rings = 4;
const float disc_node_count = 61.0;
float disc_ring_radius(int ring) {
    float before = 1.0 + 3.0 * float(ring * (ring - 1));
    return sqrt((before + 3.0 * float(ring)) / disc_node_count);
}

float eye_distance_m(float stored, vec3 ray) {
    float w = dot(depth_row_w, ray);
    float distance_m;
    if (depth_logarithmic) {
        distance_m = (exp(stored * depth_log.y) - 1.0) / depth_log.x / w;
    } else {
        float step_z = depth_scale_anchor.x * (stored - depth_scale_anchor.y);
        distance_m = (depth_constants.x - (depth_far_z + step_z) * depth_constants.y) /
                     (step_z * w + dot(depth_offset, ray));
    }
    // Behind infinity, or 0/0: nothing was drawn there.
    return distance_m > 0.0 && distance_m < unlimited ? distance_m : unlimited;
}

// Depth error at a distance: the slope of the distance times the error of the stored value.
float depth_error_m(float distance_m, vec3 ray) {
    float w = dot(depth_row_w, ray);
    if (depth_logarithmic) return (distance_m + 1.0 / (depth_log.x * w)) * depth_log.y * depth_quantum;
    float slope = distance_m * distance_m * w / max(abs(depth_constants.x), 1e-30);
    float stored_z = depth_constants.x / max(distance_m * w, 1e-30);
    return slope * (depth_scale_anchor.x * depth_quantum + depth_quantum_relative * abs(stored_z));
}

// 1 when the host drew nothing nearer than `nearest_m` at the pixel; the mean over a multisampled pixel.
float free_at(ivec2 px, float nearest_m) {
    ivec2 at = px + depth_origin;
    if (any(lessThan(px, ivec2(0))) || any(greaterThanEqual(px, ivec2(viewport_px))) ||
        any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, depth_size))) {
        return 1.0;
    }
    vec3 ray = ray_of_px(vec2(px) + 0.5);
#ifdef SEAGLARE_DEPTH_MS
    float sum = 0.0;
    for (int i = 0; i < depth_samples; ++i) {
        sum += eye_distance_m(texelFetch(depth, at, i).r, ray) >= nearest_m ? 1.0 : 0.0;
    }
    return sum / float(depth_samples);
#else
    return eye_distance_m(texelFetch(depth, at, 0).r, ray) >= nearest_m ? 1.0 : 0.0;
#endif
}

// Of a light, what the picture leaves free.
float free_share(Light light) {
    if (dot(light.direction, screen_forward) <= 1e-4) return 1.0;
    float own_m = max(light.disc_chord * light.distance_m, body_m);  // the chord is not less than the lamp's radius
    float nearest_m = light.distance_m - own_m - depth_error_m(light.distance_m, light.direction) -
                      0.002 * light.distance_m;
    if (nearest_m <= 0.0) return 1.0;

    // The footprint's own shares: what is hidden and what is drawn are the same, and move smoothly.
    float by_disc = light.disc_px > point_until_px ? disc_share(light.disc_px) : 0.0;
    float share = 0.0;
    if (by_disc < 1.0) {
        ivec2 corner = ivec2(floor(light.centre_px)) - 1;
        float sum = 0.0;
        float weights = 0.0;
        for (int y = -1; y < 4; ++y) {
            for (int x = -1; x < 4; ++x) {
                ivec2 px = corner + ivec2(x, y);
                float weight = kernel_square(vec2(px) + 0.5 - light.centre_px);
                if (weight <= 0.0) continue;
                sum += weight * free_at(px, nearest_m);
                weights += weight;
            }
        }
        share += (1.0 - by_disc) * sum / weights;
    }
    if (by_disc > 0.0) {
        mat2 disc = drawn_disc(light.px_from_disc, light.disc_px);
        float sum = free_at(ivec2(floor(light.centre_px)), nearest_m);
        for (int ring = 1; ring <= disc_rings; ++ring) {
            int count = 6 * ring;
            for (int i = 0; i < count; ++i) {
                float angle = two_pi * float(i) / float(count);
                vec2 at = disc_ring_radius(ring) * vec2(cos(angle), sin(angle));
                sum += free_at(ivec2(floor(light.centre_px + disc * at)), nearest_m);
            }
        }
        share += by_disc * sum / disc_node_count;
    }
    return clamp(share, 0.0, 1.0);
}

// Nearer to its goal than this a value has come to rest: what is hidden becomes dark.
const float at_rest = 1e-4;

void main() {
    visible = vec4(1.0);
    int index = (int(gl_FragCoord.y) - first_row) * 256 + int(gl_FragCoord.x);
    if (index >= light_count) return;
    float share = free_share(fetch_light(index));
    if (blend < 1.0) {
        int before = texelFetch(previous, index).r;
        if (before >= 0) {
            float was = texelFetch(seen_before, ivec2(before % 256, before / 256), 0).r;
            if (abs(share - was) > at_rest) share = mix(was, share, blend);
        }
    }
    visible = vec4(share);
}
