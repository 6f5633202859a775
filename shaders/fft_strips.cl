// The two-dimensional transform of real data for processors with wide vectors: sixteen rows, or sixteen columns, side by side
// in the lanes of a vector, so that a butterfly is plain arithmetic on whole vectors. One item has a strip; its data stay in
// its own memory from the first butterfly to the last.
#define MOST 4096

// Butterflies, decimation in frequency: y_m = sum over p of x_p exp(-2 pi i p m / r).
void butterfly_2(float16* x, float16* y) {
    const float16 xr = x[0] - x[1];
    const float16 xi = y[0] - y[1];
    x[0] += x[1];
    y[0] += y[1];
    x[1] = xr;
    y[1] = xi;
}

void butterfly_4(float16* x, float16* y) {
    const float16 ar = x[0] + x[2], ai = y[0] + y[2];
    const float16 br = x[0] - x[2], bi = y[0] - y[2];
    const float16 cr = x[1] + x[3], ci = y[1] + y[3];
    const float16 dr = x[1] - x[3], di = y[1] - y[3];
    x[0] = ar + cr;
    y[0] = ai + ci;
    x[1] = br + di;
    y[1] = bi - dr;
    x[2] = ar - cr;
    y[2] = ai - ci;
    x[3] = br - di;
    y[3] = bi + dr;
}

void butterfly_8(float16* x, float16* y) {
    const float half_root = 0.70710678118654752f;
    float16 er[4], ei[4], or[4], oi[4];
    for (int k = 0; k < 4; ++k) {
        er[k] = x[k] + x[k + 4];
        ei[k] = y[k] + y[k + 4];
        or[k] = x[k] - x[k + 4];
        oi[k] = y[k] - y[k + 4];
    }
    butterfly_4(er, ei);
    // times exp(-2 pi i k / 8)
    const float16 r1 = half_root * (or[1] + oi[1]);
    const float16 i1 = half_root * (oi[1] - or[1]);
    const float16 r3 = half_root * (oi[3] - or[3]);
    const float16 i3 = -half_root * (or[3] + oi[3]);
    const float16 r2 = oi[2];
    const float16 i2 = -or[2];
    or[1] = r1;
    oi[1] = i1;
    or[2] = r2;
    oi[2] = i2;
    or[3] = r3;
    oi[3] = i3;
    butterfly_4(or, oi);
    for (int k = 0; k < 4; ++k) {
        x[2 * k] = er[k];
        y[2 * k] = ei[k];
        x[2 * k + 1] = or[k];
        y[2 * k + 1] = oi[k];
    }
}

// n complex numbers of sixteen transforms, in place; the result for frequency k is at `places[k]`. roots[k] =
// exp(-2 pi i k / n).
void transform(float16* re, float16* im, int n, __global const float2* roots) {
    int length = n;
    for (; length >= 8; length /= 8) {
        const int step = length / 8;
        const int turn = n / length;
        for (int j = 0; j < step; ++j) {
            float2 w[8];
            for (int m = 1; m < 8; ++m)
                w[m] = roots[j * m * turn];
            for (int begin = j; begin < n; begin += length) {
                float16 x[8], y[8];
                for (int p = 0; p < 8; ++p) {
                    x[p] = re[begin + p * step];
                    y[p] = im[begin + p * step];
                }
                butterfly_8(x, y);
                re[begin] = x[0];
                im[begin] = y[0];
                for (int m = 1; m < 8; ++m) {
                    re[begin + m * step] = x[m] * w[m].x - y[m] * w[m].y;
                    im[begin + m * step] = x[m] * w[m].y + y[m] * w[m].x;
                }
            }
        }
    }
    if (length == 4)
        for (int k = 0; k < n; k += 4)
            butterfly_4(re + k, im + k);
    if (length == 2)
        for (int k = 0; k < n; k += 2)
            butterfly_2(re + k, im + k);
}

