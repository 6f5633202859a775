// Adds lights up by gathering: each group of work-items owns a tile of the picture and sums the lights that reach it.
//
// The picture is a pyramid of grids. Node (i, j) of level l stands at pixel (0.5, 0.5) + 2^l (i - pad, j - pad); the finest
// level is the picture itself, without padding. A light's glare is divided among the levels by distance, by windows that
// add up to one: what is near it on the picture, with all its structure, what is farther, where only the mean over the
// azimuth is left, on coarser and coarser grids. Levels are summed from coarse to fine, and each begins with the level
// above it, interpolated by cubics through four nodes. glare/apply/tile_lists decides who goes where, with what error.

// Must agree with GatherLight and GatherEntry in glare/apply/tile_lists.h.
typedef struct {
    // Direction cosines of a pixel's ray, in nodes of the pattern, along the light's u and v, times the length of the ray;
    // and the cosine to the light: constant, per px in x, per px in y.
    float4 along_u;  // w: bits of the index of the lower layer's table
    float4 along_v;  // w: bits of the index of the upper layer's table
    float4 towards;  // w: share of the upper layer
    float4 illuminance;
    float4 lash;     // cosine and sine of the turn, bend in nodes; w: from where on it shows departures, nodes
} Light;
typedef struct {
    int light;
    // Nodes of the level: first and last column, first and last row; sixteen bits each.
    uint columns;
    uint rows;
    int unused;
    // Distances in nodes of the pattern: fades in over the first two, out over the others. Negative: it does not.
    float4 fade;
} Entry;

// As Departure in glare/apply/departure_lists.h.
typedef struct {
    int light;  // below zero: -1 less it, and its lower layer will do
    float reach2;
} Departure;

typedef struct {
    float4 ray_constant;
    float4 ray_per_x;  // per px
    float4 ray_per_y;
} Rays;

// A work-item sums a block of STRIP x ROWS nodes; a group covers a tile of 32 x 16. A CPU keeps the part of the pattern that
// a light needs in its cache while it walks down the rows; a GPU has more items and keeps its sums in registers.
#define STRIP 8
#ifndef ROWS
#define ROWS 1
#endif
#define FADE_RATIO 1.75f  // glare/apply/tile_lists.cpp
#define ENTRY_SHIFT 19  // glare/apply/pattern_profile.h

// any() tests lane by lane on some devices.
int some(int8 lanes) {
    const int4 four = lanes.lo | lanes.hi;
    const int2 two = four.lo | four.hi;
    return (two.x | two.y) < 0;
}

// Half a cosine from 1 at t = 0 to 0 at t = 1; errs by less than 1e-4.
float8 falling(float8 t) {
    const float8 u = clamp(t, 0.0f, 1.0f) - 0.5f;
    const float8 u2 = u * u;
    return 0.5f - 0.5f * u * (3.14159265f + u2 * (-5.16771278f + u2 * (2.55016404f + u2 * -0.57983f)));
}

// How much of a light belongs to a level, at a distance in nodes.
float8 share_of(float8 distance, float4 fade) {
    float8 share = (float8)(1.0f);
    if (fade.y > 0.0f) {
        share -= falling((distance - fade.x) * (1.0f / (fade.y - fade.x)));
        share = select(share, (float8)(0.0f), distance <= fade.x);
    }
    if (fade.w > 0.0f) {
        share *= falling((distance - fade.z) * (1.0f / (fade.w - fade.z)));
        share = select(share, (float8)(0.0f), distance >= fade.w);
    }
    return share;
}

