// The far tail of a light, on the coarse grid or at the full resolution.
uniform float cell_px;        // 0: the full resolution
uniform float buffer_bottom;  // the row of the viewport that the buffer's first is
flat in vec4 illuminance;
flat in vec3 direction;
flat in vec4 disc_and_fade;
out vec4 glare;

void main() {
    vec2 px = cell_px > 0.0 ? (gl_FragCoord.xy - 0.5) * cell_px : gl_FragCoord.xy + vec2(0.0, buffer_bottom);
    vec3 ray = ray_of_px(px);
    float cosine = dot(ray, direction);
    float sine = length(cross(ray, direction));
    if (cosine <= 0.0) discard;
    float handed_over = 1.0 - cosine_window(sine, disc_and_fade.z, disc_and_fade.w);
    glare = finite_light(illuminance * (tail(cosine, sine) * handed_over));
}
