// Spectra of lamps and what the two observers make of them. A spectrum is a relative spectral power over wavelength in
// nanometres; its scale never matters, because every colour is given at unit luminance.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "glare/colour/chromaticity.h"

namespace seaglare::glare {

// Relative spectral power at a wavelength in nm.
using Spectrum = std::function<double(double wavelength_nm)>;

// Linear between the CIE table's 5 nm steps; zero outside 380 ... 780 nm.
Xyz colour_matching(double wavelength_nm);
double scotopic_efficiency(double wavelength_nm);

double d65(double wavelength_nm);
// Planck's law, 1 at 560 nm. CIE illuminant A is 2848 K with c2 = 14350 um K, that is 2855.5 K with today's c2.
double planck(double wavelength_nm, double temperature_k);
double illuminant_a(double wavelength_nm);
double gaussian(double wavelength_nm, double peak_nm, double sigma_nm);
// The white LED of the 2012 thesis: a phosphor's hump under a blue pump.
double thesis_white_led(double wavelength_nm);

// Integrals over 380 ... 780 nm in steps of 1 nm, scaled to luminance Y = 1. Black when the spectrum has none.
Xyz unit_luminance_xyz(const Spectrum& spectrum);
// Scotopic to photopic luminance, V/Y, with K'm = 1700 and Km = 683 lm/W. D65 has 2.464; the formula V = Y (1.33 (1 + (Y+Z)/X) - 1.68) of
// Larson et al. 1997 would say 2.573.
double scotopic_per_photopic(const Spectrum& spectrum);

// One of the wavelengths that stand for a spectrum in the glare pattern, and its share of the lamp's linear sRGB and
// scotopic signal. Over all samples each of the four sums to 1: a lamp's pattern says how its light is spread, channel by
// channel, and not what colour it is.
struct SpectralSample {
    double wavelength_nm = 575;
    std::array<double, 4> weight{};
};

// Divides 380 ... 780 nm into `count` equal bands; each stands at its middle with the integral of its band, so that the
// sum is the spectrum's own however few there are. A channel to which the spectrum gives next to nothing, or gives as
// much as it takes, such as blue in a red lamp, has no shape of its own and follows the luminance. Bands without power
// are left out. Count is at least 1; the spectrum must have power where the eye sees.
std::vector<SpectralSample> sample_spectrum(const Spectrum& spectrum, int count);
std::vector<SpectralSample> sample_d65(int count);

}  // namespace seaglare::glare
