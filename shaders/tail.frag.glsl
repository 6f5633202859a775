// The far tail of a light on the coarse grid.
uniform float cell_px;
flat in int light_index;
flat in vec4 illuminance;
out vec4 glare;

void main() {
    Light light = fetch_light(light_index);
    vec3 ray = ray_of_px((gl_FragCoord.xy - 0.5) * cell_px);
    float cosine = dot(ray, light.direction);
    float sine = length(cross(ray, light.direction));
    if (cosine <= 0.0) discard;
    float handed_over = 1.0 - cosine_window(sine, light.fade_start, light.fade_end);
    glare = finite_light(illuminance * (tail(cosine, sine) * handed_over));
}
