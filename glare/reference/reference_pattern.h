// The slow truth that the glare pattern is held against: in double precision, every wavelength diffracted on its own in
// 5 nm steps, pixels and discs integrated exactly, no crop, no split into core and skirt. It shares the eye's geometry and
// the CIE's tables with production, and no code that computes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "glare/eye/eye_model.h"
#include "glare/reference/diffraction.h"

namespace seaglare::reference {

// Linear sRGB (signed) and scotopic luminance in units of the lamp's photopic luminance.
using Rgbv = std::array<double, 4>;

// One wavelength's share of a lamp of unit luminance.
struct SpectralLine {
    double wavelength_nm = 575;
    Rgbv rgbv{};
};

// Relative spectral power at a wavelength in nm, sampled at 380, 380 + step ... 780 nm; the step is a multiple of the CIE
// table's 5 nm. Scaled so that the photopic luminance is 1. Throws std::invalid_argument when the lamp has no luminance.
std::vector<SpectralLine> lines_of(const std::function<double(double)>& spectrum, int step_nm = 5);

struct ReferenceRequest {
    glare::EyeModel eye;
    double pupil_mm = 6;
    double time_s = 0;
    std::uint64_t seed = 1;
    double pitch = 1 / 869.1;  // direction cosine per pixel
    int radius = 60;           // (2 radius + 1)^2 pixels
    double angular_scale = 1;  // 1 is physics; the thesis's look is magnified
};

// How one point of light of unit energy and of each lamp's spectrum spreads, in sr^-1, a pixel taken as pitch^2 steradian.
// Rows from -v to +v, columns from -u to +u.
struct ReferencePattern {
    int radius = 0;
    double pitch = 0;
    double transmitted = 1;  // what the aperture passes, all angles together
    Rgbv
        lamp{};  // all of the lamp's light: what a pattern over all angles integrates to, but for `transmitted`
    // As glare::Pattern has it: each channel relative to the lamp's own. A channel of which the lamp has next to nothing,
    // or that cancels in it, follows the luminance.
    std::array<bool, 4> follows_luminance{};
    std::vector<Rgbv> pixels;

    int side() const { return 2 * radius + 1; }
    const Rgbv& at(int a, int b) const {
        return pixels[static_cast<std::size_t>(b + radius) * static_cast<std::size_t>(side()) +
                      static_cast<std::size_t>(a + radius)];
    }
    // A pixel in the units of glare::Pattern.
    Rgbv relative(int a, int b) const;
};

// One pattern per lamp; a wavelength is diffracted once for all of them. `progress`, when set, is called with the fraction
// done. Throws std::invalid_argument for a request out of range.
std::vector<ReferencePattern> make_reference(const ReferenceRequest& request,
                                             const std::vector<std::vector<SpectralLine>>& lamps,
                                             const std::function<void(double)>& progress = {});
ReferencePattern make_reference(const ReferenceRequest& request, const std::vector<SpectralLine>& lamp);

// The area of a disc around (0, 0) inside the rectangle, exactly.
double disc_area_in_rectangle(double radius, double x0, double x1, double y0, double y1);

// Pixels averaged over a disc of a radius in pixels, each with its exact share of the disc's area; zero outside. `side` by
// `side` values.
std::vector<Rgbv> average_over_disc(const std::vector<Rgbv>& pixels, int side, double radius_px);

// CIE 135/1-1999, total glare, in sr^-1; the angle in degrees.
double cie_curve_sr(double angle_deg, double age_years, double pigmentation);

}  // namespace seaglare::reference
