// The core of a light: its footprint, or, near by, the lamp's disc with a soft rim; and what finer nodes near the light have
// beside the skirt (glare/psf/fine_nodes.h).
uniform vec4 core_energy[32];  // by slot
uniform float buffer_bottom;   // the row of the viewport that the buffer's first is
uniform sampler2DArray fine_nodes;
uniform float fine_per_node;
uniform float fine_radius;      // in fine nodes
uniform float fine_moment;      // second moment, nodes^2, of the disc that has none; 0: there are none
flat in int light_index;
flat in vec4 illuminance;
flat in vec3 direction;
flat in vec3 tangent_u;
flat in vec3 tangent_v;
flat in int lamp_slot;
flat in vec3 lash_warp;
out vec4 glare;

vec4 fine_at(vec3 ray) {
    vec2 offset = vec2(dot(ray, tangent_u), dot(ray, tangent_v)) / pitch;
    vec2 at = lash_lookup(offset, lash_warp) * fine_per_node + fine_radius;
    vec2 base = floor(at);
    if (any(lessThan(base, vec2(0.0))) || any(greaterThanEqual(base, vec2(2.0 * fine_radius)))) return vec4(0.0);
    vec2 t = at - base;
    ivec3 i = ivec3(ivec2(base), lamp_slot);
    vec4 low = mix(texelFetch(fine_nodes, i, 0), texelFetch(fine_nodes, i + ivec3(1, 0, 0), 0), t.x);
    vec4 high = mix(texelFetch(fine_nodes, i + ivec3(0, 1, 0), 0), texelFetch(fine_nodes, i + ivec3(1, 1, 0), 0), t.x);
    return mix(low, high, t.y);
}

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
    vec4 psf = core_energy[lamp_slot] * per_sr;
    float moment = light.disc_nodes * light.disc_nodes;
    // A lamp as wide as the sky has pixels behind the eye's plane of the light.
    if (moment < fine_moment && dot(ray, direction) > 0.0) psf += (1.0 - moment / fine_moment) * fine_at(ray);
    glare = finite_light(illuminance * psf);
}
