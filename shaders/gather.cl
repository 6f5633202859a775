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
// a light needs in its cache while it walks down the rows, as many at once as its vectors hold; a GPU has more items and keeps
// its sums in registers.
#define STRIP 8
#ifndef ROWS
#define ROWS 1
#endif
#define FADE_RATIO 1.75f  // glare/apply/tile_lists.cpp
#define ENTRY_SHIFT 19  // glare/apply/pattern_profile.h

#if ROWS == 1
// One row at a time, a sum to a node.
#define ROWS_AT_ONCE 1
typedef float8 Lanes;
typedef uint8 LaneBits;
typedef int8 LaneInts;
#define as_bits as_uint8
#define as_ints as_int8
#define to_ints convert_int8
#define to_floats convert_float8
#define COLUMNS (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f)
#define ROW_OF_LANE (float8)(0.0f)
typedef float Rows;
#define ROW_NUMBERS 0.0f
uint row_bits(int within) { return within != 0 ? 1u : 0u; }
typedef float4 MeanSum;
typedef float4 NodeSum;
#define folded_mean(sum) (sum)
#define folded_nodes(sum) (sum)
#else
// Two rows at a time. A sum holds two or four partial sums of a node's channels, one for each node of the pattern that lies
// around it: so they are added without being taken apart.
#define ROWS_AT_ONCE 2
typedef float16 Lanes;
typedef uint16 LaneBits;
typedef int16 LaneInts;
#define as_bits as_uint16
#define as_ints as_int16
#define to_ints convert_int16
#define to_floats convert_float16
#define COLUMNS (float16)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f)
#define ROW_OF_LANE (float16)((float8)(0.0f), (float8)(1.0f))
typedef float16 Rows;
#define ROW_NUMBERS \
    (float16)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 8.0f, 9.0f, 10.0f, 11.0f, 12.0f, 13.0f, 14.0f, 15.0f)
