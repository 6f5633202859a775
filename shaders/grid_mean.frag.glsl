// The radial mean of a light on a grid.
out vec4 glare;

void main() {
    Place place = place_of_fragment();
    float distance = sqrt(place.q);
    // Glare goes no further than a quarter turn; the last ten degrees fade, so that no edge shows.
    float weight = smoothstep(0.0, 0.17, place.cosine) * risen(distance) * not_fallen(distance);
    glare = illuminance * (mean_at(place.q) * weight);
}
