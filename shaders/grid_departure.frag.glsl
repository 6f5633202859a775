// What a light's pattern has beside its mean over the azimuth, which the grids carry: in the tiles where that shows.
uniform sampler2DArray departures;  // filtered: eight bits of a departure are enough; zero beyond its edges
uniform float departures_scale;     // what its texels, which are half floats, are to be multiplied by
uniform float middle;               // of the texture, in its coordinates
uniform float per_node;
out vec4 glare;

vec4 layer_at(vec2 at, int layer) { return textureLod(departures, vec3(at, float(layer)), 0.0); }

void main() {
    Place place = place_of_fragment();
    float weight = place.q < ends.w && place.cosine > 0.0 ? departures_scale : 0.0;
#ifdef FADES
    weight *= place.q > ends.z ? risen(sqrt(place.q)) : 0.0;
#endif
    vec2 offset = warped(place.offset);
    vec2 at = offset * per_node + middle;
    vec4 value = layer_at(at, tables.x);
#ifdef TWO_LAYERS
    value = mix(value, layer_at(at, tables.y), upper);
#endif
#ifdef LASHES
    // A bent pattern departs from the mean around the place that it was bent from.
    value += (mean_at(dot(offset, offset)) - mean_at(place.q)) / departures_scale;
#endif
    glare = illuminance * (value * weight);
}
