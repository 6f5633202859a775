// From the energy in each cell of the screen's grid (spread.cl) to the pattern: core apart from skirt, the skirt averaged over
// discs. The pattern is point-symmetric, so only rows 0, 1, ... are made.

// The energy in the box of node (a, b). The quarter a < 0, b > 0 is the mirror of quadrant 1, and a node on an axis has a
// half in each.
float4 node_energy(__global const float4* cell, int cells, int cell_stride, int a, int b) {
    __global const float4* first = cell + (size_t)abs(b) * cell_stride + abs(a);
    __global const float4* second = first + (size_t)cells * cell_stride;
    if (a == 0 && b == 0) return 2.0f * (first[0] + second[0]);
    if (a == 0 || b == 0) return first[0] + second[0];
    return (a > 0) == (b > 0) ? first[0] : second[0];
}

// One item per ring of nodes: the factor that gives the ring's mean luminance `scale` times its target. Half the nodes: the
// other half mirrors them.
__kernel void calibrate_rings(__global const float4* cell, int cells, int cell_stride, int structure_radius,
                              int rings, __global const float* targets, float scale, __global float* gains) {
    const int ring = get_global_id(0);
    if (ring >= rings) return;
    float sum = 0.0f;
    float count = 0.0f;
    const float outer = ring + 0.5f;
    const float inner = max(ring - 0.5f, 0.0f);
    for (int b = 0; b <= min(ring, structure_radius); ++b) {
        const int last = min((int)sqrt(max(outer * outer - b * b, 0.0f)), structure_radius);
        for (int a = max((int)sqrt(max(inner * inner - b * b, 0.0f)) - 1, 0); a <= last; ++a) {
            if ((int)(sqrt((float)(a * a + b * b)) + 0.5f) != ring) continue;
            const float4 right = node_energy(cell, cells, cell_stride, a, b);
            const float4 left = node_energy(cell, cells, cell_stride, -a, b);
            // A node on an axis is there once for each of its two halves.
            const float copies = (a > 0 ? 1.0f : 0.5f) * (b > 0 ? 1.0f : 0.5f);
            const float4 both = (right + left) * copies;
            sum += 0.2126f * both.x + 0.7152f * both.y + 0.0722f * both.z;
            count += 2.0f * copies;
        }
    }
    const float gain = sum > 0.0f ? scale * targets[ring] * count / sum : 1.0f;
    if (ring > 0) gains[ring] = gain;
    if (ring == 1) gains[0] = gain;
}

// 1 up to `inner`, half a cosine down to 0 at `outer`: its sine's series is right to 6e-8.
float4 fading(float4 sine, float inner, float outer) {
    const float4 z = 0.5f - clamp((sine - inner) / (outer - inner), 0.0f, 1.0f);
    const float4 x = 3.14159265f * z;
    const float4 s = x * x;
    const float4 sine_of_x =
        x * (1.0f + s * (-1.0f / 6 + s * (1.0f / 120 + s * (-1.0f / 5040 + s * (1.0f / 362880 - s * (1.0f / 39916800))))));
    return select(0.5f + 0.5f * sine_of_x, (float4)(0.0f), sine >= outer);
}

float16 each_of(float4 v) {
    return (float16)(v.xxxx, v.yyyy, v.zzzz, v.wwww);
}
float16 reversed(float16 nodes) {
    return nodes.scdef89ab45670123;
}

// A row of the skirt's buffer has the columns -border ... border, eight or more before and sixteen or more after them, so
// that several nodes at once may reach beyond; node 0 and every fourth from it begin where a vector may. Its rows are
// -margin ... border.
int skirt_lead(int border) {
    return (border + 11) / 4 * 4;
}
int skirt_width(int border) {
    return (skirt_lead(border) + border + 20) / 4 * 4;
}
__global float* skirt_row(__global float* skirt, int border, int margin, int y) {
    return skirt + ((size_t)(y + margin) * skirt_width(border) + skirt_lead(border)) * 4;
}

