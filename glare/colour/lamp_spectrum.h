// The spectrum of a lamp as the database and the glare pattern share it: a table at 1 nm, its colour, and how far apart
// two of them are.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "glare/colour/cie_tables.h"
#include "glare/colour/navigation_colours.h"
#include "glare/colour/spectrum.h"

namespace seaglare::glare {

class LampSpectrum {
  public:
    static constexpr int samples = cie_last_wavelength_nm - cie_first_wavelength_nm + 1;

    // The spectrum at every nanometre from 380 to 780. Nothing when it has no power that the eye sees, or a power that is
    // negative or not finite.
    static std::optional<LampSpectrum> from(const Spectrum& spectrum);
    // From measured samples: wavelengths ascend, as many powers, none negative. Linear between them and 0 outside; each
    // nanometre gets the mean over the nanometre around it, as far as the table covers it, so that lines in a table finer
    // than that are not missed.
    static std::optional<LampSpectrum> from(std::span<const double> wavelength_nm,
                                            std::span<const double> power);

    // Relative power: linear between the nanometres, 0 outside. The sum of power times V(lambda) over them is 1.
    double power(double wavelength_nm) const;
    const std::array<double, samples>& powers() const { return power_; }
    // The share of the luminous flux up to and including each nanometre; the last is 1.
    const std::array<double, samples>& flux_up_to() const { return flux_up_to_; }
    // Luminance 1; signed where sRGB has no such colour.
    const UnitColour& colour() const { return colour_; }

    friend bool operator==(const LampSpectrum& a, const LampSpectrum& b) { return a.power_ == b.power_; }

  private:
    LampSpectrum() = default;
    bool normalise();

    std::array<double, samples> power_{};
    std::array<double, samples> flux_up_to_{};
    UnitColour colour_;
};

// How far luminous flux must be moved along the wavelengths to turn one spectrum into the other, in nm per unit of flux
// (the earth mover's distance). A glare pattern is scaled with the wavelength, so this orders patterns by likeness.
double spectral_distance_nm(const LampSpectrum& a, const LampSpectrum& b);

// Of a navigation lamp; made once.
const LampSpectrum& navigation_lamp_spectrum(int colour);

}  // namespace seaglare::glare