// Eight nodes interpolated between those of the level above, which lie in columns first ... first + 6 of its rows.
void upsample(__global const float4* above, int above_width, int x, int y, int pad, float4* sum) {
    const int row = y - pad + 4;  // never negative, and as odd as the offset from the picture's first row
    __global const float4* at = above + (size_t)(row >> 1) * above_width + (x >> 1) + 1 - (pad >> 1);
    float4 c[7];
    for (int k = 0; k < 7; ++k)
        c[k] = at[k];
    if ((row & 1) != 0) {
        __global const float4* before = at - above_width;
        __global const float4* next = at + above_width;
        __global const float4* after = next + above_width;
        for (int k = 0; k < 7; ++k)
            c[k] = 0.5625f * (c[k] + next[k]) - 0.0625f * (before[k] + after[k]);
    }
    for (int k = 0; k < 4; ++k) {
        sum[2 * k] = c[k + 1];
        sum[2 * k + 1] = 0.5625f * (c[k + 1] + c[k + 2]) - 0.0625f * (c[k] + c[k + 3]);
    }
}

// Where a strip's first rays go: the light's offsets and cosine in it.
typedef struct {
    float8 px;
    float8 x, y, z;  // of the ray in row 0
} Strip;
Strip strip_at(Rays rays, float first_px, float cell_px) {
    Strip s;
    s.px = (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f) * cell_px + first_px;
    s.x = rays.ray_constant.x + rays.ray_per_x.x * s.px;
    s.y = rays.ray_constant.y + rays.ray_per_x.y * s.px;
    s.z = rays.ray_constant.z + rays.ray_per_x.z * s.px;
    return s;
}
float8 inverse_square_length(Rays rays, Strip s, float py) {
    const float8 x = s.x + rays.ray_per_y.x * py;
    const float8 y = s.y + rays.ray_per_y.y * py;
    const float8 z = s.z + rays.ray_per_y.z * py;
    return 1.0f / (x * x + y * y + z * z);
}

#define EACH(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7)

