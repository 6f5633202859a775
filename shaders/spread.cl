// From cumulative energy to the energy in each box of the screen's grid, summed over wavelengths in colour.
//
// A cell is the part of a node's box in one quadrant: cell (i, j) reaches from i - 1/2 to i + 1/2 pitches across, cell 0 from
// the axis to 1/2, and likewise up. At a wavelength its energy is a difference of four entries of the table, looked up
// bilinearly. Rows are subtracted before anything is added up, so that the rounding of the bright core's energy, which every
// inner entry contains, stays out of the faint cells.
//
// Two kernels do the same: spread_cells with an item per cell, for devices with thousands of them, and spread_tiles with an
// item per tile of cells, for those with a few wide ones. Their arguments are the same:
//   spectrum[2 k]      weights of wavelength k in rgb + scotopic; spectrum[2 k + 1].x = samples of the transform per unit of
//                      direction cosine
//   radius             cells that begin farther from the middle, in nodes, are left zero
//   reach              where the table's energy ends, in samples
//   wide_a ... wide_d  cells of wide fields, spread before, `wide_count` of them, to be added with weights
//   out                2 quadrants of `cells` rows of `cell_stride` cells

// Where entries lie: cell k of the transform covers k - 1/2 ... k + 1/2; entry 0 is the axis, entry i > 0 is the edge at
// (i - 1) step + 1/2 samples.
float entry_at(float x, float per_step, float limit) {
    return min(x < 0.5f ? 2.0f * x : (x - 0.5f) * per_step + 1.0f, limit);
}

// Where cell i begins, in samples.
float begin_of(int i, float scale) {
    return i == 0 ? 0.0f : ((float)i - 0.5f) * scale;
}

float4 wide_cell(int wide_count, __global const float4* wide_a, __global const float4* wide_b,
                 __global const float4* wide_c, __global const float4* wide_d, float4 weights, size_t at) {
    float4 cell = (float4)(0.0f);
    if (wide_count > 0) cell += weights.x * wide_a[at];
    if (wide_count > 1) cell += weights.y * wide_b[at];
    if (wide_count > 2) cell += weights.z * wide_c[at];
    if (wide_count > 3) cell += weights.w * wide_d[at];
    return cell;
}

// What lies between two rows, at or beyond an entry across.
float between(__global const float* from, float from_part, __global const float* to, float to_part, int stride,
              float entry, int edges) {
    const int i = min((int)entry, edges - 2);
    const float2 a = vload2(0, from + i) + from_part * (vload2(0, from + stride + i) - vload2(0, from + i));
    const float2 b = vload2(0, to + i) + to_part * (vload2(0, to + stride + i) - vload2(0, to + i));
    const float2 apart = a - b;
    return apart.x + (entry - i) * (apart.y - apart.x);
}

__kernel void spread_cells(__global const float* table, int edges, int stride, float per_step,
                           __global const float4* spectrum, int wavelengths, float pitch, int cells, int cell_stride,
                           float radius, float reach, int wide_count, __global const float4* wide_a,
                           __global const float4* wide_b, __global const float4* wide_c,
                           __global const float4* wide_d, float4 wide_weights, __global float4* out) {
    const int i = get_global_id(0);
    const int j = get_global_id(1) % cells;
    const int quadrant = get_global_id(1) / cells;
    if (i >= cell_stride || quadrant > 1) return;
    const size_t at = ((size_t)quadrant * cells + j) * cell_stride + i;
    float4 sum = (float4)(0.0f);
    if ((float)i * i + (float)j * j <= radius * radius && i < cells) {
        __global const float* quarter = table + (size_t)quadrant * edges * stride;
        const float limit = (float)(edges - 1);
        for (int k = 0; k < wavelengths; ++k) {
            const float scale = pitch * spectrum[2 * k + 1].x;
            if (begin_of(i, scale) >= reach || begin_of(j, scale) >= reach) continue;
            const float from = entry_at(begin_of(j, scale), per_step, limit);
            const float to = entry_at(begin_of(j + 1, scale), per_step, limit);
            const int a = min((int)from, edges - 2);
            const int b = min((int)to, edges - 2);
            __global const float* from_row = quarter + (size_t)a * stride;
            __global const float* to_row = quarter + (size_t)b * stride;
            const float inner = between(from_row, from - a, to_row, to - b, stride,
                                        entry_at(begin_of(i, scale), per_step, limit), edges);
            const float outer = between(from_row, from - a, to_row, to - b, stride,
                                        entry_at(begin_of(i + 1, scale), per_step, limit), edges);
            sum += spectrum[2 * k] * (inner - outer);
        }
        sum += wide_cell(wide_count, wide_a, wide_b, wide_c, wide_d, wide_weights, at);
    }
    out[at] = sum;
}

