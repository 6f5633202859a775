// From the transform to cumulative energy. Two quadrants of the half plane kx >= 0: quadrant 0 has ky >= 0, quadrant 1
// ky <= 0 with |ky| counted outwards. Each is summed from its outer corner inwards: entry (i, j) is the energy of all
// cells at or beyond (i, j). The faint wings are sums of faint things and never a difference against the core, which is
// why single precision is enough.
//
// Cell 0 lies on an axis and is shared with the mirrored half: it counts half, as does the cell of the highest
// frequency. A table has half + 2 rows of `stride` entries; what lies beyond stays zero.

// An aperture out of focus is complex, A + i B with A and B real. The mean of its energy at k and at -k is |FA|^2 + |FB|^2:
// B's transform is added (`add`) to what A's has left. The pattern stays point-symmetric, which is what the table holds.
//
// e = |F|^2 * scale, taken back from the box that each sample of the aperture averages over: / sinc^2 sinc^2.
// Where a wide field takes over (`join_outer` > 0), energy fades out over a band of frequencies.
__kernel void sum_rows(__global const float2* spectrum, __global float* table, __global const float* unbox,
                       int n, int stride, float scale, int add, float join_inner, float join_outer) {
    const int half_n = n / 2;
    const int rows = half_n + 1;
    const int id = get_global_id(0);
    if (id >= 2 * rows) return;
    const int quadrant = id >= rows;
    const int j = id - quadrant * rows;
    const int source_row = quadrant ? (n - j) & (n - 1) : j;
    __global const float2* f = spectrum + (size_t)source_row * rows;
    __global float* out = table + ((size_t)quadrant * (half_n + 2) + j) * stride;
    const float row_scale = scale * unbox[j] * (j == 0 || j == half_n ? 0.5f : 1.0f);
    float sum = 0.0f;
    for (int i = half_n; i >= 0; --i) {
        const float2 value = f[i];
        const float share = i == 0 || i == half_n ? 0.5f : 1.0f;
        float energy = (value.x * value.x + value.y * value.y) * row_scale * unbox[i] * share;
        if (join_outer > 0.0f) {
            const float k = sqrt((float)(i * i + j * j));
            if (k >= join_outer)
                energy = 0.0f;
            else if (k > join_inner)
                energy *= 0.5f + 0.5f * cospi((k - join_inner) / (join_outer - join_inner));
        }
        sum += energy;
        out[i] = add ? out[i] + sum : sum;
    }
}

// Sixteen columns an item, a whole cache line.
__kernel void sum_columns(__global float* table, int n, int stride) {
    const int half_n = n / 2;
    const int strips = stride / 16;
    const int id = get_global_id(0);
    if (id >= 2 * strips) return;
    const int quadrant = id / strips;
    __global float* column = table + (size_t)quadrant * (half_n + 2) * stride + (size_t)(id % strips) * 16;
    float16 sum = (float16)(0.0f);
    for (int j = half_n; j >= 0; --j) {
        __global float* at = column + (size_t)j * stride;
        sum += vload16(0, at);
        vstore16(sum, 0, at);
    }
}
