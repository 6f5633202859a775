// What finer nodes near a light have beside its skirt (glare/psf/fine_nodes.h). A program apart from the core's, whose pixels are few
// and dear: a rasteriser on a CPU computes all of a shader for every pixel.
uniform sampler2DArray fine_nodes;
uniform float fine_per_node;
uniform float fine_radius;      // in fine nodes
uniform float fine_moment;      // second moment, nodes^2, of the disc that has none
uniform float buffer_bottom;    // the row of the viewport that the buffer's first is
flat in vec4 illuminance;
flat in vec3 direction;
flat in vec4 disc_and_fade;     // disc_chord, disc_nodes, fade_start, fade_end
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
    vec3 ray = ray_of_px(gl_FragCoord.xy + vec2(0.0, buffer_bottom));
    float moment = disc_and_fade.y * disc_and_fade.y;
    // A lamp as wide as the sky has pixels behind the eye's plane of the light.
    if (moment >= fine_moment || dot(ray, direction) <= 0.0) discard;
    glare = finite_light(illuminance * (1.0 - moment / fine_moment) * fine_at(ray));
}
