// Draws the pupil's amplitude: 0 ... 1 by particles and gratings, less what lids and lashes cover (`veiled`: there are
// some), times the cosine or, when `imaginary`, the sine of the phase of an eye out of focus, `defocus` r^2 with r in
// samples. Tiles of 64 x 64 samples have lists of what lies in them. Each row of a tile is drawn by one item, in one order,
// so the picture is the same on every run.
//
// Two kernels do the same: draw_aperture with an item per row of a tile, for devices with thousands of them, and draw_tiles
// with an item per tile, for those with a few: there each particle is met once and not once for every row of its tile.
#define TILE 64
#define SUB_ROWS 8

// Adds the part of a row (0 <= y <= 1, 64 samples and room for 16 more) that a disc covers, as the union with what is there
// already; independent edges: 1 - (1 - a)(1 - b). Exact chords on SUB_ROWS lines within the disc's own share of the row, so
// that a disc smaller than a sample keeps its area. Sixteen samples at once: most discs need no more.
void add_disc(float* coverage, float x, float y, float radius) {
    const float low = max(0.0f, y - radius);
    const float high = min(1.0f, y + radius);
    if (high <= low) return;
    const float step = (high - low) / SUB_ROWS;
    const float8 lines = (float8)(0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f);
    const float8 dy = low - y + lines * step;
    float half_chord[SUB_ROWS];
    vstore8(sqrt(max(radius * radius - dy * dy, 0.0f)), 0, half_chord);
    const int first = max(0, (int)floor(x - radius));
    const int last = min(TILE - 1, (int)floor(x + radius));
    const float16 steps = (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    for (int i = first; i <= last; i += 16) {
        const float16 left = steps + ((float)i - x);
        const float16 right = left + 1.0f;
        float16 sum = (float16)(0.0f);
        for (int s = 0; s < SUB_ROWS; ++s) {
            const float16 chord = (float16)(half_chord[s]);
            sum += max(min(chord, right) - max(-chord, left), 0.0f);
        }
        const float16 c = min(sum * step, 1.0f);
        loose16* const at = (loose16*)(coverage + i);
        const float16 before = *at;
        *at = before + c - before * c;
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

// What does not change from row to row. `plane` begins with the first row of tile row `first_tile_row`.
typedef struct {
    int n;
    float pupil_radius;
    float grating_count;
    float grating_inner;
    float grating_outer;
    float grating_duty;
    float grating_depth;
    float defocus;
    int imaginary;
} aperture_shape;

// The distance of some samples of a row from the axis, at their nearest edge or their farthest.
float nearest_of(int x, int samples, float row_from_axis, float axis) {
    const float nearest_x = clamp(axis, (float)x, (float)(x + samples)) - axis;
    return sqrt(nearest_x * nearest_x + row_from_axis * row_from_axis);
}
float farthest_of(int x, int samples, float row_from_axis, float axis) {
    const float farthest_x = max(fabs((float)x - axis), fabs((float)(x + samples) - axis));
    return sqrt(farthest_x * farthest_x + row_from_axis * row_from_axis);
}

void clear_row(__global float* row) {
    for (int i = 0; i < TILE; i += 16)
        vstore16((float16)(0.0f), 0, row + i);
}

// Row y of the plane from sample x on, of which `particles` are known.
void draw_row(__global float* row, const aperture_shape* shape, int x, int y, const float* particles,
              __global const float8* veil, int veil_begin, int veil_end) {
    const float axis = 0.5f * shape->n;
    const float row_from_axis = (float)y + 0.5f - axis;
    const int all_open = farthest_of(x, TILE, row_from_axis, axis) < shape->pupil_radius - 1.0f;
    float pupil[TILE + 16];
    for (int i = 0; i < TILE + 16; ++i)
        pupil[i] = all_open ? 1.0f : 0.0f;
    if (!all_open) add_disc(pupil, axis - x, axis - y, shape->pupil_radius);
    if (veil_begin < veil_end) {
        float covered[TILE];
        for (int i = 0; i < TILE; ++i)
            covered[i] = 0.0f;
        for (int k = veil_begin; k < veil_end; ++k)
            add_quad(covered, veil[k], (float)x, (float)y);
        for (int i = 0; i < TILE; ++i)
            pupil[i] *= 1.0f - min(covered[i], 1.0f);
    }
    const float grating_outer = min(shape->grating_outer, shape->pupil_radius);
    const float16 steps = (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    for (int i = 0; i < TILE; i += 16) {
        float16 amplitude = *(const loose16*)(pupil + i) * (1.0f - 2.0f * *(const loose16*)(particles + i));
        const float16 dx = (float)(x + i) + 0.5f - axis + steps;
        if (shape->grating_count > 0.0f &&
            farthest_of(x + i, 16, row_from_axis, axis) > shape->grating_inner - 2.0f &&
            nearest_of(x + i, 16, row_from_axis, axis) < grating_outer + 2.0f)
            amplitude *= 1.0f - shape->grating_depth *
                                    grating_coverage(dx, (float16)(row_from_axis), shape->grating_count,
                                                     shape->grating_inner, shape->grating_outer,
                                                     shape->grating_duty);
        if (shape->defocus != 0.0f) {
            const float16 phase = shape->defocus * (dx * dx + row_from_axis * row_from_axis);
            amplitude *= shape->imaginary ? sin(phase) : cos(phase);
        }
        vstore16(amplitude, 0, row + i);
    }
}

__kernel void draw_aperture(__global float* plane, int n, int first_tile_row,
                            __global const int* tile_begin,
                            __global const float4* discs, float pupil_radius, float grating_count,
                            float grating_inner, float grating_outer, float grating_duty, float grating_depth,
                            int veiled, __global const int* veil_begin, __global const float8* veil,
                            float defocus, int imaginary) {
    const aperture_shape shape = {n,  pupil_radius, grating_count, grating_inner, grating_outer,
                                  grating_duty, grating_depth, defocus, imaginary};
    const int tile_x = get_group_id(0);
    const int tile_y = get_group_id(1) + first_tile_row;
    const int y = tile_y * TILE + get_local_id(1);
    const int x = tile_x * TILE;
    const float axis = 0.5f * n;
    // Rows of the transform are padded to n + 2 reals.
    __global float* row = plane + (size_t)(y - first_tile_row * TILE) * (n + 2) + x;
    if (nearest_of(x, TILE, (float)y + 0.5f - axis, axis) > pupil_radius + 1.0f) {
        clear_row(row);
        return;
    }
    float particles[TILE + 16];
    for (int i = 0; i < TILE + 16; ++i)
        particles[i] = 0.0f;
    const int tile = tile_y * get_num_groups(0) + tile_x;
    const int end = tile_begin[tile + 1];
    for (int k = tile_begin[tile]; k < end; ++k) {
        const float4 disc = discs[k];
        add_disc(particles, disc.x - x, disc.y - y, disc.z);
    }
    draw_row(row, &shape, x, y, particles, veil, veiled ? veil_begin[tile] : 0, veiled ? veil_begin[tile + 1] : 0);
}

__kernel void draw_tiles(__global float* plane, int n, int first_tile_row,
                         __global const int* tile_begin,
                         __global const float4* discs, float pupil_radius, float grating_count,
                         float grating_inner, float grating_outer, float grating_duty, float grating_depth,
                         int veiled, __global const int* veil_begin, __global const float8* veil,
                         float defocus, int imaginary) {
    const aperture_shape shape = {n,  pupil_radius, grating_count, grating_inner, grating_outer,
                                  grating_duty, grating_depth, defocus, imaginary};
    const int tile_y = get_global_id(1) + first_tile_row;
    const int x = get_global_id(0) * TILE;
    const int y = tile_y * TILE;
    const float axis = 0.5f * n;
    const int tile = tile_y * (n / TILE) + get_global_id(0);
    __global float* rows = plane + (size_t)(y - first_tile_row * TILE) * (n + 2) + x;
    float particles[TILE * (TILE + 16)];
    for (int i = 0; i < TILE * (TILE + 16); ++i)
        particles[i] = 0.0f;
    const float nearest_y = clamp(axis, (float)y, (float)(y + TILE)) - axis;
    const int lit = nearest_of(x, TILE, nearest_y, axis) <= pupil_radius + 1.0f;
    const int end = lit ? tile_begin[tile + 1] : tile_begin[tile];
    for (int k = tile_begin[tile]; k < end; ++k) {
        const float4 disc = discs[k];
        const float down = disc.y - y;
        const int last = min(TILE - 1, (int)floor(down + disc.z));
        for (int l = max(0, (int)floor(down - disc.z)); l <= last; ++l)
            add_disc(particles + l * (TILE + 16), disc.x - x, down - l, disc.z);
    }
    for (int l = 0; l < TILE; ++l) {
        __global float* row = rows + (size_t)l * (n + 2);
        if (nearest_of(x, TILE, (float)(y + l) + 0.5f - axis, axis) > pupil_radius + 1.0f)
            clear_row(row);
        else
            draw_row(row, &shape, x, y + l, particles + l * (TILE + 16), veil, veiled ? veil_begin[tile] : 0,
                     veiled ? veil_begin[tile + 1] : 0);
    }
}
