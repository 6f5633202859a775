// A rectangle of a light on a grid of the pyramid (glare/apply/tile_lists.h) or on the picture: six vertices each. Lights
// and rectangles stand in one buffer: five texels a light, three a rectangle.
uniform samplerBuffer lights;
uniform sampler2D visibility;
uniform int hides;          // 0: nothing hides any light
uniform int quads_from;     // texel of the first rectangle
uniform int first_quad;     // of those drawn
uniform vec2 buffer_size;   // nodes of the grid
uniform int layer_count;    // of each lamp; 0: patterns have no skirt
uniform vec4 pattern_scale[32];  // by lamp: what a texel of the pattern is to be multiplied by

flat out vec3 along_u;      // direction cosines in nodes of the pattern, times the ray's length: constant, per px
flat out vec3 along_v;
flat out vec3 towards;      // and the cosine to the light
flat out vec4 illuminance;  // of what the host's picture does not hide
flat out vec4 skirt_lux;    // the same times pattern_scale
flat out vec4 fade;         // where it comes and goes, nodes, each with the inverse of its width
flat out vec4 ends;         // of those windows: 1 where there is one; squares of where departures begin and end
flat out vec3 lash;
flat out ivec2 tables;      // of the lower and the upper layer
flat out float upper;       // share of the upper layer

// No sum of lights may reach infinity: 1e6 is more than any pattern has for each steradian.
const float most_lux = 1e24;
const float fade_ratio = 1.75;  // glare/apply/tile_lists.h

void main() {
    int at = quads_from + 3 * (first_quad + gl_VertexID / 6);
    int corner = gl_VertexID % 6;
    corner = corner < 3 ? corner : 6 - corner;
    vec4 what = texelFetch(lights, at);
    vec4 rect = texelFetch(lights, at + 1);
    vec4 window = texelFetch(lights, at + 2);
    int light = 5 * int(what.x);
    vec4 u = texelFetch(lights, light);
    vec4 v = texelFetch(lights, light + 1);
    vec4 c = texelFetch(lights, light + 2);
    vec4 turned = texelFetch(lights, light + 4);
    int seen = hides != 0 ? int(turned.w) : 0;
    float visible = texelFetch(visibility, ivec2(seen % 256, seen / 256), 0).r;
    along_u = u.xyz;
    along_v = v.xyz;
    towards = c.xyz;
    lash = turned.xyz;
    tables = ivec2(int(u.w), int(v.w));
    upper = what.y > 0.0 ? 0.0 : c.w;
    // Departures come in where the window of what is near goes.
    if (what.z > 0.0) window = vec4(what.z, fade_ratio * what.z, 0.0, 0.0);
    fade = vec4(window.x, 1.0 / max(window.y - window.x, 1e-6), window.z, 1.0 / max(window.w - window.z, 1e-6));
    ends = vec4(window.y > 0.0 ? 1.0 : 0.0, window.w > 0.0 ? 1.0 : 0.0, what.z * what.z, what.w);
    illuminance = clamp(texelFetch(lights, light + 3) * visible, vec4(-most_lux), vec4(most_lux));
    skirt_lux = illuminance * (layer_count > 0 ? pattern_scale[min(tables.x / max(layer_count, 1), 31)] : vec4(0.0));
    vec2 texel = vec2((corner & 1) == 0 ? rect.x : rect.z, corner < 2 ? rect.y : rect.w);
    gl_Position = visible > 0.0 ? vec4(texel / buffer_size * 2.0 - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
