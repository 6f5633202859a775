// The core of a light: its footprint, or, near by, the lamp's disc with a soft rim.
uniform vec4 core_energy[32];  // by slot
uniform float buffer_bottom;   // the row of the viewport that the buffer's first is
flat in int light_index;
flat in vec4 illuminance;
flat in int lamp_slot;
out vec4 glare;

void main() {
    Light light = fetch_light(light_index);
    vec2 px = gl_FragCoord.xy + vec2(0.0, buffer_bottom);
    vec3 ray = ray_of_px(px);
    float as_disc = smoothstep(rows_until_px, disc_from_px, light.disc_px);
    float per_sr = 0.0;
    if (as_disc < 1.0) {
        float weight = core_weight(px - light.centre_px, light.px_from_disc, light.disc_px);
        per_sr += (1.0 - as_disc) * weight / pixel_solid_angle(ray);
    }
    if (as_disc > 0.0) {
        // The chord c = 2 sin(angle/2) keeps areas: a cap has exactly pi c^2 steradian.
        float px_rad = sqrt(pixel_solid_angle(light.direction));
        float beyond_px = (length(ray - light.direction) - light.disc_chord) / px_rad;
        float area = 0.5 * two_pi * (light.disc_chord * light.disc_chord + kernel_variance_px2 * px_rad * px_rad);
        per_sr += as_disc * (1.0 - kernel_integral(beyond_px)) / area;
    }
    glare = finite_light(illuminance * core_energy[lamp_slot] * per_sr);
}
