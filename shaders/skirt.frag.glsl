// The simulated skirt of a light at full resolution, and the tail as far as it is not left to the coarse grid.
uniform sampler2DArray pattern;
uniform int radius_nodes;
uniform int layer_count;
uniform vec4 layer_radii_a;  // nodes, ascending; the first is 0
uniform vec4 layer_radii_b;
flat in int light_index;
flat in vec4 illuminance;
out vec4 glare;

float layer_radius(int i) { return i < 4 ? layer_radii_a[i] : layer_radii_b[i - 4]; }

vec4 node(ivec2 at, int layer) {
    int last = 2 * radius_nodes;
    if (any(lessThan(at, ivec2(0))) || any(greaterThan(at, ivec2(last)))) return vec4(0.0);
    return texelFetch(pattern, ivec3(at, layer), 0);
}

// Filtering of 32-bit floats is an option of GL: four fetches are not.
vec4 layer_at(vec2 offset_nodes, int layer) {
    vec2 at = offset_nodes + float(radius_nodes);
    vec2 base = floor(at);
    vec2 t = at - base;
    ivec2 i = ivec2(base);
    vec4 low = mix(node(i, layer), node(i + ivec2(1, 0), layer), t.x);
    vec4 high = mix(node(i + ivec2(0, 1), layer), node(i + ivec2(1, 1), layer), t.x);
    return mix(low, high, t.y);
}

vec4 skirt_at(vec2 offset_nodes, float disc_nodes) {
    int last = layer_count - 1;
    float last_radius = layer_radius(last);
    if (disc_nodes <= max(last_radius, 0.25)) {
        int lower = 0;
        while (lower < last - 1 && layer_radius(lower + 1) < disc_nodes) ++lower;
        int upper = min(lower + 1, last);
        vec4 value = layer_at(offset_nodes, lower);
        float span = layer_radius(upper) - layer_radius(lower);
        float t = span > 0.0 ? clamp((disc_nodes - layer_radius(lower)) / span, 0.0, 1.0) : 0.0;
        if (t > 0.0) value = mix(value, layer_at(offset_nodes, upper), t);
        return value;
    }
    // A lamp larger than the largest layer: seven of them on the disc (Stroud's fifth-order rule), widened as it
    // grows, so that neither gaps nor lobes show outside the lamp's own disc.
    float widening = max(1.0, 0.45 * disc_nodes / max(last_radius, 1.5));
    float ring = sqrt(max(disc_nodes * disc_nodes - last_radius * last_radius, 0.0)) * sqrt(2.0 / 3.0);
    vec4 value = 0.25 * layer_at(offset_nodes / widening, last);
    for (int i = 0; i < 6; ++i) {
        float angle = float(i) * 1.04719755;
        value += 0.125 * layer_at((offset_nodes - ring * vec2(cos(angle), sin(angle))) / widening, last);
    }
    return value / (widening * widening);
}

void main() {
    Light light = fetch_light(light_index);
    vec3 ray = ray_of_px(gl_FragCoord.xy);
    float cosine = dot(ray, light.direction);
    if (cosine <= 0.0) discard;
    vec3 u;
    vec3 v;
    pattern_tangents(light.direction, u, v);
    vec2 offset = vec2(dot(ray, u), dot(ray, v));
    float sine = length(offset);
    float kept = cosine_window(sine, light.fade_start, light.fade_end);
    if (kept <= 0.0) discard;
    vec4 value = skirt_at(offset / pitch, light.disc_nodes);
    float window = cosine_window(sine / light.window_scale, window_inner, window_outer);
    if (tail_scale > 0.0 && window < 1.0) value += tail(cosine, sine) * (1.0 - window);
    glare = finite_light(illuminance * value * kept);
}
