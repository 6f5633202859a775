// The simulated skirt of a light at full resolution, and the tail as far as it is not left to the coarse grid.
uniform sampler2DArray pattern;
uniform vec4 pattern_scale[32];  // by slot: what its texels, which are half floats, are to be multiplied by
uniform float buffer_bottom;     // the row of the viewport that the buffer's first is
uniform int radius_nodes;
uniform int layer_count;     // of each lamp; a lamp's layers lie together
uniform vec4 layer_radii_a;  // nodes, ascending; the first is 0
uniform vec4 layer_radii_b;
flat in vec4 illuminance;
flat in vec3 direction;
flat in vec4 disc_and_fade;  // disc_chord, disc_nodes, fade_start, fade_end
flat in vec3 tangent_u;
flat in vec3 tangent_v;
flat in int lamp_slot;
flat in vec3 lash_warp;
out vec4 glare;

float layer_radius(int i) { return i < 4 ? layer_radii_a[i] : layer_radii_b[i - 4]; }

// glare/apply/layer_moment.h
float layer_moment(int i) {
    float radius = layer_radius(i);
    return radius > 0.0 ? radius * radius + 1.0 / 3.0 : 0.0;
}

// Filtering of 32-bit floats is precise to eight bits on much hardware: four fetches are exact.
vec4 layer_at(vec2 offset_nodes, int layer) {
    vec2 at = offset_nodes + float(radius_nodes);
    vec2 base = floor(at);
    if (any(lessThan(base, vec2(0.0))) || any(greaterThanEqual(base, vec2(2 * radius_nodes)))) return vec4(0.0);
    vec2 t = at - base;
    ivec3 i = ivec3(ivec2(base), lamp_slot * layer_count + layer);
    vec4 low = mix(texelFetch(pattern, i, 0), texelFetch(pattern, i + ivec3(1, 0, 0), 0), t.x);
    vec4 high = mix(texelFetch(pattern, i + ivec3(0, 1, 0), 0), texelFetch(pattern, i + ivec3(1, 1, 0), 0), t.x);
    return mix(low, high, t.y);
}

// Skirt and near tail of a point, or of the disc of a layer.
vec4 psf_at(vec2 offset_nodes, int layer) {
    float sine = pitch * length(offset_nodes);
    // A layer is spread by its disc beyond where the point's skirt ends.
    float reach = window_outer + pitch * layer_radius(layer);
    vec2 at = lash_lookup(offset_nodes, lash_warp);
    vec4 value = pitch * length(at) < reach ? layer_at(at, layer) * pattern_scale[lamp_slot] : vec4(0.0);
    if (tail_scale > 0.0 && sine > window_inner) {
        float cosine = sqrt(max(0.0, 1.0 - sine * sine));
        value += tail(cosine, sine) * (1.0 - cosine_window(sine, window_inner, window_outer));
    }
    return value;
}

vec4 psf_of_disc(vec2 offset_nodes, float disc_nodes) {
    int last = layer_count - 1;
    float last_radius = layer_radius(last);
    if (disc_nodes <= max(last_radius, 0.25)) {
        int lower = 0;
        float moment = disc_nodes * disc_nodes;
        while (lower < last - 1 && layer_moment(lower + 1) < moment) ++lower;
        int upper = min(lower + 1, last);
        float span = layer_moment(upper) - layer_moment(lower);
        float t = span > 0.0 ? clamp((moment - layer_moment(lower)) / span, 0.0, 1.0) : 0.0;
        if (t < 1.0 / 512.0) return psf_at(offset_nodes, lower);
        if (t > 1.0 - 1.0 / 512.0) return psf_at(offset_nodes, upper);
        return mix(psf_at(offset_nodes, lower), psf_at(offset_nodes, upper), t);
    }
    // A lamp larger than the largest layer: seven of them on the disc (Stroud's fifth-order rule), widened as it
    // grows, so that neither gaps nor lobes show outside the lamp's own disc.
    float widening = max(1.0, 0.45 * disc_nodes / max(last_radius, 1.5));
    float ring = sqrt(max(disc_nodes * disc_nodes - last_radius * last_radius, 0.0)) * sqrt(2.0 / 3.0);
    vec4 value = 0.25 * psf_at(offset_nodes / widening, last);
    for (int i = 0; i < 6; ++i) {
        float angle = float(i) * 1.04719755;
        value += 0.125 * psf_at((offset_nodes - ring * vec2(cos(angle), sin(angle))) / widening, last);
    }
    return value / (widening * widening);
}

void main() {
    vec3 ray = ray_of_px(gl_FragCoord.xy + vec2(0.0, buffer_bottom));
    if (dot(ray, direction) <= 0.0) discard;
    vec2 offset = vec2(dot(ray, tangent_u), dot(ray, tangent_v));
    float kept = cosine_window(length(offset), disc_and_fade.z, disc_and_fade.w);
    if (kept <= 0.0) discard;
    glare = finite_light(illuminance * psf_of_disc(offset / pitch, disc_and_fade.y) * kept);
}
