// From cumulative energy to the pattern on the screen's grid.
//
// A node's box is half the pitch wide on either side, so the boxes' corners are at 0 (on the axes, where a box is cut in
// two), 1/2, 3/2, ... pitch. First the cumulative energy beyond every corner, summed over wavelengths in colour; a
// node is then a difference of four corners, whatever the number of wavelengths.

// The energy at or beyond (x, y), in samples of the transform.
float at_edge(__global const float* table, int stride, int edges, float per_step, float x, float y) {
    // Cell k covers k - 1/2 ... k + 1/2; edge 0 is the axis, edge i > 0 is at (i - 1) step + 1/2.
    const float limit = (float)(edges - 1);
    const float ex = min(x < 0.5f ? 2.0f * x : (x - 0.5f) * per_step + 1.0f, limit);
    const float ey = min(y < 0.5f ? 2.0f * y : (y - 0.5f) * per_step + 1.0f, limit);
    const int i = min((int)ex, edges - 2);
    const int j = min((int)ey, edges - 2);
    const float tx = ex - i;
    const float ty = ey - j;
    __global const float* row = table + (size_t)j * stride + i;
    const float low = row[0] + tx * (row[1] - row[0]);
    const float high = row[stride] + tx * (row[stride + 1] - row[stride]);
    return low + ty * (high - low);
}

// spectrum[2 k] = weights of wavelength k in rgb + scotopic, spectrum[2 k + 1].x = samples of the transform per unit of
// direction cosine.
__kernel void spread_corners(__global const float* table, int edges, int stride, float per_step,
                             __global const float4* spectrum, int wavelengths, float pitch, int corners,
                             __global float4* out) {
    const int id = get_global_id(0);
    if (id >= 2 * corners * corners) return;
    const int quadrant = id / (corners * corners);
    const int i = id % corners;
    const int j = (id / corners) % corners;
    __global const float* quarter = table + (size_t)quadrant * edges * stride;
    const float u = i == 0 ? 0.0f : ((float)i - 0.5f) * pitch;
    const float v = j == 0 ? 0.0f : ((float)j - 0.5f) * pitch;
    float4 sum = (float4)(0.0f);
    for (int k = 0; k < wavelengths; ++k) {
        const float samples = spectrum[2 * k + 1].x;
        sum += spectrum[2 * k] * at_edge(quarter, stride, edges, per_step, u * samples, v * samples);
    }
    out[id] = sum;
}

// The core's table as above, which has energy only up to `reach` samples, and wide fields, spread before, with weights.
__kernel void join_corners(__global const float* table, int edges, int stride,
                           __global const float4* spectrum, int wavelengths, float pitch, int corners, float reach,
                           __global const float4* wide_a, __global const float4* wide_b,
                           __global const float4* wide_c, __global const float4* wide_d, float4 weights,
                           __global float4* out) {
    const int id = get_global_id(0);
    if (id >= 2 * corners * corners) return;
    const int quadrant = id / (corners * corners);
    const int i = id % corners;
    const int j = (id / corners) % corners;
    __global const float* quarter = table + (size_t)quadrant * edges * stride;
    const float u = i == 0 ? 0.0f : ((float)i - 0.5f) * pitch;
    const float v = j == 0 ? 0.0f : ((float)j - 0.5f) * pitch;
    float4 sum = weights.x * wide_a[id];
    if (weights.y > 0.0f) sum += weights.y * wide_b[id];
    if (weights.z > 0.0f) sum += weights.z * wide_c[id];
    if (weights.w > 0.0f) sum += weights.w * wide_d[id];
    for (int k = 0; k < wavelengths; ++k) {
        const float samples = spectrum[2 * k + 1].x;
        const float x = u * samples;
        const float y = v * samples;
        if (x < reach && y < reach) sum += spectrum[2 * k] * at_edge(quarter, stride, edges, 1.0f, x, y);
    }
    out[id] = sum;
}

float4 cell(__global const float4* corner, int corners, int quadrant, int i, int j) {
    __global const float4* at = corner + ((size_t)quadrant * corners + j) * corners + i;
    return (at[0] - at[1]) - (at[corners] - at[corners + 1]);
}

// The energy in the box of node (a, b). The pattern is point-symmetric: the quarter a < 0, b > 0 is the mirror of
// quadrant 1, and a node on an axis has a half in each.
float4 node_energy(__global const float4* corner, int corners, int a, int b) {
    const int i = abs(a);
    const int j = abs(b);
    if (a == 0 && b == 0) return 2.0f * (cell(corner, corners, 0, 0, 0) + cell(corner, corners, 1, 0, 0));
    if (a == 0 || b == 0) return cell(corner, corners, 0, i, j) + cell(corner, corners, 1, i, j);
    return cell(corner, corners, (a > 0) == (b > 0) ? 0 : 1, i, j);
}