uint row_bits(int16 within) {
    const int16 bits = within & (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
    const int8 eight = bits.lo | bits.hi;
    const int4 four = eight.lo | eight.hi;
    const int2 two = four.lo | four.hi;
    return (uint)(two.x | two.y);
}
typedef float8 MeanSum;
typedef float16 NodeSum;
float4 folded_mean(float8 sum) { return sum.lo + sum.hi; }
float4 folded_nodes(float16 sum) { return folded_mean(sum.lo + sum.hi); }
#endif
#define STEPS (ROWS / ROWS_AT_ONCE)
#define LANES (STRIP * ROWS_AT_ONCE)
#define ALL_ROWS ((1u << ROWS) - 1u)
#define OF_STEP(bits, step) (((bits) >> ((step) * ROWS_AT_ONCE)) & ((1u << ROWS_AT_ONCE) - 1u))

// Half a cosine from 1 at t = 0 to 0 at t = 1; errs by less than 1e-4.
Lanes falling(Lanes t) {
    const Lanes u = clamp(t, 0.0f, 1.0f) - 0.5f;
    const Lanes u2 = u * u;
    return 0.5f - 0.5f * u * (3.14159265f + u2 * (-5.16771278f + u2 * (2.55016404f + u2 * -0.57983f)));
}
// How much of a light is there beyond `from`, where it rises, or before `to`, where it is gone.
Lanes rising_from(Lanes distance, float from, float to) {
    return select(1.0f - falling((distance - from) * (1.0f / (to - from))), (Lanes)(0.0f), distance <= from);
}
Lanes falling_to(Lanes distance, float from, float to) {
    return select(falling((distance - from) * (1.0f / (to - from))), (Lanes)(0.0f), distance >= to);
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

// A function of the pixel's place, x and y px from a block's first node: constant, per px in x, per px in y.
float from_first(float4 linear, float2 first_px) { return linear.x + linear.y * first_px.x + linear.z * first_px.y; }

// A quadratic function of the pixel's place.
typedef struct {
    float xx, xy, yy, x, y, one;
} Quadratic;
// The square of a linear function, added.
void add_square(Quadratic* to, float one, float x, float y) {
    to->xx += x * x;
    to->xy += 2.0f * x * y;
    to->yy += y * y;
    to->x += 2.0f * one * x;
    to->y += 2.0f * one * y;
    to->one += one * one;
}

// A block of nodes: where its first lies, and the rays through all.
typedef struct {
    float2 first_px;
    float cell_px;
    float2 size_px;  // from the first node to the last
    Quadratic length2;  // of the rays
    float least_per_length;
} Block;
Block block_at(Rays rays, float2 first_px, float cell_px) {
    Block b;
    b.first_px = first_px;
    b.cell_px = cell_px;
    b.size_px = (float2)(STRIP - 1, ROWS - 1) * cell_px;
    const float4 first = rays.ray_constant + rays.ray_per_x * first_px.x + rays.ray_per_y * first_px.y;
    const Quadratic none = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    b.length2 = none;
    add_square(&b.length2, first.x, rays.ray_per_x.x, rays.ray_per_y.x);
    add_square(&b.length2, first.y, rays.ray_per_x.y, rays.ray_per_y.y);
    add_square(&b.length2, first.z, rays.ray_per_x.z, rays.ray_per_y.z);
    // Longest in a corner.
    const Quadratic q = b.length2;
    const float right = b.size_px.x * (q.x + q.xx * b.size_px.x);
    const float top = b.size_px.y * (q.y + q.yy * b.size_px.y);
    const float both = right + top + q.xy * b.size_px.x * b.size_px.y;
    b.least_per_length = rsqrt(q.one + max(max(right, top), max(both, 0.0f)));
    return b;
}
Lanes inverse_square_length(Block b, int step) {
    const Lanes x = COLUMNS * b.cell_px;
    const Lanes y = (ROW_OF_LANE + (float)(step * ROWS_AT_ONCE)) * b.cell_px;
    const Quadratic q = b.length2;
    return 1.0f / (q.one + x * (q.x + q.xx * x) + y * (q.y + q.xy * x + q.yy * y));
}

// A light as a block sees it.
typedef struct {
    // Over the length of the ray: offsets in nodes of the pattern, and the cosine. In the first rows, and from step to step.
    Lanes u, v, cosine;
    float u_step, v_step, cosine_step;
    float least_cosine;  // of the block, over the length of the ray
} Seen;
Lanes first_rows(Block b, float4 linear) {
    return from_first(linear, b.first_px) + (linear.y * b.cell_px) * COLUMNS + (linear.z * b.cell_px) * ROW_OF_LANE;
}
Quadratic square_of(Block b, __global const Light* light) {
    Quadratic q = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    add_square(&q, from_first(light->along_u, b.first_px), light->along_u.y, light->along_u.z);
    add_square(&q, from_first(light->along_v, b.first_px), light->along_v.y, light->along_v.z);
    return q;
}
Seen seen_from(Block b, __global const Light* light) {
    Seen s;
    s.u = first_rows(b, light->along_u);
    s.v = first_rows(b, light->along_v);
    s.cosine = first_rows(b, light->towards);
    const float step = b.cell_px * ROWS_AT_ONCE;
    s.u_step = light->along_u.z * step;
    s.v_step = light->along_v.z * step;
    s.cosine_step = light->towards.z * step;
    s.least_cosine = from_first(light->towards, b.first_px) + min(light->towards.y * b.size_px.x, 0.0f) +
                     min(light->towards.z * b.size_px.y, 0.0f);
    return s;
}

// The rows, a bit for each, of which some node, or every node, lies within a distance of a light: where square - distance^2
// length^2 is negative, which it is in one stretch of a row or none.
uint rows_touching(Block b, Quadratic square, float distance2) {
    const Rows y = ROW_NUMBERS * b.cell_px;
    const float xx = square.xx - distance2 * b.length2.xx;
    const Rows x = (square.x - distance2 * b.length2.x) + (square.xy - distance2 * b.length2.xy) * y;
    const Rows one = (square.one - distance2 * b.length2.one) +
                     y * ((square.y - distance2 * b.length2.y) + (square.yy - distance2 * b.length2.yy) * y);
    const float w = b.size_px.x;
    const float inverse = xx > 0.0f ? -0.5f / xx : 0.0f;
    const Rows at = clamp(x * inverse, 0.0f, w);
    return row_bits((one < 0.0f) | (one + w * (x + w * xx) < 0.0f) | (one + at * (x + at * xx) < 0.0f));
}
uint rows_inside(Block b, Quadratic square, float distance2) {
    const Rows y = ROW_NUMBERS * b.cell_px;
    const float xx = square.xx - distance2 * b.length2.xx;
    const Rows x = (square.x - distance2 * b.length2.x) + (square.xy - distance2 * b.length2.xy) * y;
    const Rows one = (square.one - distance2 * b.length2.one) +
                     y * ((square.y - distance2 * b.length2.y) + (square.yy - distance2 * b.length2.yy) * y);
    const float w = b.size_px.x;
    return row_bits((one < 0.0f) & (one + w * (x + w * xx) < 0.0f));
}

// X(lane as digit, its place among eight, and eight places on).
#define EIGHT_LANES(X) X(0, 0, 8) X(1, 1, 9) X(2, 2, a) X(3, 3, b) X(4, 4, c) X(5, 5, d) X(6, 6, e) X(7, 7, f)
#define NEXT_EIGHT_LANES(X) X(8, 0, 8) X(9, 1, 9) X(a, 2, a) X(b, 3, b) X(c, 4, c) X(d, 5, d) X(e, 6, e) X(f, 7, f)

// Adds the radial mean of a pattern at squared distances, times weights. `sum` is that of the first lane.
#if ROWS == 1
#define MEAN_AT(k, near, far)                                                                          \
    {                                                                                                  \
        __global const float4* at = table + entry.s##k;                                                \
        sum[0x##k] = fma(fma(at[1] - at[0], t.s##k, at[0]), w.s##k * illuminance, sum[0x##k]);         \
    }
#else
#define MEAN_AT(k, near, far)                                                                           \
    sum[0x##k * stride] = fma(vload8(0, (__global const float*)(table + entry.s##k)) * twice,           \
                              pairs.s##near##near##near##near##far##far##far##far, sum[0x##k * stride]);
#endif
__attribute__((noinline)) void add_mean(__global const float4* table, Lanes q, Lanes weight, float4 illuminance,
                                        MeanSum* sum, int stride) {
    const Lanes within = clamp(q, 4.0f, 1048575.0f);
    const LaneBits bits = as_bits(within) - 0x40800000u;
    const LaneInts entry = as_ints(bits >> ENTRY_SHIFT);
    const Lanes t = to_floats(as_ints(bits & ((1u << ENTRY_SHIFT) - 1u))) * (1.0f / (1 << ENTRY_SHIFT));
    const Lanes w = weight / within;
#if ROWS == 1
    EIGHT_LANES(MEAN_AT)
#else
    const float8 twice = (float8)(illuminance, illuminance);
    const Lanes far_weight = w * t;
    const Lanes near_weight = w - far_weight;
    float16 pairs = (float16)(near_weight.lo, far_weight.lo);
    EIGHT_LANES(MEAN_AT)
    pairs = (float16)(near_weight.hi, far_weight.hi);
    NEXT_EIGHT_LANES(MEAN_AT)
#endif
}

// The nodes of a pattern's layers, or of their departures from the mean.
typedef struct {
    int radius;
    float scale;
} Nodes;

// Adds a layer of a pattern, or a share of it and `upper` of the one above it, bilinearly, at offsets in nodes, times weights.
// `sum` is that of the first lane. Two neighbours lie together in memory: one load.
#if ROWS == 1
#define NODES_AT(k, near, far)                                                             \
    {                                                                                      \
        __global const half* at = layer + index.s##k;                                      \
        float8 low = vload_half8(0, at);                                                   \
        float8 high = vload_half8(0, at + row_halves);                                     \
        if (upper > 0.0f) {                                                                \
            __global const half* over = upper_layer + index.s##k;                          \
            low += (vload_half8(0, over) - low) * upper;                                   \
            high += (vload_half8(0, over + row_halves) - high) * upper;                    \
        }                                                                                  \
        const float8 pair = fma(high - low, tv.s##k, low);                                 \
        sum[0x##k] = fma(fma(pair.hi - pair.lo, tu.s##k, pair.lo), weight.s##k * illuminance, sum[0x##k]); \
    }
#else
#define NODES_AT(k, from, a, b, c, d)                                                                      \
    {                                                                                                      \
        __global const half* at = layer + index.s##k;                                                      \
        const float16 four = (float16)(vload_half8(0, at), vload_half8(0, at + row_halves));               \
        sum[0x##k] = fma(four * colours, from.s##a##a##a##a##b##b##b##b##c##c##c##c##d##d##d##d, sum[0x##k]); \
    }
#define BOTH_AT(k, from, a, b, c, d)                                                                       \
    {                                                                                                      \
        __global const half* at = layer + index.s##k;                                                      \
        __global const half* over = upper_layer + index.s##k;                                              \
        const float16 low = (float16)(vload_half8(0, at), vload_half8(0, at + row_halves));                \
        const float16 high = (float16)(vload_half8(0, over), vload_half8(0, over + row_halves));           \
        sum[0x##k] = fma(fma(high, colours_above, low * colours),                                          \
                         from.s##a##a##a##a##b##b##b##b##c##c##c##c##d##d##d##d, sum[0x##k]);              \
    }
#define LANES_BY_WEIGHTS(X)                                                                                   \
    X(0, from_0, 0, 1, 2, 3) X(1, from_0, 4, 5, 6, 7) X(2, from_0, 8, 9, a, b) X(3, from_0, c, d, e, f)       \
    X(4, from_4, 0, 1, 2, 3) X(5, from_4, 4, 5, 6, 7) X(6, from_4, 8, 9, a, b) X(7, from_4, c, d, e, f)       \
    X(8, from_8, 0, 1, 2, 3) X(9, from_8, 4, 5, 6, 7) X(a, from_8, 8, 9, a, b) X(b, from_8, c, d, e, f)       \
    X(c, from_c, 0, 1, 2, 3) X(d, from_c, 4, 5, 6, 7) X(e, from_c, 8, 9, a, b) X(f, from_c, c, d, e, f)
// Written as one shuffle of two halves put together each: of vectors made element by element compilers make chains of shuffles
// that wait for each other.
#define FIRST_ALTERNATE(a, b) (((float16)((a).lo, (b).lo)).s08192a3b4c5d6e7f)
#define LAST_ALTERNATE(a, b) (((float16)((a).hi, (b).hi)).s08192a3b4c5d6e7f)
#define FIRST_PAIRS(a, b) (((float16)((a).lo, (b).lo)).s018923ab45cd67ef)
#define LAST_PAIRS(a, b) (((float16)((a).hi, (b).hi)).s018923ab45cd67ef)
#endif
__attribute__((always_inline)) void add_nodes(Nodes nodes, __global const half* layer, __global const half* upper_layer,
                                         float upper, Lanes u, Lanes v, Lanes weight, float4 illuminance,
                                         NodeSum* sum) {
    const int side = 2 * nodes.radius + 1;
    const int row_halves = 4 * side;
    const float last = (float)(2 * nodes.radius);
    u += (float)nodes.radius;
    v += (float)nodes.radius;
    // Beyond the table there is nothing.
    const Lanes within_u = min(max(u, 0.0f), last);
    const Lanes within_v = min(max(v, 0.0f), last);
    weight = select((Lanes)(0.0f), weight * nodes.scale, (u == within_u) & (v == within_v));
    const LaneInts node_u = to_ints(min(within_u, last - 1.0f));
    const LaneInts node_v = to_ints(min(within_v, last - 1.0f));
    const LaneInts index = (node_v * side + node_u) * 4;
    const Lanes tu = within_u - to_floats(node_u);
    const Lanes tv = within_v - to_floats(node_v);
#if ROWS == 1
    EIGHT_LANES(NODES_AT)
#else
    const Lanes right = weight * tu;
    const Lanes left = weight - right;
    const Lanes high_right = right * tv;
    const Lanes high_left = left * tv;
    const Lanes low_right = right - high_right;
    const Lanes low_left = left - high_left;
    const float8 twice = (float8)(illuminance, illuminance);
    const float16 colours_above = (float16)(twice, twice) * upper;
    const float16 colours = (float16)(twice, twice) - colours_above;
    // The four weights of a lane side by side.
    const float16 low_first = FIRST_ALTERNATE(low_left, low_right);
    const float16 low_last = LAST_ALTERNATE(low_left, low_right);
    const float16 high_first = FIRST_ALTERNATE(high_left, high_right);
    const float16 high_last = LAST_ALTERNATE(high_left, high_right);
    const float16 from_0 = FIRST_PAIRS(low_first, high_first);
    const float16 from_4 = LAST_PAIRS(low_first, high_first);
    const float16 from_8 = FIRST_PAIRS(low_last, high_last);
    const float16 from_c = LAST_PAIRS(low_last, high_last);
    if (upper > 0.0f) {
        LANES_BY_WEIGHTS(BOTH_AT)
    } else {
        LANES_BY_WEIGHTS(NODES_AT)
    }
#endif
}

// Where in its pattern a light's offset is taken from: turned and bent by its lashes (shaders/lash_warp.glsl).
void lash_warp(float4 lash, Lanes u, Lanes v, Lanes* at_u, Lanes* at_v) {
    *at_u = lash.x * u + lash.y * v;
    *at_v = lash.x * v - lash.y * u - lash.z * *at_u * *at_u;
}

void store_node(__global float4* out, float4 sum) {
    const float4 sound = select(sum, (float4)(0.0f), isnan(sum));
    *out = clamp(sound, -1e30f, 1e30f);
}

// The rows of a block that a light's rectangle has, a bit for each; none when it does not have the columns.
uint rows_reached(__global const Entry* reach, int x, int y) {
    if (x + STRIP <= (int)(reach->columns & 0xffffu) || x > (int)(reach->columns >> 16)) return 0;
    const int first = max((int)(reach->rows & 0xffffu) - y, 0);
    const int end = min((int)(reach->rows >> 16) - y + 1, ROWS);
    return first < end ? (1u << end) - (1u << first) : 0u;
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
    const Block block = block_at(rays, (float2)(x - pad, y - pad) * cell_px + 0.5f, cell_px);
    MeanSum sums[ROWS * STRIP];
    Lanes per_length2[STEPS];
    for (int k = 0; k < ROWS * STRIP; ++k)
        sums[k] = (MeanSum)(0.0f);
    for (int step = 0; step < STEPS; ++step)
        per_length2[step] = inverse_square_length(block, step);
    const int tile = first_tile + (int)(get_group_id(1) * tiles_across + get_group_id(0));
    const int end = tile_begin[tile + 1];
    for (int i = tile_begin[tile]; i < end; ++i) {
        __global const Entry* reach = entries + tile_entries[i];
        uint rows = rows_reached(reach, x, y);
        if (rows == 0) continue;
        __global const Light* light = lights + reach->light;
        const Quadratic square = square_of(block, light);
        const float4 fade = reach->fade;
        uint rising = 0;
        uint falling_off = 0;
        if (fade.w > 0.0f) rows &= rows_touching(block, square, fade.w * fade.w);
        if (fade.y > 0.0f && rows != 0) {
            rising = rows_touching(block, square, fade.y * fade.y);
            if (rising != 0) rows &= ~rows_inside(block, square, fade.x * fade.x);
        }
        if (rows == 0) continue;
        if (fade.w > 0.0f) falling_off = ~rows_inside(block, square, fade.z * fade.z);
        const Seen seen = seen_from(block, light);
        // Glare goes no further than a quarter turn; the last ten degrees fade, so that no edge shows.
        const bool at_quarter = seen.least_cosine * block.least_per_length < 0.17f;
        const float upper = light->towards.w;
        __global const float4* lower_table = tables + as_int(light->along_u.w) * table_entries;
        __global const float4* upper_table = tables + as_int(light->along_v.w) * table_entries;
        for (int step = 0; step < STEPS; ++step) {
            if (OF_STEP(rows, step) == 0) continue;
            const Lanes u = seen.u + seen.u_step * step;
            const Lanes v = seen.v + seen.v_step * step;
            const Lanes q = fma(u, u, v * v) * per_length2[step];
            Lanes weight = (Lanes)(1.0f);
            if (OF_STEP(rising | falling_off, step) != 0) {
                const Lanes distance = sqrt(q);
                if (fade.y > 0.0f) weight = rising_from(distance, fade.x, fade.y);
                if (fade.w > 0.0f) weight *= falling_to(distance, fade.z, fade.w);
            }
            if (at_quarter) {
                const Lanes cosine = (seen.cosine + seen.cosine_step * step) * sqrt(per_length2[step]);
                const Lanes fading = clamp(cosine * (1.0f / 0.17f), 0.0f, 1.0f);
                weight *= fading * fading * (3.0f - 2.0f * fading);
            }
            MeanSum* sum = sums + step * LANES;
            add_mean(lower_table, q, weight * (1.0f - upper), light->illuminance, sum, 1);
            if (upper > 0.0f) add_mean(upper_table, q, weight * upper, light->illuminance, sum, 1);
        }
    }
    for (int r = 0; r < ROWS && y + r < height; ++r) {
        float4 sum[STRIP];
        for (int k = 0; k < STRIP; ++k)
            sum[k] = (float4)(0.0f);
        if (above_width > 0) upsample(above, above_width, x, y + r, pad, sum);
        for (int k = 0; k < STRIP && x + k < width; ++k)
            store_node(out + (size_t)(y + r) * width + x + k, sum[k] + folded_mean(sums[r * STRIP + k]));
    }
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
    const Block block = block_at(rays, (float2)(x, y) + 0.5f, 1.0f);
    NodeSum sums[ROWS * STRIP];
    Lanes per_length[STEPS];
    for (int k = 0; k < ROWS * STRIP; ++k)
        sums[k] = (NodeSum)(0.0f);
    for (int step = 0; step < STEPS; ++step)
        per_length[step] = sqrt(inverse_square_length(block, step));
    const int stride = sizeof(NodeSum) / sizeof(MeanSum);
    const Nodes whole = {radius, skirt_scale};
    const Nodes departed = {radius, departures_scale};
    const size_t layer_halves = (size_t)(2 * radius + 1) * (2 * radius + 1) * 4;
    const int in_band = (int)(get_group_id(1) * tiles_across + get_group_id(0));
    const int tile = first_tile + in_band;
    const int end = tile_begin[tile + 1];
    for (int i = tile_begin[tile]; i < end; ++i) {
        __global const Entry* reach = entries + tile_entries[i];
        uint rows = rows_reached(reach, x, y);
        if (rows == 0) continue;
        __global const Light* light = lights + reach->light;
        const Quadratic square = square_of(block, light);
        const float4 fade = reach->fade;
        uint falling_off = 0;
        if (fade.w > 0.0f) {
            rows &= rows_touching(block, square, fade.w * fade.w);
            if (rows == 0) continue;
            falling_off = ~rows_inside(block, square, fade.z * fade.z);
        }
        const uint in_tail = ~rows_inside(block, square, tail_from_nodes * tail_from_nodes);
        const Seen seen = seen_from(block, light);
        const float4 lash = light->lash;
        __global const half* lower_layer = skirt + (size_t)as_int(light->along_u.w) * layer_halves;
        __global const half* upper_layer = skirt + (size_t)as_int(light->along_v.w) * layer_halves;
        for (int step = 0; step < STEPS; ++step) {
            if (OF_STEP(rows, step) == 0) continue;
            Lanes u = (seen.u + seen.u_step * step) * per_length[step];
            Lanes v = (seen.v + seen.v_step * step) * per_length[step];
            const Lanes q = fma(u, u, v * v);
            Lanes weight = (Lanes)(1.0f);
            if (OF_STEP(falling_off, step) != 0) weight = falling_to(sqrt(q), fade.z, fade.w);
            if (seen.least_cosine <= 0.0f)
                weight = select(weight, (Lanes)(0.0f), seen.cosine + seen.cosine_step * step <= 0.0f);
            NodeSum* sum = sums + step * LANES;
            if (OF_STEP(in_tail, step) != 0)
                add_mean(tables + tail_table * table_entries, q, weight, light->illuminance, (MeanSum*)sum, stride);
            if (lash.y != 0.0f || lash.z != 0.0f) lash_warp(lash, u, v, &u, &v);
            add_nodes(whole, lower_layer, upper_layer, light->towards.w, u, v, weight, light->illuminance, sum);
        }
    }
    // What lights farther away show beside the mean that the grids have.
    const int last_light = departing_begin[first_departing + in_band + 1];
    for (int i = departing_begin[first_departing + in_band]; i < last_light; ++i) {
        const Departure departure = departing[i];
        __global const Light* light = lights + (departure.light < 0 ? -1 - departure.light : departure.light);
        const Quadratic square = square_of(block, light);
        const float from = light->lash.w;
        uint rows = rows_touching(block, square, departure.reach2);
        if (rows == 0) continue;
        const uint rising = rows_touching(block, square, FADE_RATIO * FADE_RATIO * from * from);
        if (rising != 0) rows &= ~rows_inside(block, square, from * from);
        const Seen seen = seen_from(block, light);
        const float upper = departure.light < 0 ? 0.0f : light->towards.w;
        const float4 lash = light->lash;
        const int lower_table = as_int(light->along_u.w);
        const int upper_table = as_int(light->along_v.w);
        __global const half* lower_layer = departures + (size_t)lower_table * layer_halves;
        __global const half* upper_layer = departures + (size_t)upper_table * layer_halves;
        for (int step = 0; step < STEPS; ++step) {
            if (OF_STEP(rows, step) == 0) continue;
            Lanes u = (seen.u + seen.u_step * step) * per_length[step];
            Lanes v = (seen.v + seen.v_step * step) * per_length[step];
            Lanes weight = (Lanes)(1.0f);
            if (OF_STEP(rising, step) != 0)
                weight = rising_from(sqrt(fma(u, u, v * v)), from, FADE_RATIO * from);
            if (seen.least_cosine <= 0.0f)
                weight = select(weight, (Lanes)(0.0f), seen.cosine + seen.cosine_step * step <= 0.0f);
            NodeSum* sum = sums + step * LANES;
            if (lash.y != 0.0f || lash.z != 0.0f) {
                const Lanes q = fma(u, u, v * v);
                lash_warp(lash, u, v, &u, &v);
                if (lash.z != 0.0f) {
                    // A bent pattern departs from the mean around the place that it was bent from.
                    const Lanes bent = fma(u, u, v * v);
                    const Lanes within = select(weight, (Lanes)(0.0f), bent > (float)(radius * radius));
                    for (int layer = 0; layer < (upper > 0.0f ? 2 : 1); ++layer) {
                        __global const float4* table = tables + (layer == 0 ? lower_table : upper_table) * table_entries;
                        const Lanes share = within * (layer == 0 ? 1.0f - upper : upper);
                        add_mean(table, bent, share, light->illuminance, (MeanSum*)sum, stride);
                        add_mean(table, q, -share, light->illuminance, (MeanSum*)sum, stride);
                    }
                }
            }
            add_nodes(departed, lower_layer, upper_layer, upper, u, v, weight, light->illuminance, sum);
        }
    }
    for (int r = 0; r < ROWS && y + r < height; ++r) {
        float4 sum[STRIP];
        for (int k = 0; k < STRIP; ++k)
            sum[k] = (float4)(0.0f);
        if (above_width > 0) upsample(above, above_width, x, y + r, 0, sum);
        for (int k = 0; k < STRIP && x + k < width; ++k)
            store_node(out + (size_t)(y - first_row + r) * width + x + k, sum[k] + folded_nodes(sums[r * STRIP + k]));
    }
}
