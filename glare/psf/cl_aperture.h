// Draws the pupil plane on the device, whole or a few rows of tiles at a time, so that a large plane need not exist at
// once nor be drawn in one launch.
#pragma once

#include <vector>

#include "glare/device/cl_device.h"
#include "glare/eye/aperture.h"
#include "glare/eye/eye_instant.h"
#include "glare/eye/veil.h"

namespace seaglare::glare {

class ClAperture {
  public:
    // An eye out of focus has a complex amplitude.
    enum class Part { real, imaginary };

    // n x n samples of a plane of this width. Allocates and compiles; launches nothing. Throws as ClDevice does.
    ClAperture(const ClDevice& device, const EyeModel& eye, int n, double plane_width_mm, std::uint64_t seed);

    // What moves, brought to this instant, for the draw() calls that follow.
    void place(const EyeInstant& instant);
    // Open and at rest but for drifting particles.
    void place(double time_s);

    // Draws the rows of tiles first ... first + count - 1 to the beginning of `target`: rows of n + 2 reals. One launch.
    void draw(double pupil_mm, cl_mem target, int first_tile_row, int tile_row_count, Part part = Part::real);

    // The fraction of the light on the open pupil that the instant's aperture passes.
    double transmitted(const EyeInstant& instant) const;

    int n() const { return n_; }
    int tile_rows() const { return n_ / TileLists::tile_side; }
    double pupil_radius_samples(double pupil_mm) const { return pupil_mm / 2 / plane_width_mm_ * n_; }
    std::size_t device_bytes() const;

  private:
    const ClDevice& device_;
    EyeModel eye_;
    int n_;
    double plane_width_mm_;
    ApertureParts parts_;
    Veil veil_;
    std::vector<Disc> discs_;
    std::vector<Quad> quads_;
    mutable std::vector<Quad> counted_;  // transmitted()'s own: no allocation in a steady frame
    TileLists tiles_;
    QuadTileLists quad_tiles_;
    EyeInstant placed_;
    bool in_tiles_;  // which of the two kernels of aperture.cl
    ClKernel draw_;
    ClBuffer tile_begin_;
    ClBuffer tile_discs_;
    ClBuffer veil_begin_;
    ClBuffer veil_quads_;
};

}  // namespace seaglare::glare
