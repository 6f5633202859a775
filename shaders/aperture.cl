// Draws the pupil's amplitude: 0 ... 1 by particles and gratings, less what lids and lashes cover (`veiled`: there are
// some), times the cosine or, when `imaginary`, the sine of the phase of an eye out of focus, `defocus` r^2 with r in
// samples. One work-group per tile of 64 x 64 samples, one work-item per row of it: each row is
// written by one item, in one order, so the picture is the same on every run.
#define TILE 64
#define SUB_ROWS 8

// Adds the part of a row (0 <= y <= 1, 64 samples) that a disc covers, as the union with what is there already;
// independent edges: 1 - (1 - a)(1 - b). Exact chords on SUB_ROWS lines within the disc's own share of the row, so that
// a disc smaller than a sample keeps its area.
void add_disc(float* coverage, float x, float y, float radius) {
    const float low = max(0.0f, y - radius);
    const float high = min(1.0f, y + radius);
    if (high <= low) return;
    const float step = (high - low) / SUB_ROWS;
    float half_chord[SUB_ROWS];
    float widest = 0.0f;
    float narrowest = radius;
    for (int s = 0; s < SUB_ROWS; ++s) {
        const float dy = low + (s + 0.5f) * step - y;
        half_chord[s] = sqrt(max(radius * radius - dy * dy, 0.0f));
        widest = max(widest, half_chord[s]);
        narrowest = min(narrowest, half_chord[s]);
    }
    const int first = max(0, (int)floor(x - widest));
    const int last = min(TILE - 1, (int)floor(x + widest));
    for (int i = first; i <= last; ++i) {
        const float left = (float)i - x;
        float c = high - low;
        if (left < -narrowest || left + 1.0f > narrowest) {
            float sum = 0.0f;
            for (int s = 0; s < SUB_ROWS; ++s)
                sum += max(min(half_chord[s], left + 1.0f) - max(-half_chord[s], left), 0.0f);
            c = min(sum * step, 1.0f);
        }
        coverage[i] += c - coverage[i] * c;
    }
}

// Adds the part of a row that a convex quadrangle covers: chords on SUB_ROWS lines within its own share of the row.
// Shapes that meet along an edge add up to one, as those of a lash do.
void add_quad(float* coverage, float8 q, float left, float down) {
    const float4 x = q.s0246 - left;
    const float4 y = q.s1357 - down;
    const float low = max(0.0f, min(min(y.x, y.y), min(y.z, y.w)));
    const float high = min(1.0f, max(max(y.x, y.y), max(y.z, y.w)));
    if (high <= low) return;
    const float step = (high - low) / SUB_ROWS;
    const float4 slope = (x.yzwx - x) / (y.yzwx - y);  // of edges that no line meets: unused
    for (int s = 0; s < SUB_ROWS; ++s) {
        const float line = low + (s + 0.5f) * step;
        const int4 met = (y <= line) ^ (y.yzwx <= line);
        const float4 at = x + (line - y) * slope;
        const float4 least = select((float4)(2.0f * TILE), at, met);
        const float4 most = select((float4)(-2.0f * TILE), at, met);
        const float from = clamp(min(min(least.x, least.y), min(least.z, least.w)), 0.0f, (float)TILE);
        const float to = clamp(max(max(most.x, most.y), max(most.z, most.w)), 0.0f, (float)TILE);
        if (to <= from) continue;
        const int first = (int)from;
        const int last = min(TILE - 1, (int)to);
        for (int i = first; i <= last; ++i)
            coverage[i] += step * max(min(to, i + 1.0f) - max(from, (float)i), 0.0f);
    }
}

// Integral of the square wave less its mean from 0 to t, periodic in t with period 1.
float16 wave_1(float16 t, float duty) {
    t -= floor(t);
    return select(duty * (1.0f - t), (1.0f - duty) * t, t < duty);
}

// Integral of wave_1 less its mean, likewise.
float16 wave_2(float16 t, float duty) {
    t -= floor(t);
    const float mean = 0.5f * duty * (1.0f - duty);
    const float16 rising = min(t, (float16)(duty));
    const float16 falling = t - rising;
    return 0.5f * (1.0f - duty) * rising * rising +
           duty * falling * ((1.0f - duty) - 0.5f * falling) - mean * t;
}

