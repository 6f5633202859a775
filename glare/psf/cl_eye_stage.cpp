#include "glare/psf/cl_eye_stage.h"

#include <cmath>
#include <numbers>

namespace seaglare::glare {

namespace {

constexpr std::size_t row_group = 16;
constexpr std::size_t strip_group = 4;

std::size_t table_bytes(int n, int stride) {
    return 2 * (static_cast<std::size_t>(n) / 2 + 2) * static_cast<std::size_t>(stride) * sizeof(float);
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
      plane_width_mm_(settings.plane_width_mm),
      parts_(eye, seed),
      gratings_(parts_.gratings(n_, plane_width_mm_)),
      fft_(device, n_),
      aperture_program_(device.build("aperture.cl")),
      table_program_(device.build("energy_table.cl")),
      draw_(aperture_program_.get(), "draw_aperture"),
      sum_rows_(table_program_.get(), "sum_rows"),
      sum_columns_(table_program_.get(), "sum_columns") {
    cl_context context = device.context();
    cl_command_queue queue = device.queue();
    plane_.reserve(context, queue, RealFft2d::bytes(n_), "pupil plane", true);
    table_.reserve(context, queue, table_bytes(n_, stride_), "energy table", true);
    const std::vector<float> factors = unboxing(n_);
    unbox_.reserve(context, queue, factors.size() * sizeof(float), "box factors");
    unbox_.write(queue, factors.size() * sizeof(float), factors.data());
    parts_.place(0, n_, plane_width_mm_, discs_);
    const auto tiles = static_cast<std::size_t>(n_ / TileLists::tile_side);
    tile_begin_.reserve(context, queue, (tiles * tiles + 1) * sizeof(std::int32_t), "tiles");
    tile_discs_.reserve(context, queue, (TileLists::worst_case(discs_) + 1) * sizeof(Disc), "particles");
    device.finish();
}

void ClEyeStage::draw_aperture(double pupil_mm, double time_s) {
    cl_command_queue queue = device_.queue();
    parts_.place(time_s, n_, plane_width_mm_, discs_);
    tiles_.sort(discs_, n_);
    tile_begin_.write(queue, tiles_.begin().size() * sizeof(std::int32_t), tiles_.begin().data());
    tile_discs_.write(queue, tiles_.discs().size() * sizeof(Disc), tiles_.discs().data());
    const auto pupil_radius = static_cast<cl_float>(pupil_mm / 2 / plane_width_mm_ * n_);
    draw_.set(plane_.get(), static_cast<cl_int>(n_), tile_begin_.get(), tile_discs_.get(), pupil_radius,
              gratings_.count, gratings_.inner_radius, gratings_.outer_radius, gratings_.duty,
              gratings_.depth);
    const auto tiles = static_cast<std::size_t>(n_ / TileLists::tile_side);
    draw_.launch(queue, tiles, static_cast<std::size_t>(n_), 1, TileLists::tile_side);
}

void ClEyeStage::transform() {
    fft_.forward(device_.queue(), plane_.get());
}

void ClEyeStage::accumulate(double pupil_mm) {
    cl_command_queue queue = device_.queue();
    // Parseval: the sum of |F|^2 over all frequencies is n^2 times the sum of P^2, the area of the open pupil.
    const double radius = pupil_mm / 2 / plane_width_mm_ * n_;
    const double scale = 1 / (static_cast<double>(n_) * n_ * std::numbers::pi * radius * radius);
    sum_rows_.set(plane_.get(), table_.get(), unbox_.get(), static_cast<cl_int>(n_),
                  static_cast<cl_int>(stride_), static_cast<cl_float>(scale));
    sum_rows_.launch(queue, 2 * (static_cast<std::size_t>(n_) / 2 + 1), row_group);
    sum_columns_.set(table_.get(), static_cast<cl_int>(n_), static_cast<cl_int>(stride_));
    sum_columns_.launch(queue, 2 * static_cast<std::size_t>(stride_) / 16, strip_group);
}

int ClEyeStage::update(double pupil_mm, double time_s) {
    if (pupil_mm == table_pupil_mm_ && time_s == table_time_s_) return 0;
    table_pupil_mm_ = -1;  // what follows may throw half way
    draw_aperture(pupil_mm, time_s);
    transform();
    accumulate(pupil_mm);
    table_pupil_mm_ = pupil_mm;
    table_time_s_ = time_s;
    return 3 + fft_.launches();
}

std::size_t ClEyeStage::device_bytes() const {
    return plane_.bytes() + table_.bytes() + unbox_.bytes() + tile_begin_.bytes() + tile_discs_.bytes() +
           fft_.own_bytes();
}

}  // namespace seaglare::glare
