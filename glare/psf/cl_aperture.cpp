#include "glare/psf/cl_aperture.h"

#include <algorithm>

namespace seaglare::glare {

ClAperture::ClAperture(const ClDevice& device, const EyeModel& eye, int n, double plane_width_mm,
                       std::uint64_t seed)
    : device_(device),
      eye_(eye),
      n_(n),
      plane_width_mm_(plane_width_mm),
      parts_(eye, seed),
      veil_(eye, seed),
      in_tiles_(device.is_cpu()),
      draw_(device.program(KernelSet::pattern), in_tiles_ ? "draw_tiles" : "draw_aperture") {
    cl_context context = device.context();
    cl_command_queue queue = device.queue();
    parts_.place(0, n_, plane_width_mm_, discs_);
    const auto tiles = static_cast<std::size_t>(tile_rows());
    const std::size_t begin_bytes = (tiles * tiles + 1) * sizeof(std::int32_t);
    tile_begin_.reserve(context, queue, begin_bytes, "tiles");
    tile_discs_.reserve(context, queue, (TileLists::worst_case(discs_) + 1) * sizeof(Disc), "particles");
    // Lids that are shut before the widest pupil cover most tiles; an eye without any needs no memory for them.
    const bool may_be_veiled = eye.eyelashes.count > 0 || lids_move(eye.lids);
    if (may_be_veiled) {
        quads_.reserve(veil_.capacity());
        counted_.reserve(veil_.capacity());
        const std::size_t entries = veil_.capacity() * 2 + 8 * tiles * tiles;
        veil_begin_.reserve(context, queue, begin_bytes, "tiles of lids");
        veil_quads_.reserve(context, queue, entries * sizeof(Quad), "lids and lashes");
    } else {
        // No buffer argument is empty.
        veil_begin_.reserve(context, queue, sizeof(std::int32_t), "tiles of lids");
        veil_quads_.reserve(context, queue, sizeof(Quad), "lids and lashes");
    }
}

void ClAperture::place(double time_s) {
    EyeInstant instant;
    instant.time_s = time_s;
    place(instant);
}

void ClAperture::place(const EyeInstant& instant) {
    placed_ = instant;
    cl_command_queue queue = device_.queue();
    parts_.place(instant, n_, plane_width_mm_, discs_);
    tiles_.sort(discs_, n_);
    tile_begin_.write(queue, tiles_.begin().size() * sizeof(std::int32_t), tiles_.begin().data());
    tile_discs_.write(queue, tiles_.shapes().size() * sizeof(Disc), tiles_.shapes().data());
    veil_.place(instant, quads_);
    if (quads_.empty()) return;
    to_samples(quads_, n_, plane_width_mm_);
    quad_tiles_.sort(quads_, n_);
    cl_context context = device_.context();
    const std::size_t begin_bytes = quad_tiles_.begin().size() * sizeof(std::int32_t);
    const std::size_t bytes = std::max<std::size_t>(quad_tiles_.shapes().size(), 1) * sizeof(Quad);
    veil_begin_.reserve(context, queue, begin_bytes, "tiles of lids");
    veil_quads_.reserve(context, queue, bytes, "lids and lashes");
    veil_begin_.write(queue, begin_bytes, quad_tiles_.begin().data());
    if (!quad_tiles_.shapes().empty())
        veil_quads_.write(queue, quad_tiles_.shapes().size() * sizeof(Quad), quad_tiles_.shapes().data());
}

void ClAperture::draw(double pupil_mm, cl_mem target, int first_tile_row, int tile_row_count, Part part) {
    const GratingShape gratings = parts_.gratings(n_, plane_width_mm_, placed_.lens_scale);
    const auto defocus = static_cast<cl_float>(defocus_phase(placed_.defocus_dioptre, n_, plane_width_mm_));
    draw_.set(target, static_cast<cl_int>(n_), static_cast<cl_int>(first_tile_row), tile_begin_.get(),
              tile_discs_.get(), static_cast<cl_float>(pupil_radius_samples(pupil_mm)), gratings.count,
              gratings.inner_radius, gratings.outer_radius, gratings.duty, gratings.depth,
              static_cast<cl_int>(!quads_.empty()), veil_begin_.get(), veil_quads_.get(), defocus,
              static_cast<cl_int>(part == Part::imaginary));
    const auto side = static_cast<std::size_t>(TileLists::tile_side);
    const auto across = static_cast<std::size_t>(tile_rows());
    const auto down = static_cast<std::size_t>(tile_row_count);
    if (in_tiles_)
        draw_.launch(device_.queue(), across, down, 1, 1);
    else
        draw_.launch(device_.queue(), across, down * side, 1, side);
}

double ClAperture::transmitted(const EyeInstant& instant) const {
    veil_.place(instant, counted_);
    return transmitted_fraction(eye_, instant, counted_);
}

std::size_t ClAperture::device_bytes() const {
    return tile_begin_.bytes() + tile_discs_.bytes() + veil_begin_.bytes() + veil_quads_.bytes();
}

}  // namespace seaglare::glare
