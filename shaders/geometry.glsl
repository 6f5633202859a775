// Pixels of the viewport (lower left corner at 0, 0) and directions in view space; glare/apply/screen_geometry says how.
uniform mat3 ray_from_ndc;
uniform vec2 viewport_px;
uniform vec3 screen_forward;
uniform vec3 screen_right;
uniform vec3 screen_up;
uniform float pixel_plane_area;  // solid angle of a pixel divided by cos^3
uniform float pitch;             // direction cosine per pattern node

vec3 ray_of_px(vec2 px) { return normalize(ray_from_ndc * vec3(px / viewport_px * 2.0 - 1.0, 1.0)); }

float pixel_solid_angle(vec3 ray) {
    float cosine = max(dot(ray, screen_forward), 1e-4);
    return pixel_plane_area * cosine * cosine * cosine;
}

// Right and up of a light's pattern: the screen's, turned with the least rotation onto the light's direction.
void pattern_tangents(vec3 direction, out vec3 u, out vec3 v) {
    vec3 sum = (screen_forward + direction) / max(1.0 + dot(screen_forward, direction), 1e-6);
    u = screen_right - sum * dot(screen_right, direction);
    v = screen_up - sum * dot(screen_up, direction);
}