// One item per row b >= 0 and SPLIT_NODES nodes a = i, i + 1, ... and their mirror images -a: splits core from skirt, fades
// the skirt out (calibrated, where there are rings, with their gains), writes it with a border of zeros to rows b and, where discs need it, -b. Adds up the energies of both.
#define SPLIT_NODES 32
__kernel void split_core(__global const float* cell, int cells, int cell_stride, int border, int margin,
                         float pitch, float window_inner, float window_outer, float core_radius,
                         int rings, __global const float* gains, __global float* skirt,
                         __global float4* energies) {
    const int blocks = border / SPLIT_NODES + 1;
    const int id = get_global_id(0);
    if (id >= blocks * (border + 1)) return;
    const int b = id / blocks;
    const int begin = id % blocks * SPLIT_NODES;
    const int end = min(begin + SPLIT_NODES, border + 1);
    __global const float* first = cell + (size_t)b * cell_stride * 4;
    __global const float* second = first + (size_t)cells * cell_stride * 4;
    __global float* row = skirt_row(skirt, border, margin, b);
    __global float* mirrored = skirt_row(skirt, border, margin, -b);
    const float per_sr = 1.0f / (pitch * pitch);
    float16 core_sum = (float16)(0.0f);
    float16 skirt_sum = (float16)(0.0f);
    for (int a = begin; a < end; a += 4) {
        const float4 across = (float4)(0.0f, 1.0f, 2.0f, 3.0f) + (float)a;
        const float4 distance = sqrt(across * across + (float)(b * b));
        float16 right = (float16)(0.0f);
        float16 left = (float16)(0.0f);
        if (b < cells && a < cells && distance.x * pitch < window_outer) {
            float4 weight = fading(distance * pitch, window_inner, window_outer);
            if (rings > 0) {
                const int4 ring = min(convert_int4(distance), rings - 2);
                const float4 inner = (float4)(gains[ring.x], gains[ring.y], gains[ring.z], gains[ring.w]);
                const float4 outer =
                    (float4)(gains[ring.x + 1], gains[ring.y + 1], gains[ring.z + 1], gains[ring.w + 1]);
                weight *= mix(inner, outer, distance - convert_float4(ring));
            }
            const float16 weights = each_of(weight);
            right = vload16(0, first + 4 * a) * weights;
            left = vload16(0, second + 4 * a) * weights;
            if (distance.x < core_radius) {
                const float4 c = cospi(0.5f * min(distance / core_radius, 1.0f));
                const float16 core = each_of(c * c);
                core_sum += (right + left) * core;
                right -= right * core;
                left -= left * core;
            }
            skirt_sum += right + left;
            // Nodes on an axis have a half in each quadrant.
            if (b == 0) right = left = right + left;
            if (a == 0) right.s0123 = left.s0123 = right.s0123 + left.s0123;
            right *= per_sr;
            left *= per_sr;
        }
        vstore16(right, 0, row + 4 * a);
        vstore16(reversed(left), 0, row - 4 * (a + 3));
        if (b == 0 || b > margin) continue;
        vstore16(left, 0, mirrored + 4 * a);
        vstore16(reversed(right), 0, mirrored - 4 * (a + 3));
    }
    // Every cell is there twice, once mirrored.
    energies[2 * id] = 2.0f * (core_sum.s0123 + core_sum.s4567 + core_sum.s89ab + core_sum.scdef);
    energies[2 * id + 1] = 2.0f * (skirt_sum.s0123 + skirt_sum.s4567 + skirt_sum.s89ab + skirt_sum.scdef);
}

// result[0] = the factor per channel that gives core + skirt the energy they should have, result[1] = core's energy after
// it, result[2] = energy of core + skirt before it. A skirt that is calibrated stays, and the core has what is left. One
// group of BALANCE_ITEMS.
#define BALANCE_ITEMS 16
__kernel void balance(__global const float4* energies, int count, float structure_energy, int calibrated,
                      __global float4* result) {
    __local float4 sums[2 * BALANCE_ITEMS];
    const int item = get_local_id(0);
    float4 core = (float4)(0.0f);
    float4 skirt = (float4)(0.0f);
    for (int k = item; k < count; k += BALANCE_ITEMS) {
        core += energies[2 * k];
        skirt += energies[2 * k + 1];
    }
    sums[2 * item] = core;
    sums[2 * item + 1] = skirt;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item != 0) return;
    for (int k = 1; k < BALANCE_ITEMS; ++k) {
        core += sums[2 * k];
        skirt += sums[2 * k + 1];
    }
    const float4 total = core + skirt;
    const float4 scale = select((float4)(0.0f), structure_energy / total, isgreater(total, (float4)(0.0f)));
    result[0] = scale;
    result[1] = core * scale;
    result[2] = total;
    if (calibrated) {
        result[0] = (float4)(1.0f);
        result[1] = max(structure_energy - skirt, (float4)(0.0f));
    }
}

