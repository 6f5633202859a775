// A light on the picture near it: all of its pattern.
uniform sampler2DArray pattern;
uniform int radius_nodes;
uniform int layer_count;
uniform int tail_table;
uniform float tail_from2;  // nodes squared, from where on there is a tail
out vec4 glare;

// Filtering of floats is precise to eight bits on much hardware: four fetches are exact.
vec4 layer_at(ivec2 base, vec2 t, int layer) {
    ivec3 i = ivec3(base, layer);
    vec4 low = mix(texelFetch(pattern, i, 0), texelFetch(pattern, i + ivec3(1, 0, 0), 0), t.x);
    vec4 high = mix(texelFetch(pattern, i + ivec3(0, 1, 0), 0), texelFetch(pattern, i + ivec3(1, 1, 0), 0), t.x);
    return mix(low, high, t.y);
}

vec4 skirt_at(vec2 offset) {
    vec2 at = warped(offset) + float(radius_nodes);
    vec2 base = clamp(floor(at), vec2(0.0), vec2(float(2 * radius_nodes - 1)));
    vec2 t = at - base;
    // Beyond the table there is nothing.
    bool inside = layer_count > 0 && all(lessThanEqual(abs(t - 0.5), vec2(0.5)));
    t = clamp(t, 0.0, 1.0);
    vec4 value = layer_at(ivec2(base), t, tables.x);
#ifdef TWO_LAYERS
    value = mix(value, layer_at(ivec2(base), t, tables.y), upper);
#endif
    return inside ? value : vec4(0.0);
}

void main() {
    Place place = place_of_fragment();
    float weight = place.cosine > 0.0 ? not_fallen(sqrt(place.q)) : 0.0;
    vec4 value = skirt_lux * skirt_at(place.offset);
#ifdef TAIL
    value += illuminance * (place.q > tail_from2 ? radial_at(tail_table, place.q) : vec4(0.0));
#endif
    glare = value * weight;
}
