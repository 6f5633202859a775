// The lamps and coloured glasses that a file can name.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "glare/colour/spectrum.h"

namespace seaglare::glare {

// d65        CIE standard illuminant D65, daylight
// a          CIE standard illuminant A, an incandescent lamp (CIE 015: Planck at 2848 K with c2 = 14350 um K)
// e          the same power at every wavelength
// tungsten   Planck at 2856 K
// led_white  the white LED of the 2012 thesis: thesis_white_led()
// led_white_poor  three narrow lobes: poor_white_led()
// led_red, led_green, led_yellow, led_blue, led_orange   the Gaussians of navigation_spectrum()
// planck:T   Planck at T kelvin, coldest_planck_k to hottest_planck_k; not in the list of names
std::span<const std::string_view> spectrum_names();
inline constexpr double coldest_planck_k = 1000;
inline constexpr double hottest_planck_k = 25000;
inline constexpr std::string_view planck_prefix = "planck:";

// Nothing: no such name, or a temperature outside its limits.
std::optional<Spectrum> named_spectrum(std::string_view name);
// "planck:2856", which named_spectrum() takes back to the last bit.
std::string planck_name(double temperature_k);

// Transmittance over wavelength of the coloured glass before a lamp: red, green, yellow, blue, orange. They are no maker's
// glasses but smooth cut-ons and bands, placed so that illuminant A behind red, green and yellow lies in the regions of
// COLREG 1972 Annex I section 7.
std::span<const std::string_view> filter_names();
std::optional<Spectrum> named_filter(std::string_view name);
// The glass of a navigation colour (navigation_colours.h); nothing for white, which has none, and for violet.
std::optional<std::string_view> filter_of_colour(int colour);

// A white LED of poor quality: three Gaussian lobes, as the 2012 thesis describes that of its figure 6.5, "centered
// around the peak HVS sensitivity". Which peaks, how narrow and how high it does not say. Here: the peaks of the CIE 1931
// colour matching functions (446, 555 and 599 nm), sigma 10 nm as the thesis's blue pump, and those heights that make it as
// white as D65.
double poor_white_led(double wavelength_nm);

}  // namespace seaglare::glare
