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
#define TILE_COLUMNS 64
#define EDGES (TILE_COLUMNS + 16)
#define STRIP (3 * TILE_COLUMNS + 32)

// A tile at one wavelength. Column edge c lies `part` of the way from entry `column` to the next; strip[s] is what lies
// between the rows of each of sixteen cells above one another, at or beyond entry first_entry + s, or, if the entries are many
// (`sparse`), at or beyond the two of edge s / 2.
typedef struct {
    float scale;  // samples per node
    float per_step;
    int edges;
    int stride;
    int first_entry;
    int entries;
    int sparse;
    int column[EDGES];
    float part[EDGES];
} tile_look_up;

float16 entries_at(int first, float scale, float per_step, float limit) {
    const float16 steps = (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const float16 x = max(steps + ((float)first - 0.5f), 0.0f) * scale;
    return min(select((x - 0.5f) * per_step + 1.0f, 2.0f * x, x < 0.5f), (float16)(limit));
}

// Edges 0 ... columns of the tile, and what lies between the last of them and a multiple of sixteen.
void look_up_columns(tile_look_up* t, int first_column, int columns) {
    for (int c = 0; c <= columns; c += 16) {
        const float16 entry = entries_at(first_column + c, t->scale, t->per_step, (float)(t->edges - 1));
        const int16 column = min(convert_int16(entry), (int16)(t->edges - 2));
        vstore16(column, 0, t->column + c);
        vstore16(entry - convert_float16(column), 0, t->part + c);
    }
    t->first_entry = t->column[0];
    t->entries = t->column[columns] + 2 - t->first_entry;
    t->sparse = t->entries > 3 * columns;
    if (t->sparse) t->entries = 2 * columns + 2;
}

float16 entries_of(__global const float* row, const tile_look_up* t, int s) {
    if (!t->sparse) return FLOATS16(row + t->first_entry + s);
    float pairs[16];
    for (int k = 0; k < 8; ++k)
        vstore2(vload2(0, row + t->column[s / 2 + k]), k, pairs);
    return vload16(0, pairs);
}

void fill_strip(__global const float* quarter, const tile_look_up* t, int first_row, float16* strip) {
    int rows[32];
    float parts[32];
    for (int l = 0; l <= 16; l += 16) {
        const float16 entry = entries_at(first_row + l, t->scale, t->per_step, (float)(t->edges - 1));
        const int16 row = min(convert_int16(entry), (int16)(t->edges - 2));
        vstore16(row * t->stride, 0, rows + l);
        vstore16(entry - convert_float16(row), 0, parts + l);
    }
    for (int s = 0; s < t->entries; s += 16) {
        float16 m[16];
        __global const float* row = quarter + rows[0];
        float16 low = entries_of(row, t, s);
        float16 before = low + parts[0] * (entries_of(row + t->stride, t, s) - low);
        for (int l = 0; l < 16; ++l) {
            row = quarter + rows[l + 1];
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

// Adds, or writes for the first of several wavelengths, what is at or beyond each of the column edges.
void add_edges(const tile_look_up* t, const float16* strip, int columns, int first, float16* beyond) {
    for (int c = 0; c <= columns; ++c) {
        const float16* at = strip + (t->sparse ? 2 * c : t->column[c] - t->first_entry);
        const float16 here = at[0] + t->part[c] * (at[1] - at[0]);
        beyond[c] = first ? here : beyond[c] + here;
    }
}

// Two colours at once: the sums are read and written half as often.
void add_colours(float4 one, const float16* first, float4 other, const float16* second, int columns,
                 float16* sum) {
    for (int c = 0; c < columns; ++c) {
        const float16 a = first[c] - first[c + 1];
        const float16 b = second[c] - second[c + 1];
        sum[4 * c] += one.x * a + other.x * b;
        sum[4 * c + 1] += one.y * a + other.y * b;
        sum[4 * c + 2] += one.z * a + other.z * b;
        sum[4 * c + 3] += one.w * a + other.w * b;
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
    for (int k = 0; k < 4 * columns; ++k)
        sum[k] = (float16)(0.0f);
    float16 strip[STRIP];
    float16 beyond[2 * (TILE_COLUMNS + 1)];
    float4 colours[2];
    int ready = 0;     // colours whose sums are complete
    int under_way = 0;  // wavelengths of the next one
    tile_look_up t;
    t.per_step = per_step;
    t.edges = edges;
    t.stride = stride;
    for (int k = 0; k < wavelengths && used > 0; ++k) {
        t.scale = pitch * spectrum[2 * k + 1].x;
        const bool lit = begin_of(first_column, t.scale) < reach && begin_of(first_row, t.scale) < reach;
        const float4 colour = spectrum[2 * k];
        if (lit) {
            look_up_columns(&t, first_column, used);
            fill_strip(quarter, &t, first_row, strip);
            add_edges(&t, strip, used, under_way == 0, beyond + ready * (TILE_COLUMNS + 1));
            ++under_way;
        }
        // Neighbours of the same colour are added up before they are coloured.
        const bool last = k + 1 == wavelengths || any(spectrum[2 * k + 2] != colour);
        if (!last || under_way == 0) continue;
        under_way = 0;
        colours[ready++] = colour;
        if (ready < 2) continue;
        add_colours(colours[0], beyond, colours[1], beyond + TILE_COLUMNS + 1, used, sum);
        ready = 0;
    }
    if (ready == 1) add_colours(colours[0], beyond, (float4)(0.0f), beyond, used, sum);

    const float4 steps = (float4)(0.0f, 1.0f, 2.0f, 3.0f);
    for (int c = 0; c < columns; c += 4) {
        transpose(sum + 4 * c);
        const float4 across = steps + (float)(first_column + c);
        for (int l = 0; l < 16 && first_row + l < cells; ++l) {
            const int j = first_row + l;
            const size_t at = ((size_t)quadrant * cells + j) * cell_stride + first_column + c;
            float16 nodes = sum[4 * c + l];
            if (wide_count > 0) nodes += wide_weights.x * FLOATS16((__global const float*)(wide_a + at));
            if (wide_count > 1) nodes += wide_weights.y * FLOATS16((__global const float*)(wide_b + at));
            if (wide_count > 2) nodes += wide_weights.z * FLOATS16((__global const float*)(wide_c + at));
            if (wide_count > 3) nodes += wide_weights.w * FLOATS16((__global const float*)(wide_d + at));
            const int4 inside = across < (float)cells && across * across + (float)j * j <= radius * radius;
            *(__global loose16*)(out + at) = select((float16)(0.0f), nodes,
                                            (int16)(inside.xxxx, inside.yyyy, inside.zzzz, inside.wwww));
        }
    }
}
