#include "host_stub/report/thesis_pattern.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <new>

#include "glare/colour/spectrum.h"
#include "glare/eye/aperture.h"
#include "glare/psf/cpu_aperture.h"

namespace seaglare::report {

namespace {

using Pixel = std::array<float, 3>;

constexpr int n = ThesisPattern::n;
constexpr float centre = 256;
static_assert(2 * static_cast<int>(centre) == n);
constexpr auto pixels_in_all = static_cast<std::size_t>(n) * n;

// Of the processor for this thread: all of it runs on one, and a machine that does something else besides does not count.
double now_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double ms_since(double start_ms) {
    return now_ms() - start_ms;
}

struct FreePlane {
    void operator()(fftwf_complex* plane) const { fftwf_free(plane); }
};
using ComplexPlane = std::unique_ptr<fftwf_complex[], FreePlane>;

ComplexPlane new_plane() {
    ComplexPlane plane(fftwf_alloc_complex(pixels_in_all));
    if (!plane) throw std::bad_alloc();
    return plane;
}

std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * n + static_cast<std::size_t>(x);
}

// A texture with linear filtering and a black border.
float sample(const std::vector<float>& power, float x, float y) {
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    if (fx < 0 || fy < 0 || fx >= n - 1 || fy >= n - 1) return 0;
    const int i = static_cast<int>(fx);
    const int j = static_cast<int>(fy);
    const float tx = x - fx;
    const float ty = y - fy;
    const float low = power[at(i, j)] * (1 - tx) + power[at(i + 1, j)] * tx;
    const float high = power[at(i, j + 1)] * (1 - tx) + power[at(i + 1, j + 1)] * tx;
    return low * (1 - ty) + high * ty;
}

std::vector<Pixel> spread(const fftwf_complex* field) {
    // Cyclic shift, squared magnitude, sum 1.
    std::vector<float> power(pixels_in_all);
    double total = 0;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const fftwf_complex& f = field[at((x + n / 2) % n, (y + n / 2) % n)];
            total += static_cast<double>(power[at(x, y)] = f[0] * f[0] + f[1] * f[1]);
        }
    }
    struct Line {
        Pixel rgb{};
        float scale = 1;
    };
    std::array<Line, ThesisPattern::wavelengths> lines;
    double luminance = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double nm = 380 + 400.0 * static_cast<double>(i) / (ThesisPattern::wavelengths - 1);
        const glare::Xyz cmf = glare::colour_matching(nm);
        const double daylight = glare::d65(nm);
        const double ratio = 575 / nm;
        luminance += daylight * cmf.y;
        const auto rgb = glare::srgb_from_xyz({cmf.x * daylight, cmf.y * daylight, cmf.z * daylight});
        for (std::size_t c = 0; c < 3; ++c)
            lines[i].rgb[c] = static_cast<float>(rgb[c] * ratio * ratio / total);
        lines[i].scale = static_cast<float>(ratio);
    }
    for (Line& line : lines)
        for (float& value : line.rgb)
            value = static_cast<float>(static_cast<double>(value) / luminance);
    std::vector<Pixel> pixels(pixels_in_all);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            Pixel sum{};
            for (const Line& line : lines) {
                const float c = sample(power, (static_cast<float>(x) - centre) * line.scale + centre,
                                       (static_cast<float>(y) - centre) * line.scale + centre);
                for (std::size_t k = 0; k < 3; ++k)
                    sum[k] += c * line.rgb[k];
            }
            pixels[at(x, y)] = sum;
        }
    }
    return pixels;
}

std::vector<Pixel> disc_layer(const std::vector<Pixel>& pixels, int radius) {
    std::vector<Pixel> layer(pixels_in_all);
    int area = 0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i)
            area += i * i + j * j <= radius * radius ? 1 : 0;
    const float share = 1.0F / static_cast<float>(area);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            Pixel sum{};
            for (int j = -radius; j <= radius; ++j) {
                for (int i = -radius; i <= radius; ++i) {
                    if (i * i + j * j > radius * radius) continue;
                    if (x + i < 0 || x + i >= n || y + j < 0 || y + j >= n) continue;
                    const Pixel& p = pixels[at(x + i, y + j)];
                    for (std::size_t k = 0; k < 3; ++k)
                        sum[k] += p[k];
                }
            }
            for (std::size_t k = 0; k < 3; ++k)
                layer[at(x, y)][k] = share * sum[k];
        }
    }
    return layer;
}

}  // namespace

ThesisPattern make_thesis_pattern(const glare::EyeModel& eye, double pupil_mm, double plane_width_mm,
                                  std::uint64_t seed, const std::vector<int>& disc_radii_px) {
    ThesisPattern result;
    const ComplexPlane plane = new_plane();
    const fftwf_plan plan = fftwf_plan_dft_2d(n, n, plane.get(), plane.get(), FFTW_FORWARD, FFTW_MEASURE);
    if (plan == nullptr) throw std::bad_alloc();

    auto start = now_ms();
    const std::vector<float> parts =
        glare::draw_eye_parts(glare::ApertureParts(eye, seed), n, plane_width_mm);
    const std::vector<float> pupil = glare::draw_pupil(n, pupil_mm / 2 / plane_width_mm * n);
    for (std::size_t i = 0; i < pixels_in_all; ++i) {
        plane[i][0] = parts[i] * pupil[i];
        plane[i][1] = 0;
    }
    result.times.aperture_ms = ms_since(start);
    start = now_ms();
    fftwf_execute(plan);
    result.times.transform_ms = ms_since(start);
    fftwf_destroy_plan(plan);
    start = now_ms();
    result.pixels = spread(plane.get());
    result.times.spread_ms = ms_since(start);
    start = now_ms();
    for (const int radius : disc_radii_px)
        result.layers.push_back(disc_layer(result.pixels, radius));
    result.times.discs_ms = ms_since(start);
    return result;
}

double fftw_512_ms() {
    const ComplexPlane plane = new_plane();
    const fftwf_plan plan = fftwf_plan_dft_2d(n, n, plane.get(), plane.get(), FFTW_FORWARD, FFTW_MEASURE);
    if (plan == nullptr) throw std::bad_alloc();
    std::vector<double> times;
    for (int run = 0; run < 41; ++run) {
        for (std::size_t i = 0; i < pixels_in_all; ++i) {
            plane[i][0] = static_cast<float>(i % 7);
            plane[i][1] = 0;
        }
        const auto start = now_ms();
        fftwf_execute(plan);
        times.push_back(ms_since(start));
    }
    fftwf_destroy_plan(plan);
    std::nth_element(times.begin(), times.begin() + 20, times.end());
    return times[20];
}

}  // namespace seaglare::report