// One item per ring of nodes: the factor that gives the ring's mean luminance `scale` times its target. Half the nodes: the
// other half mirrors them.
__kernel void calibrate_rings(__global const float4* corner, int corners, int structure_radius, int rings,
                              __global const float* targets, float scale, __global float* gains) {
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
            const float4 right = node_energy(corner, corners, a, b);
            const float4 left = node_energy(corner, corners, -a, b);
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

// One item per row of nodes: splits core from skirt, fades the skirt out, and leaves behind what the discs need: the
// skirt with a border of zeros (side + 2 margin wide) and its prefix sums along the row (one entry wider).
__kernel void split_rows(__global const float4* corner, int corners, int structure_radius, int border_radius,
                         float pitch, float window_inner, float window_outer, float core_radius, int calibrated,
                         __global const float* gains,
                         __global float4* skirt, __global float4* prefix, __global float4* row_energy) {
    const int side = 2 * border_radius + 1;
    const int row = get_global_id(0);
    if (row >= side) return;
    const int b = row - border_radius;
    const float per_sr = 1.0f / (pitch * pitch);
    __global float4* out = skirt + (size_t)row * side;
    __global float4* sums = prefix + (size_t)row * (side + 1);
    float4 core_sum = (float4)(0.0f);
    float4 sum = (float4)(0.0f);
    sums[0] = sum;
    for (int column = 0; column < side; ++column) {
        const int a = column - border_radius;
        float4 value = (float4)(0.0f);
        if (abs(a) <= structure_radius && abs(b) <= structure_radius) {
            const float distance = sqrt((float)(a * a + b * b));
            const float sine = distance * pitch;
            float window = sine <= window_inner ? 1.0f : 0.0f;
            if (sine > window_inner && sine < window_outer)
                window = 0.5f + 0.5f * cospi((sine - window_inner) / (window_outer - window_inner));
            float core = 0.0f;
            if (distance < core_radius) {
                const float c = cospi(0.5f * distance / core_radius);
                core = c * c;
            }
            float4 energy = window > 0.0f ? node_energy(corner, corners, a, b) * window : (float4)(0.0f);
            if (calibrated) {
                const int ring = (int)distance;
                energy *= mix(gains[ring], gains[ring + 1], distance - ring);
            }
            core_sum += energy * core;
            value = energy * ((1.0f - core) * per_sr);
        }
        out[column] = value;
        sum += value;
        sums[column + 1] = sum;
    }
    row_energy[2 * row] = core_sum;
    row_energy[2 * row + 1] = sum * (pitch * pitch);
}

// result[0] = the factor per channel that gives core + skirt the energy they should have, result[1] = core's energy after
// it, result[2] = energy of core + skirt before it. A skirt that is calibrated stays, and the core has what is left.
__kernel void balance(__global const float4* row_energy, int rows, float structure_energy, int calibrated,
                      __global float4* result) {
    float4 core = (float4)(0.0f);
    float4 skirt = (float4)(0.0f);
    for (int r = 0; r < rows; ++r) {
        core += row_energy[2 * r];
        skirt += row_energy[2 * r + 1];
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

// One layer: the skirt averaged over a disc. Half the nodes; the other half mirrors them.
__kernel void average_disc(__global const float4* skirt, __global const float4* prefix, int border_radius,
                           int radius, __global const int2* spans, int span_begin, int span_end,
                           float span_weight, __global const float4* taps, int tap_begin, int tap_end,
                           __global const float4* balance_result, __global float4* layer) {
    const int side = 2 * radius + 1;
    const int column = get_global_id(0);
    const int row = get_global_id(1) + radius;
    // In the middle row an item and its mirror are of one row: only one of the two writes.
    if (column >= side || row >= side || (row == radius && column > radius)) return;
    const int margin = border_radius - radius;
    const int bordered = 2 * border_radius + 1;
    const int x = column + margin;
    const int y = row + margin;
    float4 sum = (float4)(0.0f);
    for (int k = span_begin; k < span_end; ++k) {
        const int2 span = spans[k];
        __global const float4* sums = prefix + (size_t)(y + span.x) * (bordered + 1) + x;
        sum += sums[span.y + 1] - sums[-span.y];
    }
    sum *= span_weight;
    for (int k = tap_begin; k < tap_end; ++k) {
        const float4 tap = taps[k];
        sum += tap.z * skirt[(size_t)(y + (int)tap.y) * bordered + x + (int)tap.x];
    }
    sum *= balance_result[0];
    layer[(size_t)row * side + column] = sum;
    layer[(size_t)(side - 1 - row) * side + (side - 1 - column)] = sum;
}
