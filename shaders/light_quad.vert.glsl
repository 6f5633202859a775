// One rectangle per light. rect_texel says which of the light's rectangles; cell_px and margin_px place it on the coarse
// grid, whose node (i, j) stands at pixel (i, j) cell_px.
uniform sampler2D visibility;
uniform int first_light;    // of those drawn, in the buffer
uniform int first_texel;    // of the buffer's first light in the visibility
uniform int rect_texel;
uniform float cell_px;      // 0: the full resolution
uniform vec2 buffer_size;   // texels of the buffer drawn to
uniform float margin_px;    // more than 0: no more of the rectangle than the footprint with this around its disc

flat out int light_index;
flat out vec4 illuminance;  // of what the host's picture does not hide
// What the wide passes need per light; fetching it in every fragment would cost as much as the pattern itself.
flat out vec3 direction;
flat out vec4 disc_and_fade;  // disc_chord, disc_nodes, fade_start, fade_end
flat out vec3 tangent_u;
flat out vec3 tangent_v;
flat out int lamp_slot;       // which of the pattern's lamps it is
flat out vec3 lash_warp;      // cosine and sine of the turn, bend; (1, 0, 0): none

void main() {
    light_index = first_light + gl_InstanceID;
    int at = first_texel + light_index;
    float visible = texelFetch(visibility, ivec2(at % 256, at / 256), 0).r;
    illuminance = light_texel(light_index, 1) * visible;
    direction = light_texel(light_index, 0).xyz;
    disc_and_fade = light_texel(light_index, 2);
    lamp_slot = int(light_texel(light_index, 6).w);
    pattern_tangents(direction, tangent_u, tangent_v);
    lash_warp = lash_warp_of(direction);
    vec4 rect = light_texel(light_index, rect_texel);
    if (margin_px > 0.0) {
        vec3 centre_and_disc_px = light_texel(light_index, 6).xyz;
        vec4 px_from_disc = light_texel(light_index, 7);
        if (centre_and_disc_px.z <= rows_until_px) {
            float drawn = drawn_scale(centre_and_disc_px.z);
            vec2 reach = drawn * vec2(length(px_from_disc.xz), length(px_from_disc.yw)) + margin_px;
            rect.xy = max(rect.xy, centre_and_disc_px.xy - reach);
            rect.zw = min(rect.zw, centre_and_disc_px.xy + reach);
        }
    }
    bool empty = rect.z <= rect.x || rect.w <= rect.y || visible <= 0.0;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 px = mix(rect.xy, rect.zw, corner);
    vec2 texel = px;
    if (cell_px > 0.0) texel = px / cell_px + 0.5 + (corner * 2.0 - 1.0);
    gl_Position = empty ? vec4(2.0, 2.0, 0.0, 1.0) : vec4(texel / buffer_size * 2.0 - 1.0, 0.0, 1.0);
}