// A tile is TILE_COLUMNS x 16 cells. Rows are interpolated with sixteen columns of the table side by side, columns with
// sixteen rows of the screen: every access is of whole vectors, none is gathered. In between, blocks are transposed.
#define TILE_COLUMNS 32
#define STRIP 128

// A tile at one wavelength: strip[s] = what lies between the rows of each of sixteen cells above one another, at or beyond
// entry s across, as far as the tile has columns; if the entries are many (`sparse`), only the two that each column needs.
typedef struct {
    float scale;  // samples per node
    float per_step;
    float limit;
    int edges;
    int stride;
    int first_column;
    int first_entry;
    int entries;
    int sparse;
    float4 weight;
} tile_look_up;

float16 entries_of(__global const float* row, const tile_look_up* t, int s) {
    if (!t->sparse) return vload16(0, row + t->first_entry + s);
    float pairs[16];
    for (int k = 0; k < 8; ++k) {
        const float entry = entry_at(begin_of(t->first_column + s / 2 + k, t->scale), t->per_step, t->limit);
        vstore2(vload2(0, row + min((int)entry, t->edges - 2)), k, pairs);
    }
    return vload16(0, pairs);
}

void fill_strip(__global const float* quarter, const tile_look_up* t, int first_row, float16* strip) {
    int rows[17];
    float parts[17];
    for (int l = 0; l <= 16; ++l) {
        const float entry = entry_at(begin_of(first_row + l, t->scale), t->per_step, t->limit);
        rows[l] = min((int)entry, t->edges - 2);
        parts[l] = entry - rows[l];
    }
    for (int s = 0; s < t->entries; s += 16) {
        float16 m[16];
        __global const float* row = quarter + (size_t)rows[0] * t->stride;
        float16 low = entries_of(row, t, s);
        float16 before = low + parts[0] * (entries_of(row + t->stride, t, s) - low);
        for (int l = 0; l < 16; ++l) {
            row = quarter + (size_t)rows[l + 1] * t->stride;
            low = entries_of(row, t, s);
            const float16 next = low + parts[l + 1] * (entries_of(row + t->stride, t, s) - low);
            m[l] = before - next;
            before = next;
        }
        transpose(m);
        for (int l = 0; l < 16; ++l)
            strip[s + l] = m[l];
    }
}

// At or beyond column c of the tile.
float16 beyond_column(const tile_look_up* t, const float16* strip, int c) {
    const float entry = entry_at(begin_of(t->first_column + c, t->scale), t->per_step, t->limit);
    const int column = min((int)entry, t->edges - 2);
    const int s = t->sparse ? 2 * c : column - t->first_entry;
    return strip[s] + (entry - column) * (strip[s + 1] - strip[s]);
}

