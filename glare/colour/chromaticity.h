// Colours as numbers: CIE XYZ, chromaticity xy and linear sRGB. Pure functions.
// Source of the primaries and the white: IEC 61966-2-1 (sRGB).
#pragma once

#include <array>

namespace seaglare::glare {

struct Xyz {
    double x = 0;
    double y = 0;
    double z = 0;
};

struct Chromaticity {
    double x = 0;
    double y = 0;
};

inline constexpr Chromaticity srgb_white{0.3127, 0.3290};
// The luminance of linear sRGB: 0.2126 r + 0.7152 g + 0.0722 b.
double luminance(const std::array<double, 3>& linear_rgb);

// Linear sRGB from XYZ, signed: a colour outside the gamut has a negative component.
std::array<double, 3> srgb_from_xyz(const Xyz& xyz);
Xyz xyz_from_srgb(const std::array<double, 3>& linear_rgb);

// The chromaticity of a colour; that of the sRGB white for black, and for anything without a positive sum.
Chromaticity chromaticity_of(const Xyz& xyz);
// XYZ of a chromaticity and a luminance; black when y is not positive.
Xyz xyz_from_chromaticity(const Chromaticity& xy, double luminance_y);

// The colour of unit luminance nearest to `linear_rgb` on the line to white that has no negative component. White for
// a colour without positive luminance.
std::array<double, 3> unit_luminance_in_gamut(const std::array<double, 3>& linear_rgb);

}  // namespace seaglare::glare