// Four columns an item: the sum of the skirt over all rows at or beyond each, from the outermost inwards, so that sums over
// rows far from the middle are differences of faint things. One row more than the skirt, of zeros.
__kernel void sum_skirt(__global const float* skirt, int border, int margin, __global float* beyond) {
    const int strips = skirt_width(border) / 4;
    const int strip = get_global_id(0);
    if (strip >= strips) return;
    const size_t width = skirt_width(border) * 4;
    const size_t column = (size_t)strip * 16;
    float16 sum = (float16)(0.0f);
    vstore16(sum, 0, beyond + (border + 1 + margin) * width + column);
    for (int y = border; y >= -margin; --y) {
        const size_t at = (y + margin) * width + column;
        sum += vload16(0, skirt + at);
        vstore16(sum, 0, beyond + at);
    }
}

// Layers have the rows 0 ... radius alone: whoever reads them mirrors the others.
void write_nodes(float16 nodes, int x, int y, int radius, __global float4* layer) {
    __global float4* at = layer + (size_t)y * (2 * radius + 1) + radius + x;
    if (x >= -radius && x + 3 <= radius) {
        *(__global loose16*)at = nodes;
        return;
    }
    const float4 each[4] = {nodes.s0123, nodes.s4567, nodes.s89ab, nodes.scdef};
    for (int k = 0; k < 4; ++k)
        if (x + k >= -radius && x + k <= radius) at[k] = each[k];
}

// One layer in one of two ways: average_disc with sixteen nodes an item, for devices with thousands of them, whatever the
// radius; average_rows with a piece of a row an item, for those with a few wide ones, up to MOST_REACH nodes.

// A span is whole columns of the disc: (column, rows to
// either side); a tap is a cell that it covers in part: (column, row, share as a float's bits).
__kernel void average_disc(__global const float* skirt, __global const float* beyond, int border, int margin,
                           int radius, __global const int2* spans, int span_begin, int span_end,
                           float span_weight, __global const int4* taps, int tap_begin, int tap_end,
                           __global const float4* balance_result, __global float4* layer, int layer_at) {
    const int x = get_global_id(0) * 16 - radius;
    const int y = get_global_id(1);
    if (x > radius || y > radius) return;
    const int width = skirt_width(border) * 4;
    const int middle = (y + margin) * width + (x + skirt_lead(border)) * 4;
    float16 a = (float16)(0.0f);
    float16 b = a, c = a, d = a;
    for (int k = span_begin; k < span_end; ++k) {
        const int2 span = spans[k];
        __global const float* low = beyond + middle + 4 * span.x - span.y * width;
        __global const float* high = beyond + middle + 4 * span.x + (span.y + 1) * width;
        a += vload16(0, low) - vload16(0, high);
        b += vload16(1, low) - vload16(1, high);
        c += vload16(2, low) - vload16(2, high);
        d += vload16(3, low) - vload16(3, high);
    }
    a *= span_weight;
    b *= span_weight;
    c *= span_weight;
    d *= span_weight;
    for (int k = tap_begin; k < tap_end; ++k) {
        const int4 tap = taps[k];
        const float weight = as_float(tap.z);
        __global const float* at = skirt + middle + 4 * tap.x + tap.y * width;
        a += weight * vload16(0, at);
        b += weight * vload16(1, at);
        c += weight * vload16(2, at);
        d += weight * vload16(3, at);
    }
    const float4 scale = balance_result[0];
    const float16 scales = (float16)(scale, scale, scale, scale);
    write_nodes(a * scales, x, y, radius, layer + layer_at);
    if (x + 4 <= radius) write_nodes(b * scales, x + 4, y, radius, layer + layer_at);
    if (x + 8 <= radius) write_nodes(c * scales, x + 8, y, radius, layer + layer_at);
    if (x + 12 <= radius) write_nodes(d * scales, x + 12, y, radius, layer + layer_at);
}

