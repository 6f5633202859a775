// How far what is drawn around a point is from what should be there, in the terms of a picture: means and contrasts of rings,
// and display codes. The core, which is drawn apart, is in neither.
#pragma once

#include <span>
#include <vector>

namespace seaglare::reference {

// Luminance over the light's illuminance, sr^-1, on (2 radius + 1)^2 pixels, rows from -v to +v, `pitch` of direction cosine
// apart.
struct LuminanceField {
    int radius = 0;
    double pitch = 0;
    std::vector<double> per_sr;
};

// Over the pixels within six per cent of an angle, each weighted with the square of its own, so that the fall over the ring
// is no contrast. NaN for a ring without a pixel.
struct RingStatistics {
    double mean = 0;
    double contrast = 0;  // standard deviation over mean
};
RingStatistics ring_statistics(const LuminanceField& field, double angle_deg);

struct FieldLoss {
    double radial = 0;    // of the mean over a ring, the worst of 0.25 to 3.6 degrees
    double contrast = 0;  // the largest change of the contrast, less one, of the rings asked for
    double codes = 0;     // the largest difference in 8-bit codes: 10 000 cd at 1 km by starlight
};
// Within the circle of the field's radius. Fields of different sizes give NaN.
FieldLoss field_loss(const LuminanceField& made, const LuminanceField& truth,
                     std::span<const double> contrast_angles_deg);

}  // namespace seaglare::reference
