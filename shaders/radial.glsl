// What the fragments of grid_quad.vert.glsl share. Windows and tables are those of shaders/gather.cl.
//
// TWO_LAYERS, TAIL, FADES, LASHES are defined where a rectangle needs them: a rasteriser on a CPU takes both sides of every
// branch, so that what few rectangles need would be paid for by all.
uniform sampler2D radial;  // a row for each table: RadialTable in glare/apply/pattern_profile.h
uniform float cell_px;     // of the grid drawn to; 1: the picture
uniform vec2 first_px;     // where the buffer's node (0, 0) stands, less half a cell
uniform vec3 ray_constant; // of pixel (0, 0), not normalised
uniform vec3 ray_per_x;
uniform vec3 ray_per_y;
flat in vec3 along_u;
flat in vec3 along_v;
flat in vec3 towards;
flat in vec4 illuminance;
flat in vec4 skirt_lux;
flat in vec4 fade;
flat in vec4 ends;
flat in vec3 lash;
flat in ivec2 tables;
flat in float upper;

// Where a fragment lies in a light's pattern.
struct Place {
    vec2 offset;   // nodes
    float q;       // its square
    float cosine;  // to the light
};
Place place_of_fragment() {
    vec2 px = gl_FragCoord.xy * cell_px + first_px;
    vec3 ray = ray_constant + ray_per_x * px.x + ray_per_y * px.y;
    float per_length = inversesqrt(dot(ray, ray));
    Place place;
    place.offset = vec2(along_u.x + along_u.y * px.x + along_u.z * px.y,
                        along_v.x + along_v.y * px.x + along_v.z * px.y) * per_length;
    place.q = dot(place.offset, place.offset);
    place.cosine = (towards.x + towards.y * px.x + towards.z * px.y) * per_length;
    return place;
}

// Where in its pattern a light's offset is taken from: turned and bent by its lashes (shaders/lash_warp.glsl).
vec2 warped(vec2 offset) {
#ifdef LASHES
    vec2 at = vec2(lash.x * offset.x + lash.y * offset.y, lash.x * offset.y - lash.y * offset.x);
    at.y -= lash.z * at.x * at.x;
    return at;
#else
    return offset;
#endif
}

// Half a cosine from 1 at t = 0 to 0 at t = 1; errs by less than 1e-4.
float falling(float t) {
    float u = clamp(t, 0.0, 1.0) - 0.5;
    float u2 = u * u;
    return 0.5 - 0.5 * u * (3.14159265 + u2 * (-5.16771278 + u2 * (2.55016404 + u2 * -0.57983)));
}
// How much of a light belongs to a level, at a distance in nodes.
float risen(float distance) {
    return distance > fade.x ? 1.0 - ends.x * falling((distance - fade.x) * fade.y) : 1.0 - ends.x;
}
float not_fallen(float distance) {
    float t = (distance - fade.z) * fade.w;
    return t < 1.0 ? 1.0 - ends.y * (1.0 - falling(t)) : 1.0 - ends.y;
}

// psf of a table at a squared distance.
vec4 radial_at(int table, float q) {
    float within = clamp(q, 4.0, 1048575.0);
    uint bits = floatBitsToUint(within) - 0x40800000u;
    int entry = int(bits >> 19);
    float t = float(int(bits & 0x7ffffu)) * (1.0 / 524288.0);
    return mix(texelFetch(radial, ivec2(entry, table), 0), texelFetch(radial, ivec2(entry + 1, table), 0), t) *
           (1.0 / within);
}
vec4 mean_at(float q) {
#ifdef TWO_LAYERS
    return mix(radial_at(tables.x, q), radial_at(tables.y, q), upper);
#else
    return radial_at(tables.x, q);
#endif
}
