#include "glare/colour/navigation_colours.h"

#include <cstddef>

#include "glare/colour/chromaticity.h"
#include "glare/colour/spectrum.h"

namespace seaglare::glare {

namespace {

// What a lamp looks like on an sRGB display, and the LED whose rods' response it has. The regions of COLREG Annex I
// (green, yellow) and IALA E-200-1 hold real lamps outside sRGB: red and blue are its primaries, the nearest to them.
struct Lamp {
    Chromaticity xy;
    double peak_nm;  // of a single-colour LED; 0: white
    double sigma_nm;
};

constexpr std::array<Lamp, lamp_count> lamps = {{
    {srgb_white, 0, 0},       // white
    {{0.64, 0.33}, 625, 8},   // red
    {{0.28, 0.52}, 525, 15},  // green
    {{0.54, 0.41}, 592, 8},   // yellow
    {{0.15, 0.06}, 465, 10},  // blue
    {{0.60, 0.38}, 605, 8},   // orange
    {{0.25, 0.12}, 0, 0},     // violet: no LED is; a red and a blue one together
}};

constexpr std::size_t violet = 6;

double scotopic(const Lamp& lamp) {
    return scotopic_per_photopic([&lamp](double l) { return gaussian(l, lamp.peak_nm, lamp.sigma_nm); });
}

UnitColour make_colour(std::size_t index) {
    const Lamp& lamp = lamps[index];
    UnitColour colour;
    const auto rgb = unit_luminance_in_gamut(srgb_from_xyz(xyz_from_chromaticity(lamp.xy, 1)));
    for (std::size_t c = 0; c < 3; ++c)
        colour.rgb[c] = static_cast<float>(rgb[c]);
    if (index == violet) {
        const double blue_luminance = luminance({0, 0, rgb[2]});
        colour.scotopic_per_photopic = static_cast<float>(blue_luminance * scotopic(lamps[4]) +
                                                          (1 - blue_luminance) * scotopic(lamps[1]));
    } else {
        colour.scotopic_per_photopic =
            static_cast<float>(lamp.peak_nm > 0 ? scotopic(lamp) : scotopic_per_photopic(d65));
    }
    if (index == 0) colour.rgb = {1, 1, 1};
    return colour;
}

}  // namespace

UnitColour navigation_colour(int colour) {
    const bool known = colour >= 0 && static_cast<std::size_t>(colour) < lamps.size();
    return make_colour(known ? static_cast<std::size_t>(colour) : 0);
}

Spectrum navigation_spectrum(int colour) {
    const bool known = colour > 0 && static_cast<std::size_t>(colour) < lamps.size();
    if (!known) return d65;
    if (static_cast<std::size_t>(colour) == violet) {
        return [](double l) {
            return gaussian(l, lamps[1].peak_nm, lamps[1].sigma_nm) +
                   gaussian(l, lamps[4].peak_nm, lamps[4].sigma_nm);
        };
    }
    const Lamp& lamp = lamps[static_cast<std::size_t>(colour)];
    return [&lamp](double l) { return gaussian(l, lamp.peak_nm, lamp.sigma_nm); };
}

LampSamples sample_lamps(int count) {
    LampSamples samples;
    for (int lamp = 0; lamp < lamp_count; ++lamp)
        samples[static_cast<std::size_t>(lamp)] = sample_spectrum(navigation_spectrum(lamp), count);
    return samples;
}

}  // namespace seaglare::glare