// Coverage of sixteen samples at (dx, dy) from the axis by radial lines: the square wave over azimuth averaged over the
// sample's square, to first order in the azimuth: two boxes, as wide as the square is along and across.
float16 grating_coverage(float16 dx, float16 dy, float count, float inner, float outer, float duty) {
    const float16 r = sqrt(dx * dx + dy * dy);
    const float16 ring = clamp(r - inner + 0.5f, 0.0f, 1.0f) * clamp(outer - r + 0.5f, 0.0f, 1.0f);
    const float16 t = atan2(dy, dx) * (count * 0.15915494309f);
    const float16 per_sample = count / (6.28318530718f * r * r);
    const float16 wide = max(fabs(dx), fabs(dy)) * per_sample;
    const float16 narrow = min(fabs(dx), fabs(dy)) * per_sample;
    const float16 a = 0.5f * (wide + narrow);
    const float16 b = 0.5f * (wide - narrow);
    const float16 one_box = (wave_1(t + 0.5f * wide, duty) - wave_1(t - 0.5f * wide, duty)) / wide;
    const float16 two_boxes =
        (wave_2(t + a, duty) - wave_2(t + b, duty) - wave_2(t - b, duty) + wave_2(t - a, duty)) /
        (wide * narrow);
    // The second difference drowns in rounding where the square hardly widens the box.
    const float16 wave = select(two_boxes, one_box, narrow < 0.05f * wide);
    return ring * clamp(wave + duty, 0.0f, 1.0f);
}

// `plane` begins with the first row of tile row `first_tile_row`.
__kernel void draw_aperture(__global float* plane, int n, int first_tile_row,
                            __global const int* tile_begin,
                            __global const float4* discs, float pupil_radius, float grating_count,
                            float grating_inner, float grating_outer, float grating_duty, float grating_depth,
                            int veiled, __global const int* veil_begin, __global const float8* veil,
                            float defocus, int imaginary) {
    const int tile_x = get_group_id(0);
    const int tile_y = get_group_id(1) + first_tile_row;
    const int y = tile_y * TILE + get_local_id(1);
    const int x = tile_x * TILE;
    const float axis = 0.5f * n;
    // Rows of the transform are padded to n + 2 reals.
    __global float* row = plane + (size_t)(y - first_tile_row * TILE) * (n + 2) + x;
    const float row_from_axis = (float)y + 0.5f - axis;
    const float nearest_x = clamp(axis, (float)x, (float)(x + TILE)) - axis;
    const float nearest = sqrt(nearest_x * nearest_x + row_from_axis * row_from_axis);
    if (nearest > pupil_radius + 1.0f) {
        for (int i = 0; i < TILE; i += 16)
            vstore16((float16)(0.0f), 0, row + i);
        return;
    }
    const float farthest_x = max(fabs((float)x - axis), fabs((float)(x + TILE) - axis));
    const float farthest = sqrt(farthest_x * farthest_x + row_from_axis * row_from_axis);
    const int all_open = farthest < pupil_radius - 1.0f;
    float pupil[TILE];
    float particles[TILE];
    for (int i = 0; i < TILE; ++i) {
        pupil[i] = all_open ? 1.0f : 0.0f;
        particles[i] = 0.0f;
    }
    if (!all_open) add_disc(pupil, axis - x, axis - y, pupil_radius);
    const int tile = tile_y * get_num_groups(0) + tile_x;
    if (veiled && veil_begin[tile] < veil_begin[tile + 1]) {
        float covered[TILE];
        for (int i = 0; i < TILE; ++i)
            covered[i] = 0.0f;
        for (int k = veil_begin[tile]; k < veil_begin[tile + 1]; ++k)
            add_quad(covered, veil[k], (float)x, (float)y);
        for (int i = 0; i < TILE; ++i)
            pupil[i] *= 1.0f - min(covered[i], 1.0f);
    }
    const int end = tile_begin[tile + 1];
    for (int k = tile_begin[tile]; k < end; ++k) {
        const float4 disc = discs[k];
        add_disc(particles, disc.x - x, disc.y - y, disc.z);
    }
    const int in_gratings =
        grating_count > 0.0f && farthest > grating_inner - 2.0f && nearest < grating_outer + 2.0f;
    const float16 steps = (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    for (int i = 0; i < TILE; i += 16) {
        float16 amplitude = vload16(0, pupil + i) * (1.0f - 2.0f * vload16(0, particles + i));
        if (in_gratings) {
            const float16 dx = (float)(x + i) + 0.5f - axis + steps;
            amplitude *= 1.0f - grating_depth * grating_coverage(dx, (float16)(row_from_axis), grating_count,
                                                                 grating_inner, grating_outer, grating_duty);
        }
        if (defocus != 0.0f) {
            const float16 dx = (float)(x + i) + 0.5f - axis + steps;
            const float16 phase = defocus * (dx * dx + row_from_axis * row_from_axis);
            amplitude *= imaginary ? sin(phase) : cos(phase);
        }
        vstore16(amplitude, 0, row + i);
    }
}
