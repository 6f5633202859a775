#include "glare/reference/diffraction.h"

#include <fftw3.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "glare/reference/lag_sums.h"

namespace seaglare::reference {

namespace {

constexpr double band_used = 0.3;   // cycles per sample: below, the gridding kernel keeps aliases out
constexpr double band_ends = 0.45;  // what lies between fades to nothing
constexpr double room = 2.04;       // pupil diameters in the plane: the autocorrelation does not meet itself
constexpr int row_block = 8;

// The next even number without prime factors above 7, which FFTW transforms fast.
int fast_size(double at_least) {
    for (int n = 2 * static_cast<int>(std::ceil(std::max(at_least, 16.0) / 2));; n += 2) {
        int rest = n;
        for (int factor : {2, 3, 5, 7})
            while (rest % factor == 0)
                rest /= factor;
        if (rest == 1) return n;
    }
}

double sinc(double x) {
    const double t = std::numbers::pi * x;
    return std::abs(t) < 1e-12 ? 1 : std::sin(t) / t;
}

struct FreePlane {
    void operator()(double* plane) const { fftw_free(plane); }
};

void run(fftw_plan plan) {
    if (plan == nullptr) throw std::bad_alloc();
    fftw_execute(plan);
    fftw_destroy_plan(plan);
}

template <typename Work>
void in_parallel(int count, Work work) {
    std::atomic<int> next{0};
    const auto worker = [&] {
        for (int i = next++; i < count; i = next++)
            work(i);
    };
    std::vector<std::thread> threads(std::min(4U, std::max(1U, std::thread::hardware_concurrency())) - 1);
    for (std::thread& thread : threads)
        thread = std::thread(worker);
    worker();
    for (std::thread& thread : threads)
        thread.join();
}

}  // namespace

Diffraction::Diffraction(const Aperture& aperture, double widest_frequency_per_mm) {
    if (!(aperture.pupil_mm > 0) || !(widest_frequency_per_mm > 0) ||
        !std::isfinite(aperture.pupil_mm * widest_frequency_per_mm))
        throw std::invalid_argument("diffraction: pupil and frequency must be positive and finite");
    widest_per_mm_ = widest_frequency_per_mm;
    // At least 256 samples across the pupil, for patterns that are looked at from near.
    const double coarsest = std::min(band_used / widest_frequency_per_mm, aperture.pupil_mm / 256);
    n_ = fast_size(room * aperture.pupil_mm / coarsest);
    spacing_mm_ = room * aperture.pupil_mm / n_;
    const auto rows = static_cast<std::size_t>(n_);
    const std::size_t stride = rows + 2;  // as an in-place real transform wants it
    const std::unique_ptr<double, FreePlane> plane(fftw_alloc_real(rows * stride));
    if (!plane) throw std::bad_alloc();
    double* const data = plane.get();
    auto* const spectrum = reinterpret_cast<fftw_complex*>(data);

    const GriddingKernel kernel;
    draw_aperture(aperture, n_, spacing_mm_, kernel, data, stride);
    run(fftw_plan_dft_r2c_2d(n_, n_, data, spectrum, FFTW_ESTIMATE));
    std::vector<double> weight(rows / 2 + 1);
    for (std::size_t k = 0; k < weight.size(); ++k) {
        const double frequency = static_cast<double>(k) / n_;
        const double fade = std::clamp((band_ends - frequency) / (band_ends - band_used), 0.0, 1.0);
        const double kept = fade * fade * (3 - 2 * fade);
        weight[k] = kept > 0 ? kept / (kernel.transform(frequency) * kernel.transform(frequency)) : 0;
    }
    for (std::size_t y = 0; y < rows; ++y) {
        for (std::size_t x = 0; x <= rows / 2; ++x) {
            fftw_complex& f = spectrum[y * (stride / 2) + x];
            f[0] = (f[0] * f[0] + f[1] * f[1]) * weight[x] * weight[std::min(y, rows - y)];
            f[1] = 0;
        }
    }
    run(fftw_plan_dft_c2r_2d(n_, n_, spectrum, data, FFTW_ESTIMATE));

    side_ = std::min(n_ / 2, static_cast<int>(std::ceil(aperture.pupil_mm / spacing_mm_)) + 4);
    const auto side = static_cast<std::size_t>(side_);
    even_.resize(side * side);
    odd_.resize(side * side);
    for (std::size_t y = 0; y < side; ++y) {
        for (std::size_t x = 0; x < side; ++x) {
            const double right = data[y * stride + x];
            const double left = data[y * stride + (rows - x) % rows];
            // Each lag (x, y) stands for the four of the same size; those on an axis for two, the origin for itself.
            const double axis = (x == 0 ? 0.5 : 1.0) * (y == 0 ? 0.5 : 1.0);
            even_[y * side + x] = 2 * axis * (right + left);
            odd_[y * side + x] = 2 * axis * (right - left);
        }
    }
    // |F|^2 = h^4 |DFT|^2; C = sum over frequencies of that / S^2; the sum over lags brings h^2.
    const double extent = n_ * spacing_mm_;
    const double open = std::numbers::pi * aperture.pupil_mm * aperture.pupil_mm / 4;
    scale_ = std::pow(spacing_mm_, 6) / (extent * extent * open);
}

Plane Diffraction::pattern(double wavelength_nm, double pitch, int radius) const {
    const double wavelength_mm = wavelength_nm * 1e-6;
    if (!(wavelength_mm > 0) || !(pitch > 0) || radius < 0)
        throw std::invalid_argument("diffraction: wavelength and pitch must be positive");
    if ((radius + 0.5) * pitch / wavelength_mm > widest_per_mm_ * 1.0000001)
        throw std::invalid_argument("diffraction: the pattern reaches beyond the widest frequency");
    const auto side = static_cast<std::size_t>(side_);
    const auto width = static_cast<std::size_t>(radius) + 1;
    const double turns = pitch * spacing_mm_ / wavelength_mm;  // per lag and pixel
    std::vector<double> cosine(side * width);
    std::vector<double> sine(side * width);
    for (std::size_t x = 0; x < side; ++x) {
        const double box = sinc(turns * static_cast<double>(x));
        for (std::size_t a = 0; a < width; ++a) {
            const double angle = 2 * std::numbers::pi * turns * static_cast<double>(x * a);
            cosine[x * width + a] = box * std::cos(angle);
            sine[x * width + a] = box * std::sin(angle);
        }
    }
    // Over x first: for every row of lags one value per column of pixels.
    std::vector<double> even_rows(side * width);
    std::vector<double> odd_rows(side * width);
    in_parallel((side_ + row_block - 1) / row_block, [&](int block) {
        const auto first = static_cast<std::size_t>(block) * row_block;
        const std::size_t rows = std::min(side - first, static_cast<std::size_t>(row_block));
        // The autocorrelation is zero beyond one diameter.
        const double reach2 = static_cast<double>(side_) * side_ - static_cast<double>(first * first);
        const auto reach = std::min(side, static_cast<std::size_t>(std::sqrt(std::max(reach2, 0.0))) + 4);
        add_lag_sums(even_.data() + first * side, side, rows, reach, cosine.data(), width,
                     even_rows.data() + first * width);
        add_lag_sums(odd_.data() + first * side, side, rows, reach, sine.data(), width,
                     odd_rows.data() + first * width);
    });
    const std::size_t full = 2 * static_cast<std::size_t>(radius) + 1;
    const auto centre = static_cast<std::size_t>(radius);
    const double scale = scale_ * (pitch / wavelength_mm) * (pitch / wavelength_mm);
    Plane plane(full * full);
    in_parallel(radius + 1, [&](int pixel_row) {
        const auto b = static_cast<std::size_t>(pixel_row);
        std::vector<double> even_sum(width);
        std::vector<double> odd_sum(width);
        for (std::size_t y = 0; y < side; ++y) {
            const double c = cosine[y * width + b];
            const double s = sine[y * width + b];
            for (std::size_t a = 0; a < width; ++a) {
                even_sum[a] += c * even_rows[y * width + a];
                odd_sum[a] += s * odd_rows[y * width + a];
            }
        }
        for (std::size_t a = 0; a < width; ++a) {
            const double same = scale * (even_sum[a] - odd_sum[a]);
            const double mirrored = scale * (even_sum[a] + odd_sum[a]);
            plane[(centre + b) * full + centre + a] = plane[(centre - b) * full + centre - a] = same;
            plane[(centre - b) * full + centre + a] = plane[(centre + b) * full + centre - a] = mirrored;
        }
    });
    return plane;
}

}  // namespace seaglare::reference
