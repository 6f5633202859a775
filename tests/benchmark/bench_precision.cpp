// Which buffers may be half and which may not: the pattern with one buffer at a time rounded to a half's ten fraction bits right
// after it was written, against the pattern with none, and a picture of a thousand lights summed in halves against one in
// double precision. Prints CSV. `plain` is stored as it is, `scaled` by a power of two that lets the largest value just fit.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "glare/eye/noise.h"
#include "glare/psf/cie_curve.h"
#include "glare/psf/pattern.h"
#include "glare/tone/operators.h"
#include "tests/benchmark/precision_hooks.h"

namespace {

using namespace seaglare::glare;
using namespace seaglare::bench;

constexpr double background_cd_m2 = 1e-3;  // starlight
constexpr double illuminance_lx = 1e-2;    // 10 000 cd at 1 km
constexpr std::uint64_t seed = 7;

double code_of(double luminance_cd_m2) {
    static const ToneCurve curve = tone_curve({}, background_cd_m2);
    return 255 * srgb_encode(std::min(1.0, tone_map(curve, background_cd_m2 + luminance_cd_m2)));
}

double luminance(const float* rgbv) {
    return 0.2126 * static_cast<double>(rgbv[0]) + 0.7152 * static_cast<double>(rgbv[1]) +
           0.0722 * static_cast<double>(rgbv[2]);
}

struct Loss {
    double l1 = 0;     // of all layers' luminance, relative
    double worst = 0;  // of a node's luminance, relative
    double codes = 0;  // the largest change of an 8-bit code: point layer, 10 000 cd at 1 km by starlight
    double core = 0;   // of the core's energy, relative
};

Loss loss_of(const Pattern& p, const Pattern& exact) {
    Loss loss;
    double apart = 0;
    double total = 0;
    const std::size_t side = 2 * static_cast<std::size_t>(exact.radius_nodes) + 1;
    for (std::size_t i = 0; i + 4 <= exact.skirt.size(); i += 4) {
        const double is = luminance(&p.skirt[i]);
        const double was = luminance(&exact.skirt[i]);
        apart += std::abs(is - was);
        total += std::abs(was);
        // The fading rim is black on any display.
        if (was * illuminance_lx > 1e-3 * background_cd_m2)
            loss.worst = std::max(loss.worst, std::abs(is / was - 1));
        if (i < side * side * 4)
            loss.codes =
                std::max(loss.codes, std::abs(code_of(illuminance_lx * is) - code_of(illuminance_lx * was)));
    }
    loss.l1 = apart / total;
    loss.core = std::abs(luminance(p.core_energy[0].data()) / luminance(exact.core_energy[0].data()) - 1);
    return loss;
}

struct Case {
    const char* name;
    double pitch;
    double pupil_mm;
};

Pattern pattern_of(const Case& c) {
    PatternSettings settings;
    settings.transform_size = 512;
    settings.wide_field_size = 4096;
    const auto source = make_cl_pattern_source(young_eye(), settings, seed);
    PatternRequest request;
    request.pupil_mm = c.pupil_mm;
    request.pitch = c.pitch;
    request.largest_disc_nodes = 6;
    return source->make(request);
}

void print(const std::string& name, const char* buffer, const char* stored, const Loss& loss,
           const ValueRange& range) {
    const double values = std::max(range.values, 1.0);
    std::printf("%s,%s,%s,%.1e,%.1e,%.3f,%.1e,%.1e,%.1e,%.2g,%.2g,%.2g\n", name.c_str(), buffer, stored,
                loss.l1, loss.worst, loss.codes, loss.core, range.least, range.largest,
                range.overflown / values, range.subnormal / values, range.vanished / values);
    std::fflush(stdout);
}

struct Buffer {
    const char* name;
    Written written;
    int fraction_bits = 10;
};

std::vector<Buffer> chain() {
    constexpr int most = 1 << 30;
    return {
        {"core: aperture", {"draw_tiles", "plane", "n", 0, 1024}},
        {"core: aperture", {"draw_aperture", "plane", "n", 0, 1024}},
        {"core: rows transformed", {"transform_rows", "plane", "n", 0, 1024}},
        {"core: spectrum", {"transform_columns", "plane", "", 0, 0}},
        {"core: sums of rows", {"sum_rows", "table", "", 0, 0}},
        {"core: energy table", {"sum_columns", "table", "", 0, 0}},
        {"wide field: aperture", {"draw_tiles", "plane", "n", 1025, most}},
        {"wide field: aperture", {"draw_aperture", "plane", "n", 1025, most}},
        // Kept in halves: what those cost shows when one bit more is taken, and is half of it.
        {"wide field: rows transformed (is half; here 9 bits)",
         {"transform_rows", "plane", "n", 1025, most},
         9},
        {"wide field: sums of columns", {"sum_wide_columns", "sums", "", 0, 0}},
        {"wide field: energy table", {"sum_across_columns", "table", "", 0, 0}},
        {"wide field: cells", {"spread_tiles", "out", "wide_count", 0, 0}},
        {"cells of the screen", {"spread_tiles", "out", "wide_count", 1, most}},
        {"skirt", {"split_core", "skirt", "", 0, 0}},
        {"energies of core and skirt", {"split_core", "energies", "", 0, 0}},
        {"energy balance", {"balance", "result", "", 0, 0}},
        {"disc layers", {"average_rows", "layer", "", 0, 0}},
        {"disc layers", {"average_disc", "layer", "", 0, 0}},
    };
}

// Summing lights.

struct Picture {
    int width = 480;
    int height = 270;
    std::vector<double> cd_m2;
    Picture() : cd_m2(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
    double& at(int x, int y) {
        return cd_m2[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)];
    }
};

enum class Store : std::uint8_t { exact, half_at_the_end, half_each_time };

double stored(double value, Store store) {
    return store == Store::half_each_time ? static_cast<double>(rounded(static_cast<float>(value), 10))
                                          : value;
}

// Lights anywhere on the picture, of 1e-6 ... 1e-2 lx.
template <typename Add>
void for_each_light(int lights, const Picture& picture, const Add& add) {
    for (int k = 0; k < lights; ++k) {
        const auto key = static_cast<std::uint64_t>(k);
        const int x = static_cast<int>(uniform(seed, key, 0) * picture.width);
        const int y = static_cast<int>(uniform(seed, key, 1) * picture.height);
        add(x, y, std::pow(10, -6 + 4 * uniform(seed, key, 2)));
    }
}

Picture skirts(const Pattern& p, int lights, Store store) {
    Picture picture;
    const int radius = p.radius_nodes;
    const std::ptrdiff_t side = 2 * radius + 1;
    for_each_light(lights, picture, [&](int x, int y, double lx) {
        for (int b = std::max(-radius, -y); b <= std::min(radius, picture.height - 1 - y); ++b)
            for (int a = std::max(-radius, -x); a <= std::min(radius, picture.width - 1 - x); ++a) {
                const float* const node = p.skirt.data() + 4 * ((b + radius) * side + a + radius);
                double& sum = picture.at(x + a, y + b);
                sum = stored(sum + lx * luminance(node), store);
            }
    });
    return picture;
}

// The tail on a grid of cells of 16 px, one value each: what lies between is interpolated, and errs by no more.
Picture tails(const Pattern& p, int lights, Store store) {
    constexpr int cell_px = 16;
    Picture picture;
    for_each_light(lights, picture, [&](int x, int y, double lx) {
        for (int row = 0; row < picture.height; row += cell_px)
            for (int column = 0; column < picture.width; column += cell_px) {
                const double sine = std::min(1.0, std::hypot(column - x, row - y) * p.pitch);
                const double curve = cie_total_glare_sr(std::asin(sine) * 180 / std::numbers::pi,
                                                        p.tail_age_years, p.tail_pigmentation);
                const double fades = fade_window(sine, p.window_inner, p.window_outer);
                double& sum = picture.at(column, row);
                sum = stored(sum + lx * p.tail_scale * curve * (1 - fades), store);
            }
    });
    return picture;
}

void compare(const char* name, const char* store, const Picture& is, const Picture& exact, bool at_the_end) {
    Loss loss;
    double apart = 0;
    double total = 0;
    ValueRange range;
    for (std::size_t i = 0; i < exact.cd_m2.size(); ++i) {
        const double was = exact.cd_m2[i];
        if (was == 0) continue;
        const double now =
            at_the_end ? static_cast<double>(rounded(static_cast<float>(is.cd_m2[i]), 10)) : is.cd_m2[i];
        apart += std::abs(now - was);
        total += was;
        if (was > 1e-3 * background_cd_m2) loss.worst = std::max(loss.worst, std::abs(now / was - 1));
        loss.codes = std::max(loss.codes, std::abs(code_of(now) - code_of(was)));
        range.values += 1;
        range.largest = std::max(range.largest, was);
        range.least = range.least == 0 ? was : std::min(range.least, was);
        range.overflown += was > 65504 ? 1 : 0;
        range.subnormal += was < 0x1p-14 ? 1 : 0;
        range.vanished += was < 0x1p-25 ? 1 : 0;
    }
    loss.l1 = apart / total;
    print("1000 lights", name, store, loss, range);
}

void texture(const Case& c, const Pattern& exact) {
    for (const bool scaled : {false, true}) {
        Pattern p = exact;
        ValueRange range;
        float largest = 0;
        for (const float v : p.skirt)
            largest = std::max(largest, std::abs(v));
        const int exponent = scaled ? 14 - std::ilogb(largest) : 0;
        for (float& v : p.skirt) {
            const double magnitude = std::abs(static_cast<double>(v));
            if (magnitude > 0) {
                range.values += 1;
                range.largest = std::max(range.largest, magnitude);
                range.least = range.least == 0 ? magnitude : std::min(range.least, magnitude);
                range.overflown += magnitude > 65504 ? 1 : 0;
                range.subnormal += magnitude < 0x1p-14 ? 1 : 0;
                range.vanished += magnitude < 0x1p-25 ? 1 : 0;
            }
            v = std::ldexp(rounded(std::ldexp(v, exponent), 10), -exponent);
        }
        print(c.name, "pattern texture (is half and scaled)", scaled ? "scaled" : "plain", loss_of(p, exact),
              range);
    }
}

}  // namespace

