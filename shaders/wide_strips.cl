// The columns of the wide field for processors with wide vectors, sixteen side by side as in fft_strips.cl: what
// gather_columns, a transform and sum_along_columns of two_scale.cl do, without leaving an item's own memory in between.
#define MOST 4096

// One item per sixteen columns from `first_column` on. `kept` holds the rows first_row ... last_row - 1 of the transformed
// plane, `floats` halves each from column `first_kept` on; the other rows are zero. sums[(quadrant * edges + edge) * count + column].
__kernel void sum_wide_columns(__global const half* kept, int floats, int first_kept, int first_row, int last_row,
                               int n, int first_column, int count, __global const float2* roots, __global const int* places,
                               int step, int edges, __global const float* unbox, float scale, float join_inner,
                               float join_outer, __global float* sums) {
    const int item = get_global_id(0);
    if (item * 16 >= count) return;
    const int half_n = n / 2;
    const int begin = first_column + item * 16;
    float16 re[MOST];
    float16 im[MOST];
    for (int y = 0; y < n; ++y) {
        re[y] = (float16)(0.0f);
        im[y] = (float16)(0.0f);
        if (y < first_row || y >= last_row) continue;
        __global const half* at = kept + (size_t)(y - first_row) * floats + 2 * (begin - first_kept);
        const float16 low = vload_half16(0, at);
        const float16 high = vload_half16(1, at);
        re[y] = (float16)(low.even, high.even);
        im[y] = (float16)(low.odd, high.odd);
    }
    transform(re, im, n, roots);

    float shares[16];
    for (int c = 0; c < 16; ++c) {
        const int i = begin + c;
        shares[c] = i > half_n ? 0.0f : scale * unbox[i] * (i == 0 || i == half_n ? 0.5f : 1.0f);
    }
    const float16 column_scale = vload16(0, shares);
    for (int quadrant = 0; quadrant < 2; ++quadrant) {
        __global float* out = sums + (size_t)quadrant * edges * count + item * 16;
        vstore16((float16)(0.0f), 0, out + (size_t)(edges - 1) * count);
        float16 sum = (float16)(0.0f);
        int next = 1 + (half_n - 1) / step * step;  // the kept edges are cells 0 and 1 + m step
        for (int j = half_n; j >= 0; --j) {
            const int at = places[quadrant ? (n - j) & (n - 1) : j];
            const float share = j == 0 || j == half_n ? 0.5f : 1.0f;
            float16 energy = (re[at] * re[at] + im[at] * im[at]) * column_scale * (unbox[j] * share);
            if (begin < join_outer && j < join_outer) {
                for (int c = 0; c < 16; ++c)
                    shares[c] = wide_share(sqrt((float)((begin + c) * (begin + c) + j * j)), join_inner, join_outer);
                energy *= vload16(0, shares);
            }
            sum += energy;
            if (j == next || j == 0) {
                vstore16(sum, 0, out + (size_t)(j == 0 ? 0 : 1 + (j - 1) / step) * count);
                next -= step;
            }
        }
    }
}
