// The wide field of the pattern, a few rows or columns at a time: so that no launch is long and the whole plane never
// exists in single precision. Rows of the pupil plane are transformed and kept in half precision; columns are then
// transformed from the outermost frequency inwards, and each leaves what it adds to the cumulative energy
// (energy_table.cl), of which only every `step`-th edge is kept: 0, 1/2, step + 1/2, 2 step + 1/2, ...

// Amplitudes are at most n, far inside what half precision holds; what rounding adds is spread over the whole column and
// lies five orders of magnitude below the faintest of it.
//
// Of every row the columns of one pass are kept: `kept_floats`, a multiple of 8, from `first_float` on; beyond the row's end
// zeros.
__kernel void keep_rows(__global const float* rows, int floats, int first_float, __global half* kept, int kept_floats,
                        int first_row, int row_count) {
    const int i = 8 * get_global_id(0);
    const int row = get_global_id(1);
    if (row >= row_count || i >= kept_floats) return;
    __global const float* from = rows + (size_t)row * floats + first_float;
    __global half* to = kept + (size_t)(first_row + row) * kept_floats;
    const int there = floats - first_float;
    if (i + 8 <= there)
        vstore_half8_rte(vload8(0, from + i), 0, to + i);
    else
        for (int k = i; k < i + 8; ++k)
            vstore_half_rte(k < there ? from[k] : 0.0f, k, to);
}

// `count` columns from `first_column` on, each as n complex numbers in a row of `columns`; the first column kept is
// `first_kept`. Rows outside the pupil are zero and were not kept. An item has 8 rows of the plane.
__kernel void gather_columns(__global const half* kept, int floats, int first_kept, int first_row, int last_row, int n,
                             int first_column, int count, __global float2* columns) {
    const int begin = 8 * get_global_id(0);
    if (begin >= n) return;
    float2 block[8];
    for (int c = 0; c < count; ++c) {
        for (int r = 0; r < 8; ++r) {
            const int row = begin + r;
            const int x = first_column - first_kept + c;
            const bool inside = row >= first_row && row < last_row && 2 * x + 1 < floats;
            block[r] = inside ? vload_half2((size_t)(row - first_row) * (floats / 2) + x, kept) : (float2)(0.0f);
        }
        for (int r = 0; r < 8; ++r)
            columns[(size_t)c * n + begin + r] = block[r];
    }
}

// The share of a frequency that the wide field has: nothing inside the core's, half a cosine over the join.
float wide_share(float k, float join_inner, float join_outer) {
    if (k <= join_inner) return 0.0f;
    if (k >= join_outer) return 1.0f;
    return 0.5f - 0.5f * cospi((k - join_inner) / (join_outer - join_inner));
}

// One item per column and quadrant: the energy at or beyond every kept edge along the column.
// sums[(quadrant * edges + edge) * count + column].
__kernel void sum_along_columns(__global const float2* columns, int n, int first_column, int count, int step, int edges,
                                __global const float* unbox, float scale, float join_inner, float join_outer,
                                __global float* sums) {
    const int id = get_global_id(0);
    if (id >= 2 * count) return;
    const int quadrant = id / count;
    const int c = id % count;
    const int half_n = n / 2;
    const int i = first_column + c;
    __global float* out = sums + (size_t)quadrant * edges * count + c;
    out[(size_t)(edges - 1) * count] = 0.0f;
    if (i > half_n) {
        for (int edge = 0; edge < edges; ++edge)
            out[(size_t)edge * count] = 0.0f;
        return;
    }
    __global const float2* f = columns + (size_t)c * n;
    const float column_scale = scale * unbox[i] * (i == 0 || i == half_n ? 0.5f : 1.0f);
    float sum = 0.0f;
    int next = 1 + (half_n - 1) / step * step;  // the kept edges are cells 0 and 1 + m step
    for (int j = half_n; j >= 0; --j) {
        const float2 value = f[quadrant ? (n - j) & (n - 1) : j];
        const float share = j == 0 || j == half_n ? 0.5f : 1.0f;
        float energy = (value.x * value.x + value.y * value.y) * column_scale * unbox[j] * share;
        if (i < join_outer && j < join_outer)
            energy *= wide_share(sqrt((float)(i * i + j * j)), join_inner, join_outer);
        sum += energy;
        if (j == next || j == 0) {
            out[(size_t)(j == 0 ? 0 : 1 + (j - 1) / step) * count] = sum;
            next -= step;
        }
    }
}

// One item per quadrant and kept edge along the columns: adds this block's columns, the outermost first, to what the
// blocks before it have left.
__kernel void sum_across_columns(__global const float* sums, int n, int first_column, int count, int step, int edges,
                                 __global float* carry, __global float* table, int stride) {
    const int id = get_global_id(0);
    if (id >= 2 * edges) return;
    const int half_n = n / 2;
    __global const float* in = sums + (size_t)id * count;
    __global float* out = table + (size_t)id * stride;
    float sum = first_column + count > half_n ? 0.0f : carry[id];
    if (first_column + count > half_n) out[edges - 1] = 0.0f;
    for (int c = count - 1; c >= 0; --c) {
        const int i = first_column + c;
        if (i > half_n) continue;
        sum += in[c];
        if (i == 0)
            out[0] = sum;
        else if ((i - 1) % step == 0)
            out[1 + (i - 1) / step] = sum;
    }
    carry[id] = sum;
}