// Adds the radial mean of a pattern at eight squared distances, times weights.
#define MEAN_AT(k)                                                                                      \
    {                                                                                                   \
        __global const float4* at = table + entry.s##k;                                                 \
        sum[k] = fma(fma(at[1] - at[0], t.s##k, at[0]), w.s##k * illuminance, sum[k]);                  \
    }
void add_mean(__global const float4* table, float8 q, float8 weight, float4 illuminance, float4* sum) {
    const float8 within = clamp(q, 4.0f, 1048575.0f);
    const uint8 bits = as_uint8(within) - 0x40800000u;
    const int8 entry = convert_int8(bits >> ENTRY_SHIFT);
    const float8 t = convert_float8(as_int8(bits & ((1u << ENTRY_SHIFT) - 1u))) * (1.0f / (1 << ENTRY_SHIFT));
    const float8 w = weight / within;
    EACH(MEAN_AT)
}

// Adds a layer of a pattern, bilinearly, times weights. Two neighbours lie together in memory: one load.
#define LAYER_AT(k)                                                                        \
    {                                                                                      \
        __global const half* at = layer + index.s##k;                                      \
        const float8 low = vload_half8(0, at);                                             \
        const float8 pair = fma(vload_half8(0, at + row_halves) - low, tv.s##k, low);      \
        sum[k] = fma(fma(pair.hi - pair.lo, tu.s##k, pair.lo), weight.s##k * illuminance, sum[k]); \
    }
void add_layer(__global const half* layer, int row_halves, int8 index, float8 tu, float8 tv, float8 weight,
               float4 illuminance, float4* sum) {
    EACH(LAYER_AT)
}

// Where in its pattern a light's offset is taken from: turned and bent by its lashes (shaders/lash_warp.glsl).
void lash_warp(Light light, float8 u, float8 v, float8* at_u, float8* at_v) {
    *at_u = light.lash.x * u + light.lash.y * v;
    *at_v = light.lash.x * v - light.lash.y * u - light.lash.z * *at_u * *at_u;
}

// The nodes of a pattern's layers, or of their departures from the mean.
typedef struct {
    int radius;
    float scale;
} Nodes;

// Adds a light's layers at eight offsets, in nodes, times weights.
void add_skirt(Nodes nodes, Light light, __global const half* lower_layer, __global const half* upper_layer,
               float8 u, float8 v, float8 weight, float4* sum) {
    if (light.lash.y != 0.0f || light.lash.z != 0.0f) {
        float8 bent_u, bent_v;
        lash_warp(light, u, v, &bent_u, &bent_v);
        u = bent_u;
        v = bent_v;
    }
    const int side = 2 * nodes.radius + 1;
    const float last = (float)(2 * nodes.radius);
    const float upper = light.towards.w;
    u += (float)nodes.radius;
    v += (float)nodes.radius;
    const float8 bu = clamp(floor(u), 0.0f, last - 1.0f);
    const float8 bv = clamp(floor(v), 0.0f, last - 1.0f);
    const float8 tu = u - bu;
    const float8 tv = v - bv;
    // Beyond the table there is nothing.
    weight = select(weight, (float8)(0.0f), (fabs(tu - 0.5f) > 0.5f) | (fabs(tv - 0.5f) > 0.5f));
    if (!some(weight > 0.0f)) return;
    const int8 index = (convert_int8(bv) * side + convert_int8(bu)) * 4;
    add_layer(lower_layer, 4 * side, index, tu, tv, weight * ((1.0f - upper) * nodes.scale),
              light.illuminance, sum);
    if (upper > 0.0f)
        add_layer(upper_layer, 4 * side, index, tu, tv, weight * (upper * nodes.scale),
                  light.illuminance, sum);
}

void store_row(__global float4* out, const float4* sum, int x, int y, int width) {
    for (int k = 0; k < STRIP; ++k) {
        const float4 sound = select(sum[k], (float4)(0.0f), isnan(sum[k]));
        if (x + k < width) out[(size_t)y * width + x + k] = clamp(sound, -1e30f, 1e30f);
    }
}

// The rows of a work-item's block that a light reaches; none when it does not reach the columns.
int2 rows_reached(Entry reach, int x, int y) {
    if (x + STRIP <= (int)(reach.columns & 0xffffu) || x > (int)(reach.columns >> 16)) return (int2)(0, 0);
    return (int2)(max((int)(reach.rows & 0xffffu) - y, 0), min((int)(reach.rows >> 16) - y + 1, ROWS));
}

// One level of smooth light.
__kernel void gather_mean(Rays rays, float cell_px, int pad, int width, int height, __global const Light* lights,
                          __global const Entry* entries, __global const int* tile_begin, int first_tile,
                          __global const int* tile_entries, int tiles_across, __global const float4* tables,
                          int table_entries, __global const float4* above, int above_width,
                          __global float4* out) {
    const int x = STRIP * (int)get_global_id(0);
    const int y = ROWS * (int)get_global_id(1);
    if (x >= width || y >= height) return;
    const int rows = min(height - y, ROWS);
    const Strip strip = strip_at(rays, (float)(x - pad) * cell_px + 0.5f, cell_px);
    float4 sums[ROWS * STRIP];
    float8 per_length2[ROWS];
    for (int r = 0; r < rows; ++r) {
        for (int k = 0; k < STRIP; ++k)
            sums[r * STRIP + k] = (float4)(0.0f);
        if (above_width > 0) upsample(above, above_width, x, y + r, pad, sums + r * STRIP);
        per_length2[r] = inverse_square_length(rays, strip, (float)(y + r - pad) * cell_px + 0.5f);
    }
    const int tile = first_tile + (int)(get_group_id(1) * tiles_across + get_group_id(0));
    const int end = tile_begin[tile + 1];
    for (int i = tile_begin[tile]; i < end; ++i) {
        const Entry reach = entries[tile_entries[i]];
        const int2 reached = rows_reached(reach, x, y);
        if (reached.x >= reached.y) continue;
        const Light light = lights[reach.light];
        const float upper = light.towards.w;
        __global const float4* lower_table = tables + as_int(light.along_u.w) * table_entries;
        __global const float4* upper_table = tables + as_int(light.along_v.w) * table_entries;
        const float8 u0 = light.along_u.x + light.along_u.y * strip.px;
        const float8 v0 = light.along_v.x + light.along_v.y * strip.px;
        const float8 c0 = light.towards.x + light.towards.y * strip.px;
        for (int r = reached.x; r < reached.y; ++r) {
            const float py = (float)(y + r - pad) * cell_px + 0.5f;
            const float8 u = u0 + light.along_u.z * py;
            const float8 v = v0 + light.along_v.z * py;
            const float8 q = fma(u, u, v * v) * per_length2[r];
            float8 weight = share_of(sqrt(q), reach.fade);
            // Glare goes no further than a quarter turn; the last ten degrees fade, so that no edge shows.
            const float8 cosine = (c0 + light.towards.z * py) * sqrt(per_length2[r]);
            const float8 fading = clamp(cosine * (1.0f / 0.17f), 0.0f, 1.0f);
            weight *= fading * fading * (3.0f - 2.0f * fading);
            if (!some(weight > 0.0f)) continue;
            add_mean(lower_table, q, weight * (1.0f - upper), light.illuminance, sums + r * STRIP);
            if (upper > 0.0f) add_mean(upper_table, q, weight * upper, light.illuminance, sums + r * STRIP);
        }
    }
    for (int r = 0; r < rows; ++r)
        store_row(out, sums + r * STRIP, x, y + r, width);
}

// The picture itself, from a row of it on: what is near the lights, with all the structure of their patterns, and what the
// lights that show there (glare/apply/departure_lists.h) have beside the mean of the grids. Tiles of the departures are
// counted from first_departing on.
__kernel void gather_structure(Rays rays, int first_row, int width, int height, __global const Light* lights,
                               __global const Entry* entries, __global const int* tile_begin, int first_tile,
                               __global const int* tile_entries, int tiles_across,
                               __global const float4* tables, int table_entries, int tail_table,
                               float tail_from_nodes, __global const half* skirt,
                               float skirt_scale, int radius,
                               __global const half* departures, float departures_scale,
                               __global const int* departing_begin, int first_departing,
                               __global const Departure* departing, __global const float4* above, int above_width,
                               __global float4* out) {
    const int x = STRIP * (int)get_global_id(0);
    const int y = first_row + ROWS * (int)get_global_id(1);
    if (x >= width || y >= height) return;
    const int rows = min(height - y, ROWS);
    const Strip strip = strip_at(rays, (float)x + 0.5f, 1.0f);
    float4 sums[ROWS * STRIP];
    float8 per_length[ROWS];
    for (int r = 0; r < rows; ++r) {
        for (int k = 0; k < STRIP; ++k)
            sums[r * STRIP + k] = (float4)(0.0f);
        if (above_width > 0) upsample(above, above_width, x, y + r, 0, sums + r * STRIP);
        per_length[r] = sqrt(inverse_square_length(rays, strip, (float)(y + r) + 0.5f));
    }
    const Nodes whole = {radius, skirt_scale};
    const Nodes departed = {radius, departures_scale};
    const size_t layer_halves = (size_t)(2 * radius + 1) * (2 * radius + 1) * 4;
    const int in_band = (int)(get_group_id(1) * tiles_across + get_group_id(0));
    const int tile = first_tile + in_band;
    const int end = tile_begin[tile + 1];
    for (int i = tile_begin[tile]; i < end; ++i) {
        const Entry reach = entries[tile_entries[i]];
        const int2 reached = rows_reached(reach, x, y);
        if (reached.x >= reached.y) continue;
        const Light light = lights[reach.light];
        __global const half* lower_layer = skirt + (size_t)as_int(light.along_u.w) * layer_halves;
        __global const half* upper_layer = skirt + (size_t)as_int(light.along_v.w) * layer_halves;
        const float8 u0 = light.along_u.x + light.along_u.y * strip.px;
        const float8 v0 = light.along_v.x + light.along_v.y * strip.px;
        const float8 c0 = light.towards.x + light.towards.y * strip.px;
        for (int r = reached.x; r < reached.y; ++r) {
            const float py = (float)(y + r) + 0.5f;
            const float8 u = (u0 + light.along_u.z * py) * per_length[r];
            const float8 v = (v0 + light.along_v.z * py) * per_length[r];
            const float8 q = fma(u, u, v * v);
            float8 weight = (float8)(1.0f);
            if (some(q > reach.fade.z * reach.fade.z)) {
                weight = share_of(sqrt(q), reach.fade);
                if (!some(weight > 0.0f)) continue;
            }
            const float8 cosine = c0 + light.towards.z * py;
            weight = select(weight, (float8)(0.0f), cosine <= 0.0f);
            if (some(q > tail_from_nodes * tail_from_nodes))
                add_mean(tables + tail_table * table_entries, q, weight, light.illuminance, sums + r * STRIP);
            add_skirt(whole, light, lower_layer, upper_layer, u, v, weight, sums + r * STRIP);
        }
    }
    // What lights farther away show beside the mean that the grids have.
    const int last_light = departing_begin[first_departing + in_band + 1];
    for (int i = departing_begin[first_departing + in_band]; i < last_light; ++i) {
        const Departure departure = departing[i];
        Light light = lights[departure.light < 0 ? -1 - departure.light : departure.light];
        if (departure.light < 0) light.towards.w = 0.0f;
        const int lower_table = as_int(light.along_u.w);
        const int upper_table = as_int(light.along_v.w);
        __global const half* lower_layer = departures + (size_t)lower_table * layer_halves;
        __global const half* upper_layer = departures + (size_t)upper_table * layer_halves;
        const float8 u0 = light.along_u.x + light.along_u.y * strip.px;
        const float8 v0 = light.along_v.x + light.along_v.y * strip.px;
        const float8 c0 = light.towards.x + light.towards.y * strip.px;
        const float from = light.lash.w;
        for (int r = 0; r < rows; ++r) {
            const float py = (float)(y + r) + 0.5f;
            const float8 u = (u0 + light.along_u.z * py) * per_length[r];
            const float8 v = (v0 + light.along_v.z * py) * per_length[r];
            const float8 q = fma(u, u, v * v);
            if (!some(q < departure.reach2)) continue;
            float8 weight = (float8)(1.0f);
            if (some(q < FADE_RATIO * FADE_RATIO * from * from))
                weight -= falling((sqrt(q) - from) * (1.0f / ((FADE_RATIO - 1.0f) * from)));
            weight = select(weight, (float8)(0.0f),
                            (c0 + light.towards.z * py <= 0.0f) | (q <= from * from) | (q >= departure.reach2));
            if (light.lash.z != 0.0f) {
                // A bent pattern departs from the mean around the place that it was bent from.
                float8 bent_u, bent_v;
                lash_warp(light, u, v, &bent_u, &bent_v);
                const float8 bent = fma(bent_u, bent_u, bent_v * bent_v);
                const float8 within = select(weight, (float8)(0.0f), bent > (float)(radius * radius));
                const float upper = light.towards.w;
                add_mean(tables + lower_table * table_entries, bent, within * (1.0f - upper), light.illuminance, sums + r * STRIP);
                add_mean(tables + lower_table * table_entries, q, within * (upper - 1.0f), light.illuminance, sums + r * STRIP);
                if (upper > 0.0f) {
                    add_mean(tables + upper_table * table_entries, bent, within * upper, light.illuminance, sums + r * STRIP);
                    add_mean(tables + upper_table * table_entries, q, within * -upper, light.illuminance, sums + r * STRIP);
                }
            }
            add_skirt(departed, light, lower_layer, upper_layer, u, v, weight, sums + r * STRIP);
        }
    }
    for (int r = 0; r < rows; ++r)
        store_row(out, sums + r * STRIP, x, y - first_row + r, width);
}
