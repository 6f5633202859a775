// The colours of navigation lights as unit-luminance linear sRGB, with their scotopic to photopic ratio.
#pragma once

#include <array>
#include <vector>

#include "glare/colour/spectrum.h"

namespace seaglare::glare {

struct UnitColour {
    // Luminance 0.2126 r + 0.7152 g + 0.0722 b = 1. Of a navigation colour mapped into the sRGB gamut; of a spectrum of its
    // own (lamp_spectrum.h) signed.
    std::array<float, 3> rgb{1, 1, 1};
    float scotopic_per_photopic = 2.464F;  // V/Y of the lamp's spectrum; D65 here
};

inline constexpr int lamp_count = 7;
// Lamps that can have a glare pattern of their own: those of the navigation colours, then named spectra (lamp_list.h). As
// many as a mask of 32 bits tells apart.
inline constexpr int most_lamps = 32;

// Order as lightdb::Colour and SEAGLARE_COLOUR_*: white, red, green, yellow, blue, orange, violet.
// Sources: physics notes sections 6 and 7 (IALA/COLREG chromaticities; V/Y of Gaussian LED spectra).
UnitColour navigation_colour(int colour);

// The spectrum that a lamp of this colour has: D65 for white, the Gaussian of an LED for the others (violet: a red and a
// blue one). Decides the shape of its glare pattern, not its colour.
Spectrum navigation_spectrum(int colour);

// The wavelengths of each lamp's pattern; none for a lamp that does not exist.
using LampSamples = std::array<std::vector<SpectralSample>, most_lamps>;
// Of the navigation colours.
LampSamples sample_lamps(int count);

}  // namespace seaglare::glare