// One item per 32 rows of n + 2 reals: replaced by n/2 + 1 complex numbers. Sixteen rows are the real parts of what is
// transformed and sixteen the imaginary ones. Rows that are zero need not be among them.
__kernel void transform_rows(__global float* plane, int n, int first_row, int row_count,
                             __global const float2* roots, __global const int* places) {
    const int strip = get_global_id(0);
    if (strip * 32 >= row_count) return;
    const int stride = n + 2;
    __global float* first = plane + (size_t)(first_row + strip * 32) * stride;
    __global float* second = first + (size_t)16 * stride;
    float16 re[MOST];
    float16 im[MOST];
    for (int x = 0; x < n; x += 16) {
        for (int l = 0; l < 16; ++l) {
            re[x + l] = vload16(0, first + (size_t)l * stride + x);
            im[x + l] = vload16(0, second + (size_t)l * stride + x);
        }
        transpose(re + x);
        transpose(im + x);
    }
    transform(re, im, n, roots);
    for (int k = 0; k < n / 2; k += 8) {
        // Eight frequencies, real and imaginary parts in turn: sixteen columns.
        float16 a[16], b[16];
        for (int l = 0; l < 8; ++l) {
            const int at = places[k + l];
            const int mirror = places[(n - k - l) & (n - 1)];
            a[2 * l] = 0.5f * (re[at] + re[mirror]);
            a[2 * l + 1] = 0.5f * (im[at] - im[mirror]);
            b[2 * l] = 0.5f * (im[at] + im[mirror]);
            b[2 * l + 1] = 0.5f * (re[mirror] - re[at]);
        }
        transpose(a);
        transpose(b);
        for (int l = 0; l < 16; ++l) {
            vstore16(a[l], 0, first + (size_t)l * stride + 2 * k);
            vstore16(b[l], 0, second + (size_t)l * stride + 2 * k);
        }
    }
    float highest[32];
    vstore16(re[places[n / 2]], 0, highest);
    vstore16(im[places[n / 2]], 1, highest);
    for (int l = 0; l < 16; ++l) {
        vstore2((float2)(highest[l], 0.0f), 0, first + (size_t)l * stride + n);
        vstore2((float2)(highest[16 + l], 0.0f), 0, second + (size_t)l * stride + n);
    }
}

// One item per sixteen of the columns 0 ... n/2 - 1. Columns 0 and n/2 are real, and go as the real and the imaginary part
// of one. Rows outside first_row ... first_row + row_count - 1 are taken as zero.
__kernel void transform_columns(__global float* plane, int n, int first_row, int row_count,
                                __global const float2* roots, __global const int* places) {
    const int strip = get_global_id(0);
    if (strip * 16 >= n / 2) return;
    const int stride = n + 2;
    __global float* column = plane + strip * 32;
    float16 re[MOST];
    float16 im[MOST];
    for (int y = 0; y < n; ++y) {
        re[y] = (float16)(0.0f);
        im[y] = (float16)(0.0f);
        if (y < first_row || y >= first_row + row_count) continue;
        __global const float* at = column + (size_t)y * stride;
        const float16 low = vload16(0, at);
        const float16 high = vload16(1, at);
        re[y] = (float16)(low.even, high.even);
        im[y] = (float16)(low.odd, high.odd);
        if (strip == 0) im[y].s0 = at[n];
    }
    transform(re, im, n, roots);
    for (int k = 0; k < n; ++k) {
        float16 x = re[places[k]];
        float16 y = im[places[k]];
        __global float* at = column + (size_t)k * stride;
        if (strip == 0) {
            const float mirror_x = re[places[(n - k) & (n - 1)]].s0;
            const float mirror_y = im[places[(n - k) & (n - 1)]].s0;
            vstore2(0.5f * (float2)(y.s0 + mirror_y, mirror_x - x.s0), 0, at + n);
            x.s0 = 0.5f * (x.s0 + mirror_x);
            y.s0 = 0.5f * (y.s0 - mirror_y);
        }
        float16 low, high;
        low.even = x.lo;
        low.odd = y.lo;
        high.even = x.hi;
        high.odd = y.hi;
        vstore16(low, 0, at);
        vstore16(high, 1, at);
    }
}
