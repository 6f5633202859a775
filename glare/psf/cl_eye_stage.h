// The eye's half of the pattern on the device: aperture, transform, cumulative energy. Depends on the pupil and the time,
// not on any screen, so all channels share it.
#pragma once

#include <vector>

#include "glare/device/cl_device.h"
#include "glare/eye/aperture.h"
#include "glare/psf/fft.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

class ClEyeStage {
  public:
    // Allocates and compiles; launches nothing. Throws as ClDevice and RealFft2d do.
    ClEyeStage(const ClDevice& device, const EyeModel& eye, const PatternSettings& settings,
               std::uint64_t seed);

    // Brings the table to this pupil and instant; does nothing when it is there already. Returns the launches.
    int update(double pupil_mm, double time_s);

    // The steps of update(), for those who measure them.
    void draw_aperture(double pupil_mm, double time_s);
    void transform();
    void accumulate(double pupil_mm);

    int n() const { return n_; }
    // Floats in a row of the table; two quadrants of n/2 + 2 rows each (shaders/energy_table.cl).
    int stride() const { return stride_; }
    cl_mem table() const { return table_.get(); }
    // Rows of n + 2 reals before transform(), n/2 + 1 complex numbers after.
    cl_mem plane() const { return plane_.get(); }
    std::size_t device_bytes() const;

  private:
    const ClDevice& device_;
    int n_;
    int stride_;
    double plane_width_mm_;
    ApertureParts parts_;
    GratingShape gratings_;
    std::vector<Disc> discs_;
    TileLists tiles_;
    RealFft2d fft_;
    ClOwned<cl_program> aperture_program_;
    ClOwned<cl_program> table_program_;
    ClKernel draw_;
    ClKernel sum_rows_;
    ClKernel sum_columns_;
    ClBuffer plane_;
    ClBuffer table_;
    ClBuffer unbox_;
    ClBuffer tile_begin_;
    ClBuffer tile_discs_;
    double table_pupil_mm_ = -1;
    double table_time_s_ = 0;
};

}  // namespace seaglare::glare