int main() {
    std::puts(
        "case,buffer,stored,L1,worst node,codes,core energy,least value,largest value,overflown,subnormal,"
        "vanished");
    std::set<std::string> seen;
    for (const Case& c :
         {Case{"45 deg 720 lines 6 mm", 1 / 869.1, 6}, Case{"30 deg 2160 lines 3 mm", 1 / 4030.6, 3}}) {
        const Pattern exact = pattern_of(c);
        print(c.name, "none, made again", "single", loss_of(pattern_of(c), exact), {});
        for (const Buffer& buffer : chain()) {
            for (const bool scaled : {false, true}) {
                round_after(buffer.written, {buffer.fraction_bits, scaled});
                const Pattern p = pattern_of(c);
                stop();
                const ValueRange range = range_seen();
                if (range.values == 0) continue;  // a device has one way or another
                seen.insert(buffer.name);
                print(c.name, buffer.name, scaled ? "scaled" : "plain", loss_of(p, exact), range);
            }
        }
        texture(c, exact);
        if (c.pupil_mm < 6) continue;
        const Picture sum = skirts(exact, 1000, Store::exact);
        compare("HDR sum", "half at the end", sum, sum, true);
        compare("HDR sum", "half each time", skirts(exact, 1000, Store::half_each_time), sum, false);
        const Picture grid = tails(exact, 1000, Store::exact);
        compare("coarse grid of tails", "half at the end", grid, grid, true);
        compare("coarse grid of tails", "half each time", tails(exact, 1000, Store::half_each_time), grid,
                false);
    }
    bool all = true;
    for (const Buffer& buffer : chain()) {
        if (seen.count(buffer.name) > 0) continue;
        std::fprintf(stderr, "bench_precision: nothing writes '%s' on this device\n", buffer.name);
        all = false;
    }
    return all ? 0 : 1;
}