// The columns of a disc are alike to the left and the right of its middle, and each column reaches as far up as down. So rows
// are added in pairs, columns are made of those pairs from the outermost inwards, each from the one outside it (it covers
// what that one covers and a little more: `steps`, (rows to either side, share more as a float's bits); those of column m
// are first_of[reach - m] ... first_of[reach - m + 1]), and a node is the sum of its columns. What it takes grows with the
// radius and not with its square, and nothing is ever subtracted.
#define MOST_REACH 16
#define PIECE 32  // vectors of four nodes
#define HALO 4    // vectors to either side: MOST_REACH nodes
#define ROOM (PIECE + 2 * HALO + 3)
// Four vectors at once. They may begin up to three before the end: the skirt's buffer has room for what they read.
void add_columns(__global const float* at, int width, int reach, __global const int* first_of,
                 __global const int2* steps, float16* columns) {
    float16 pairs[4 * (MOST_REACH + 1)];
    for (int v = 0; v < 4; ++v)
        pairs[v] = FLOATS16(at + 16 * v);
    for (int dy = 1; dy <= reach; ++dy) {
        __global const float* above = at - dy * width;
        __global const float* below = at + dy * width;
        pairs[4 * dy] = FLOATS16(above) + FLOATS16(below);
        pairs[4 * dy + 1] = FLOATS16(above + 16) + FLOATS16(below + 16);
        pairs[4 * dy + 2] = FLOATS16(above + 32) + FLOATS16(below + 32);
        pairs[4 * dy + 3] = FLOATS16(above + 48) + FLOATS16(below + 48);
    }
    float16 a = (float16)(0.0f);
    float16 b = a, c = a, d = a;
    float16* column = columns + reach * ROOM;
    int k = first_of[0];
    for (int m = 0; m <= reach; ++m, column -= ROOM) {
        for (const int last = first_of[m + 1]; k < last; ++k) {
            const int2 step = steps[k];
            const float16* pair = pairs + 4 * step.x;
            const float weight = as_float(step.y);
            a += weight * pair[0];
            b += weight * pair[1];
            c += weight * pair[2];
            d += weight * pair[3];
        }
        column[0] = a;
        column[1] = b;
        column[2] = c;
        column[3] = d;
    }
}

__kernel void average_rows(__global const float* skirt, int border, int margin, int radius, float lit_radius,
                           int reach, __global const int* first_of, __global const int2* steps,
                           __global const float4* balance_result, __global float4* layer, int layer_at) {
    const int y = get_global_id(1);
    const int x = get_global_id(0) * 4 * PIECE - (radius + 3) / 4 * 4;
    if (x > radius || y > radius) return;
    const float4 scale = balance_result[0];
    const float16 scales = (float16)(scale, scale, scale, scale);
    const int width = skirt_width(border) * 4;
    __global const float* row = skirt + (y + margin) * width + (x + skirt_lead(border)) * 4;
    // Beyond the disc's reach from the structure there is nothing.
    const float square = lit_radius * lit_radius - (float)y * y;
    const int lit = square < 0.0f ? -1 : (int)sqrt(square) + 1;
    const int end = min(PIECE, (radius - x) / 4 + 1);
    const int first_lit = clamp((-lit - x) / 4, 0, end);
    const int end_lit = lit < x ? first_lit : clamp((lit - x) / 4 + 1, first_lit, end);
    const int halo = (reach + 3) / 4;

    float16 columns[(MOST_REACH + 1) * ROOM];
    for (int v = first_lit - halo; v < end_lit + halo; v += 4)
        add_columns(row + 16 * v, width, reach, first_of, steps, columns + v + HALO);
    for (int v = 0; v < first_lit; ++v)
        write_nodes((float16)(0.0f), x + 4 * v, y, radius, layer + layer_at);
    for (int v = first_lit; v < end_lit; v += 2) {
        const float* column = (const float*)(columns + v + HALO);
        float16 a = *(const loose16*)column;
        float16 b = *(const loose16*)(column + 16);
        for (int m = 4; m <= 4 * reach; m += 4) {
            column += 16 * ROOM;
            a += *(const loose16*)(column - m) + *(const loose16*)(column + m);
            b += *(const loose16*)(column + 16 - m) + *(const loose16*)(column + 16 + m);
        }
        write_nodes(a * scales, x + 4 * v, y, radius, layer + layer_at);
        if (v + 1 < end_lit) write_nodes(b * scales, x + 4 * v + 4, y, radius, layer + layer_at);
    }
    for (int v = max(end_lit, first_lit); v < end; ++v)
        write_nodes((float16)(0.0f), x + 4 * v, y, radius, layer + layer_at);
}
