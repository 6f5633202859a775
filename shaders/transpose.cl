// What kernels for wide vectors share.

// Sixteen floats at the address of any float, read or written at once. Of vload16 PoCL 3.1 makes eight reads of two floats
// wherever the value is then only added or subtracted.
typedef float16 __attribute__((aligned(4))) loose16;
#define FLOATS16(at) (*(__global const loose16*)(at))

// Sixteen vectors of sixteen, rows for columns: for kernels of which an item works on blocks of sixteen by sixteen.
#define SWAP_HALVES(a, b)                           \
    {                                               \
        const float16 t = (float16)(a.lo, b.lo);    \
        b = (float16)(a.hi, b.hi);                  \
        a = t;                                      \
    }
#define SWAP_QUARTERS(a, b)                                                    \
    {                                                                          \
        const float16 t = (float16)(a.s0123, b.s0123, a.s89ab, b.s89ab);       \
        b = (float16)(a.s4567, b.s4567, a.scdef, b.scdef);                     \
        a = t;                                                                 \
    }
#define SWAP_PAIRS(a, b)                                                                                 \
    {                                                                                                    \
        const float16 t = (float16)(a.s01, b.s01, a.s45, b.s45, a.s89, b.s89, a.scd, b.scd);             \
        b = (float16)(a.s23, b.s23, a.s67, b.s67, a.sab, b.sab, a.sef, b.sef);                           \
        a = t;                                                                                           \
    }
#define SWAP_ONES(a, b)                                                                                  \
    {                                                                                                    \
        const float16 t = (float16)(a.s0, b.s0, a.s2, b.s2, a.s4, b.s4, a.s6, b.s6, a.s8, b.s8, a.sa,    \
                                    b.sa, a.sc, b.sc, a.se, b.se);                                       \
        b = (float16)(a.s1, b.s1, a.s3, b.s3, a.s5, b.s5, a.s7, b.s7, a.s9, b.s9, a.sb, b.sb, a.sd,      \
                      b.sd, a.sf, b.sf);                                                                 \
        a = t;                                                                                           \
    }
// m[row] holds columns; afterwards m[column] holds rows.
void transpose(float16* m) {
    for (int k = 0; k < 8; ++k) SWAP_HALVES(m[k], m[k + 8])
    for (int k = 0; k < 16; k += 8)
        for (int l = k; l < k + 4; ++l) SWAP_QUARTERS(m[l], m[l + 4])
    for (int k = 0; k < 16; k += 4)
        for (int l = k; l < k + 2; ++l) SWAP_PAIRS(m[l], m[l + 2])
    for (int k = 0; k < 16; k += 2) SWAP_ONES(m[k], m[k + 1])
}
