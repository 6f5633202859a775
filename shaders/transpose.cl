// What kernels for wide vectors share.

// Sixteen floats at the address of any float, read or written at once. Of vload16 PoCL 3.1 makes eight reads of two floats
// wherever the value is then only added or subtracted.
typedef float16 __attribute__((aligned(4))) loose16;
#define FLOATS16(at) (*(__global const loose16*)(at))

// Rows for columns, sixteen by sixteen. Each step is one instruction of processors with vectors of sixteen floats: ones of
// two vectors in turn, pairs in turn, and every other quarter.
#define LOW_ONES(a, b)                                                                                        \
    (float16)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5, a.s8, b.s8, a.s9, b.s9, a.sc, b.sc, a.sd, b.sd)
#define HIGH_ONES(a, b)                                                                                       \
    (float16)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7, a.sa, b.sa, a.sb, b.sb, a.se, b.se, a.sf, b.sf)
#define LOW_PAIRS(a, b) (float16)(a.s01, b.s01, a.s45, b.s45, a.s89, b.s89, a.scd, b.scd)
#define HIGH_PAIRS(a, b) (float16)(a.s23, b.s23, a.s67, b.s67, a.sab, b.sab, a.sef, b.sef)
#define EVEN_QUARTERS(a, b) (float16)(a.s0123, a.s89ab, b.s0123, b.s89ab)
#define ODD_QUARTERS(a, b) (float16)(a.s4567, a.scdef, b.s4567, b.scdef)
// Of rows r ... r + 3: column q of each in a quarter, columns q + 4, q + 8, q + 12 in the next ones.
#define FOUR_ROWS(r)                                                \
    {                                                               \
        const float16 a = LOW_ONES(m[r], m[r + 1]);                 \
        const float16 b = HIGH_ONES(m[r], m[r + 1]);                \
        const float16 c = LOW_ONES(m[r + 2], m[r + 3]);             \
        const float16 d = HIGH_ONES(m[r + 2], m[r + 3]);            \
        u[r] = LOW_PAIRS(a, c);                                     \
        u[r + 1] = HIGH_PAIRS(a, c);                                \
        u[r + 2] = LOW_PAIRS(b, d);                                 \
        u[r + 3] = HIGH_PAIRS(b, d);                                \
    }
#define FOUR_COLUMNS(q)                                             \
    {                                                               \
        const float16 a = EVEN_QUARTERS(u[q], u[q + 4]);            \
        const float16 b = ODD_QUARTERS(u[q], u[q + 4]);             \
        const float16 c = EVEN_QUARTERS(u[q + 8], u[q + 12]);       \
        const float16 d = ODD_QUARTERS(u[q + 8], u[q + 12]);        \
        m[q] = EVEN_QUARTERS(a, c);                                 \
        m[q + 4] = EVEN_QUARTERS(b, d);                             \
        m[q + 8] = ODD_QUARTERS(a, c);                              \
        m[q + 12] = ODD_QUARTERS(b, d);                             \
    }
// m[row] holds columns; afterwards m[column] holds rows.
void transpose(float16* m) {
    float16 u[16];
    FOUR_ROWS(0)
    FOUR_ROWS(4)
    FOUR_ROWS(8)
    FOUR_ROWS(12)
    FOUR_COLUMNS(0)
    FOUR_COLUMNS(1)
    FOUR_COLUMNS(2)
    FOUR_COLUMNS(3)
}
