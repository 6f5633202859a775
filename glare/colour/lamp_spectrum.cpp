#include "glare/colour/lamp_spectrum.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

// The integral of a table that is linear between its samples, from the first one on.
class Integral {
  public:
    Integral(std::span<const double> wavelength_nm, std::span<const double> power)
        : wavelength_nm_(wavelength_nm), power_(power) {}

    // Wavelengths must ascend from call to call.
    double upto(double wavelength_nm) {
        while (next_ < wavelength_nm_.size() && wavelength_nm_[next_] <= wavelength_nm) {
            if (next_ > 0) whole_ += area(wavelength_nm_[next_]);
            ++next_;
        }
        if (next_ == 0 || next_ == wavelength_nm_.size()) return whole_;
        return whole_ + area(wavelength_nm);
    }

  private:
    // From the sample before the next one.
    double area(double wavelength_nm) const {
        const double span = wavelength_nm_[next_] - wavelength_nm_[next_ - 1];
        const double t = (wavelength_nm - wavelength_nm_[next_ - 1]) / span;
        const double rise = power_[next_] - power_[next_ - 1];
        return span * t * (power_[next_ - 1] + rise * t / 2);
    }

    std::span<const double> wavelength_nm_;
    std::span<const double> power_;
    std::size_t next_ = 0;
    double whole_ = 0;
};

double wavelength_of(std::size_t sample) {
    return cie_first_wavelength_nm + static_cast<double>(sample);
}

}  // namespace

std::optional<LampSpectrum> LampSpectrum::from(const Spectrum& spectrum) {
    LampSpectrum lamp;
    for (std::size_t i = 0; i < lamp.power_.size(); ++i)
        lamp.power_[i] = spectrum(wavelength_of(i));
    if (!lamp.normalise()) return std::nullopt;
    return lamp;
}

std::optional<LampSpectrum> LampSpectrum::from(std::span<const double> wavelength_nm,
                                               std::span<const double> power) {
    if (wavelength_nm.empty() || wavelength_nm.size() != power.size()) return std::nullopt;
    LampSpectrum lamp;
    Integral integral(wavelength_nm, power);
    double before = integral.upto(cie_first_wavelength_nm - 0.5);
    for (std::size_t i = 0; i < lamp.power_.size(); ++i) {
        const double here = integral.upto(wavelength_of(i) + 0.5);
        const double covered = std::min(wavelength_of(i) + 0.5, wavelength_nm.back()) -
                               std::max(wavelength_of(i) - 0.5, wavelength_nm.front());
        lamp.power_[i] = covered > 0 ? std::max(0.0, here - before) / covered : 0;
        before = here;
    }
    if (!lamp.normalise()) return std::nullopt;
    return lamp;
}

bool LampSpectrum::normalise() {
    double largest = 0;
    for (const double power : power_) {
        if (!(power >= 0) || !std::isfinite(power)) return false;
        largest = std::max(largest, power);
    }
    if (!(largest > 0)) return false;
    // First by the largest: the sum over powers near the limits of a double would be beyond them.
    double luminous = 0;
    for (std::size_t i = 0; i < power_.size(); ++i) {
        power_[i] /= largest;
        luminous += power_[i] * colour_matching(wavelength_of(i)).y;
    }
    // Less than this is the tail of an infrared or ultraviolet source: its colour would be noise.
    constexpr double least_luminous = 1e-4;
    if (!(luminous > least_luminous)) return false;
    double flux = 0;
    for (std::size_t i = 0; i < power_.size(); ++i) {
        power_[i] /= luminous;
        flux += power_[i] * colour_matching(wavelength_of(i)).y;
        flux_up_to_[i] = flux;
    }
    const Spectrum spectrum = [this](double l) { return power(l); };
    const auto rgb = srgb_from_xyz(unit_luminance_xyz(spectrum));
    for (std::size_t c = 0; c < 3; ++c)
        colour_.rgb[c] = static_cast<float>(rgb[c]);
    colour_.scotopic_per_photopic = static_cast<float>(glare::scotopic_per_photopic(spectrum));
    return true;
}

double LampSpectrum::power(double wavelength_nm) const {
    if (!(wavelength_nm >= cie_first_wavelength_nm && wavelength_nm <= cie_last_wavelength_nm)) return 0;
    const double position = wavelength_nm - cie_first_wavelength_nm;
    const auto below = static_cast<std::size_t>(std::min(std::floor(position), samples - 2.0));
    const double t = position - static_cast<double>(below);
    return (1 - t) * power_[below] + t * power_[below + 1];
}

double spectral_distance_nm(const LampSpectrum& a, const LampSpectrum& b) {
    double distance = 0;
    for (std::size_t i = 0; i < LampSpectrum::samples; ++i)
        distance += std::abs(a.flux_up_to()[i] - b.flux_up_to()[i]);
    return distance;
}

const LampSpectrum& navigation_lamp_spectrum(int colour) {
    static const auto all = [] {
        std::array<std::optional<LampSpectrum>, lamp_count> made;
        for (int c = 0; c < lamp_count; ++c)
            made[static_cast<std::size_t>(c)] = LampSpectrum::from(navigation_spectrum(c));
        return made;
    }();
    const bool known = colour >= 0 && colour < lamp_count;
    return *all[known ? static_cast<std::size_t>(colour) : 0];
}

}  // namespace seaglare::glare
