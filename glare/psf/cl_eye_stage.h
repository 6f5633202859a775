// The eye's half of the pattern on the device: aperture, transform, cumulative energy. Depends on the pupil and the time,
// not on any screen, so all channels share it.
#pragma once

#include <optional>
#include <vector>

#include "glare/device/cl_device.h"
#include "glare/psf/cl_aperture.h"
#include "glare/psf/fft.h"
#include "glare/psf/fft_strips.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

class ClEyeStage {
  public:
    // Allocates and compiles; launches nothing. Throws as ClDevice and RealFft2d do.
    ClEyeStage(const ClDevice& device, const EyeModel& eye, const PatternSettings& settings,
               std::uint64_t seed);

    // Fades the table's energy out between two distances from the centre, in samples of the transform: the rest is
    // another table's. Before the first update().
    void fade(float inner, float outer) {
        fade_inner_ = inner;
        fade_outer_ = outer;
    }

    // Brings the table to this instant; does nothing when it is there already. Returns the launches: an eye out of
    // focus takes a second transform.
    int update(const EyeInstant& instant);
    // At this pupil, open and at rest but for drifting particles.
    int update(double pupil_mm, double time_s);
    // The fraction of the light on the open pupil that the instant's aperture passes.
    double transmitted(const EyeInstant& instant) const;

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
    int fft_launches() const { return strip_fft_ ? StripFft2d::launches : fft_->launches(); }
    void draw(double pupil_mm, ClAperture::Part part);
    void sum_rows(double pupil_mm, bool add);
    void sum_columns();

    const ClDevice& device_;
    int n_;
    int stride_;
    ClAperture aperture_;
    // One of the two: the library's for GPUs and large planes.
    std::optional<RealFft2d> fft_;
    std::optional<StripFft2d> strip_fft_;
    ClKernel sum_rows_;
    ClKernel sum_columns_;
    ClBuffer plane_;
    ClBuffer table_;
    ClBuffer unbox_;
    std::optional<EyeInstant> made_for_;
    double drawn_radius_samples_ = 0;  // of the pupil on the plane
    float fade_inner_ = 0;
    float fade_outer_ = 0;  // 0: nothing fades
};

}  // namespace seaglare::glare
