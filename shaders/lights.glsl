// The lights of a frame, eight texels each; glare/apply/light_instance.h names the fields.
uniform samplerBuffer lights;

const int texels_per_light = 8;

struct Light {
    vec3 direction;
    float distance_m;
    vec4 illuminance;     // linear sRGB and scotopic, lux
    float disc_chord;     // apparent radius as chord of the unit sphere
    float disc_nodes;     // the same in nodes of the pattern
    float fade_start;     // sin(angle) from where the full resolution hands over to the coarse grid
    float fade_end;
    vec2 centre_px;
    float disc_px;
    mat2 px_from_disc;    // columns: pixels per disc radius along the pattern's u and v
};

vec4 light_texel(int light, int texel) { return texelFetch(lights, light * texels_per_light + texel); }

Light fetch_light(int index) {
    Light light;
    vec4 t = light_texel(index, 0);
    light.direction = t.xyz;
    light.distance_m = t.w;
    light.illuminance = light_texel(index, 1);
    t = light_texel(index, 2);
    light.disc_chord = t.x;
    light.disc_nodes = t.y;
    light.fade_start = t.z;
    light.fade_end = t.w;
    t = light_texel(index, 6);
    light.centre_px = t.xy;
    light.disc_px = t.z;
    t = light_texel(index, 7);
    light.px_from_disc = mat2(t.xy, t.zw);
    return light;
}

// A lamp in front of a near wall is as bright as fits a float: no sum of lights may reach infinity.
const float largest_luminance = 1e30;
vec4 finite_light(vec4 value) {
    value = clamp(value, vec4(-largest_luminance), vec4(largest_luminance));
    // A NaN compares false with everything.
    bool sound = all(lessThanEqual(abs(value), vec4(largest_luminance)));
    return sound ? value : vec4(0.0);
}