// Two wavelengths at once: the sums are read and written half as often.
void add_strips(const tile_look_up* t, const float16* first, const float16* second, int used, float16* sum) {
    float16 inner_a = beyond_column(t, first, 0);
    float16 inner_b = beyond_column(t + 1, second, 0);
    for (int c = 0; c < used; ++c) {
        const float16 outer_a = beyond_column(t, first, c + 1);
        const float16 outer_b = beyond_column(t + 1, second, c + 1);
        const float16 a = inner_a - outer_a;
        const float16 b = inner_b - outer_b;
        sum[4 * c] += t[0].weight.x * a + t[1].weight.x * b;
        sum[4 * c + 1] += t[0].weight.y * a + t[1].weight.y * b;
        sum[4 * c + 2] += t[0].weight.z * a + t[1].weight.z * b;
        sum[4 * c + 3] += t[0].weight.w * a + t[1].weight.w * b;
        inner_a = outer_a;
        inner_b = outer_b;
    }
}

__kernel void spread_tiles(__global const float* table, int edges, int stride, float per_step,
                           __global const float4* spectrum, int wavelengths, float pitch, int cells, int cell_stride,
                           float radius, float reach, int wide_count, __global const float4* wide_a,
                           __global const float4* wide_b, __global const float4* wide_c,
                           __global const float4* wide_d, float4 wide_weights, __global float4* out) {
    const int tile_rows = (cells + 15) / 16;
    const int first_column = get_global_id(0) * TILE_COLUMNS;
    const int quadrant = get_global_id(1) / tile_rows;
    const int first_row = get_global_id(1) % tile_rows * 16;
    if (first_column >= cell_stride || quadrant > 1) return;
    __global const float* quarter = table + (size_t)quadrant * edges * stride;
    const int columns = min(TILE_COLUMNS, cell_stride - first_column);
    // How many of the columns any row of the tile has inside the radius.
    const float widest = radius * radius - (float)first_row * first_row;
    const int used = widest < 0.0f ? 0 : clamp((int)sqrt(widest) + 1 - first_column, 0, columns);

    float16 sum[4 * TILE_COLUMNS];
    for (int k = 0; k < 4 * TILE_COLUMNS; ++k)
        sum[k] = (float16)(0.0f);
    float16 strips[2 * STRIP];
    tile_look_up both[2];
    int ready = 0;
    for (int k = 0; k < wavelengths && used > 0; ++k) {
        tile_look_up t;
        t.weight = spectrum[2 * k];
        t.scale = pitch * spectrum[2 * k + 1].x;
        if (begin_of(first_column, t.scale) >= reach || begin_of(first_row, t.scale) >= reach) continue;
        t.per_step = per_step;
        t.limit = (float)(edges - 1);
        t.edges = edges;
        t.stride = stride;
        t.first_column = first_column;
        const float first = entry_at(begin_of(first_column, t.scale), per_step, t.limit);
        const float last = entry_at(begin_of(first_column + used, t.scale), per_step, t.limit);
        t.first_entry = min((int)first, edges - 2);
        t.entries = min((int)last, edges - 2) + 2 - t.first_entry;
        t.sparse = t.entries > 3 * used;
        if (t.sparse) t.entries = 2 * used + 2;
        fill_strip(quarter, &t, first_row, strips + ready * STRIP);
        both[ready++] = t;
        if (ready < 2) continue;
        add_strips(both, strips, strips + STRIP, used, sum);
        ready = 0;
    }
    if (ready == 1) {
        both[1] = both[0];
        both[1].weight = (float4)(0.0f);
        add_strips(both, strips, strips, used, sum);
    }
    const float* lanes = (const float*)sum;
    for (int l = 0; l < 16 && first_row + l < cells; ++l) {
        const int j = first_row + l;
        for (int c = 0; c < columns; ++c) {
            const int i = first_column + c;
            const size_t at = ((size_t)quadrant * cells + j) * cell_stride + i;
            const float4 cell = (float4)(lanes[64 * c + l], lanes[64 * c + 16 + l], lanes[64 * c + 32 + l],
                                         lanes[64 * c + 48 + l]);
            const bool inside = i < cells && (float)i * i + (float)j * j <= radius * radius;
            out[at] = inside ? cell + wide_cell(wide_count, wide_a, wide_b, wide_c, wide_d, wide_weights, at)
                             : (float4)(0.0f);
        }
    }
}
