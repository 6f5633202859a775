// The colours of navigation lights as unit-luminance linear sRGB, with their scotopic to photopic ratio.
#pragma once

#include <array>

namespace seaglare::glare {

struct UnitColour {
    std::array<float, 3> rgb{1, 1,
                             1};  // luminance 0.2126 r + 0.7152 g + 0.0722 b = 1; mapped into the sRGB gamut
    float scotopic_per_photopic = 2.464F;  // V/Y of the lamp's spectrum; D65 here
};

// Order as lightdb::Colour and SEAGLARE_COLOUR_*: white, red, green, yellow, blue, orange, violet.
// Sources: physics notes sections 6 and 7 (IALA/COLREG chromaticities; V/Y of Gaussian LED spectra).
UnitColour navigation_colour(int colour);

}  // namespace seaglare::glare
