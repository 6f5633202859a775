#include "glare/psf/cl_eye_stage.h"

#include <cmath>
#include <numbers>

namespace seaglare::glare {

namespace {

constexpr std::size_t row_group = 16;
constexpr std::size_t strip_group = 4;

// Two quadrants, and a vector more: spread.cl reads whole vectors.
std::size_t table_bytes(int n, int stride) {
    return (2 * (static_cast<std::size_t>(n) / 2 + 2) * static_cast<std::size_t>(stride) + 16) *
           sizeof(float);
}

// What averaging over the sample's box takes from a frequency, as the factor that gives it back: 1/sinc^2(k/n).
std::vector<float> unboxing(int n) {
    std::vector<float> factors(static_cast<std::size_t>(n) / 2 + 1);
    factors[0] = 1;
    for (std::size_t k = 1; k < factors.size(); ++k) {
        const double x = std::numbers::pi * static_cast<double>(k) / n;
        factors[k] = static_cast<float>(std::pow(x / std::sin(x), 2));
    }
    return factors;
}

}  // namespace

ClEyeStage::ClEyeStage(const ClDevice& device, const EyeModel& eye, const PatternSettings& settings,
                       std::uint64_t seed)
    : device_(device),
      n_(settings.transform_size),
      stride_((settings.transform_size / 2 + 2 + 15) / 16 * 16),
      aperture_(device, eye, settings.transform_size, settings.plane_width_mm, seed),
      sum_rows_(device.program(KernelSet::pattern), "sum_rows"),
      sum_columns_(device.program(KernelSet::pattern), "sum_columns") {
    if (device.is_cpu() && n_ <= StripFft2d::most_samples)
        strip_fft_.emplace(device, n_);
    else
        fft_.emplace(device, n_);
    cl_context context = device.context();
    cl_command_queue queue = device.queue();
    plane_.reserve(context, queue, RealFft2d::bytes(n_), "pupil plane", true);
    table_.reserve(context, queue, table_bytes(n_, stride_), "energy table", true);
    const std::vector<float> factors = unboxing(n_);
    unbox_.reserve(context, queue, factors.size() * sizeof(float), "box factors");
    unbox_.write(queue, factors.size() * sizeof(float), factors.data());
    device.finish();
}

void ClEyeStage::draw_aperture(double pupil_mm, double time_s) {
    aperture_.place(time_s);
    draw(pupil_mm, ClAperture::Part::real);
}

void ClEyeStage::draw(double pupil_mm, ClAperture::Part part) {
    aperture_.draw(pupil_mm, plane_.get(), 0, aperture_.tile_rows(), part);
    drawn_radius_samples_ = aperture_.pupil_radius_samples(pupil_mm);
}

void ClEyeStage::transform() {
    if (!strip_fft_) {
        fft_->forward(device_.queue(), plane_.get());
        return;
    }
    // The pupil's rows and one for its blurred edge; the others are zero.
    const int reach = static_cast<int>(std::ceil(drawn_radius_samples_)) + 1;
    strip_fft_->forward(device_.queue(), plane_.get(), n_ / 2 - reach, n_ / 2 + reach);
}

void ClEyeStage::sum_rows(double pupil_mm, bool add) {
    // Parseval: the sum of |F|^2 over all frequencies is n^2 times the sum of P^2, the area of the open pupil.
    const double radius = aperture_.pupil_radius_samples(pupil_mm);
    const double scale = 1 / (static_cast<double>(n_) * n_ * std::numbers::pi * radius * radius);
    sum_rows_.set(plane_.get(), table_.get(), unbox_.get(), static_cast<cl_int>(n_),
                  static_cast<cl_int>(stride_), static_cast<cl_float>(scale), static_cast<cl_int>(add),
                  fade_inner_, fade_outer_);
    sum_rows_.launch(device_.queue(), 2 * (static_cast<std::size_t>(n_) / 2 + 1), row_group);
}

void ClEyeStage::sum_columns() {
    sum_columns_.set(table_.get(), static_cast<cl_int>(n_), static_cast<cl_int>(stride_));
    sum_columns_.launch(device_.queue(), 2 * static_cast<std::size_t>(stride_) / 16, strip_group);
}

void ClEyeStage::accumulate(double pupil_mm) {
    sum_rows(pupil_mm, false);
    sum_columns();
}

int ClEyeStage::update(const EyeInstant& instant) {
    if (made_for_ == instant) return 0;
    made_for_.reset();  // what follows may throw half way
    aperture_.place(instant);
    draw(instant.pupil_mm, ClAperture::Part::real);
    transform();
    sum_rows(instant.pupil_mm, false);
    int launches = 3 + fft_launches();
    if (instant.defocus_dioptre != 0) {
        draw(instant.pupil_mm, ClAperture::Part::imaginary);
        transform();
        sum_rows(instant.pupil_mm, true);
        launches += 2 + fft_launches();
    }
    sum_columns();
    made_for_ = instant;
    return launches;
}

int ClEyeStage::update(double pupil_mm, double time_s) {
    EyeInstant instant;
    instant.pupil_mm = pupil_mm;
    instant.time_s = time_s;
    return update(instant);
}

double ClEyeStage::transmitted(const EyeInstant& instant) const {
    return aperture_.transmitted(instant);
}

std::size_t ClEyeStage::device_bytes() const {
    return plane_.bytes() + table_.bytes() + unbox_.bytes() + aperture_.device_bytes() +
           (strip_fft_ ? strip_fft_->device_bytes() : fft_->own_bytes());
}

}  // namespace seaglare::glare
