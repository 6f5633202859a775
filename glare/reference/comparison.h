// How far a glare pattern is from the reference.
#pragma once

#include "glare/psf/pattern.h"
#include "glare/reference/reference_pattern.h"

namespace seaglare::reference {

struct Zone {
    double inner_deg = 0;
    double outer_deg = 0;
};
inline constexpr Zone core_zone{0, 0.15};
inline constexpr Zone ring_zone{2.2, 3.9};

// All errors are of the pattern as drawn against the reference with the same split, window and energy. Errors of an
// area that the pattern does not reach are NaN.
struct PatternError {
    double relative_l1 = 0;  // sum |difference| over sum |reference|, all channels, core included
    double skirt_l1 = 0;     // the same without the core
    double total_l1 =
        0;  // core + skirt + tail over the whole reference as it is, no energy adjusted; of the point layer
    double worst_of_peak = 0;  // the largest difference of any pixel over the largest value
    double worst_relative =
        0;  // the largest difference over (the pixel's own value + a tenth of its ring's mean)
    double core_delta_e = 0;  // CIELAB 1976 of the zone's summed light, its reference luminance as 100
    double ring_delta_e = 0;
    double core_energy = 0;      // of the pattern less that of the reference, of channel 1
    double structure_scale = 0;  // the reference's simulated energy had to be multiplied by this
};

// The reference in the pattern's form: the point layer's skirt (all but the core) times pitch^2, and the core's energy.
struct SplitReference {
    std::vector<Rgbv> skirt;  // on the reference's own pixels
    Rgbv core{};
    double structure_scale = 1;
    double tail_scale = 0;
};
SplitReference split(const ReferencePattern& reference, const glare::EyeModel& eye,
                     const glare::Pattern& pattern, double core_radius_nodes);

// `slot` is the lamp's place in pattern.lamps, `layer` one of its disc layers. The two must have the same pitch, and the
// reference at least the pattern's structure.
PatternError compare(const ReferencePattern& reference, const glare::EyeModel& eye,
                     const glare::Pattern& pattern, double core_radius_nodes, std::size_t slot = 0,
                     std::size_t layer = 0);

// The error of a disc whose radius is between layers, mixed as the product draws it (linear in the square of the radius):
// sum |difference| over sum |reference|, skirt only.
double disc_error(const ReferencePattern& reference, const glare::EyeModel& eye,
                  const glare::Pattern& pattern, double core_radius_nodes, double radius_nodes);

// The energy of the tail beyond the fade, by the midpoint rule over the angle.
double tail_energy(double age_years, double pigmentation, double window_inner, double window_outer);

}  // namespace seaglare::reference
