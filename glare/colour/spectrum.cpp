#include "glare/colour/spectrum.h"

#include <algorithm>
#include <cmath>

#include "glare/colour/cie_tables.h"

namespace seaglare::glare {

namespace {

constexpr double photopic_lm_per_w = 683;
constexpr double scotopic_lm_per_w = 1700;
constexpr double second_radiation_constant_nm_k = 1.438776877e7;  // CODATA 2018
// The 2848 K at which CIE 015 defines illuminant A, moved from c2 = 14350 um K to today's.
constexpr double illuminant_a_k = 2848 * 1.438776877e7 / 1.435e7;

template <typename Member>
double interpolated(double wavelength_nm, Member member) {
    if (!(wavelength_nm >= cie_first_wavelength_nm && wavelength_nm <= cie_last_wavelength_nm)) return 0;
    const double position = (wavelength_nm - cie_first_wavelength_nm) / cie_step_wavelength_nm;
    const auto below = static_cast<std::size_t>(std::min(std::floor(position), cie_samples - 2.0));
    const double t = position - static_cast<double>(below);
    return (1 - t) * (cie_table[below].*member) + t * (cie_table[below + 1].*member);
}

}  // namespace

Xyz colour_matching(double wavelength_nm) {
    return {interpolated(wavelength_nm, &CieSample::x_bar), interpolated(wavelength_nm, &CieSample::y_bar),
            interpolated(wavelength_nm, &CieSample::z_bar)};
}

double scotopic_efficiency(double wavelength_nm) {
    return interpolated(wavelength_nm, &CieSample::v_prime);
}

double d65(double wavelength_nm) {
    return interpolated(wavelength_nm, &CieSample::d65);
}

double planck(double wavelength_nm, double temperature_k) {
    const auto relative = [temperature_k](double l) {
        return 1 / (std::pow(l, 5) * std::expm1(second_radiation_constant_nm_k / (l * temperature_k)));
    };
    return relative(wavelength_nm) / relative(560);
}

double illuminant_a(double wavelength_nm) {
    return planck(wavelength_nm, illuminant_a_k);
}

double gaussian(double wavelength_nm, double peak_nm, double sigma_nm) {
    const double t = (wavelength_nm - peak_nm) / sigma_nm;
    return std::exp(-t * t / 2);
}

double thesis_white_led(double wavelength_nm) {
    return 0.5 * gaussian(wavelength_nm, 560, 60) + 0.9 * gaussian(wavelength_nm, 450, 10);
}

Xyz unit_luminance_xyz(const Spectrum& spectrum) {
    Xyz sum;
    for (int l = cie_first_wavelength_nm; l <= cie_last_wavelength_nm; ++l) {
        const Xyz cmf = colour_matching(l);
        const double power = spectrum(l);
        sum.x += power * cmf.x;
        sum.y += power * cmf.y;
        sum.z += power * cmf.z;
    }
    if (!(sum.y > 0)) return {};
    return {sum.x / sum.y, 1, sum.z / sum.y};
}

double scotopic_per_photopic(const Spectrum& spectrum) {
    double scotopic = 0;
    double photopic = 0;
    for (int l = cie_first_wavelength_nm; l <= cie_last_wavelength_nm; ++l) {
        scotopic += spectrum(l) * scotopic_efficiency(l);
        photopic += spectrum(l) * colour_matching(l).y;
    }
    return photopic > 0 ? scotopic_lm_per_w * scotopic / (photopic_lm_per_w * photopic) : 0;
}

std::vector<SpectralSample> sample_spectrum(const Spectrum& spectrum, int count) {
    const auto bands = static_cast<std::size_t>(std::max(count, 1));
    const double width =
        static_cast<double>(cie_last_wavelength_nm - cie_first_wavelength_nm) / static_cast<double>(bands);
    const int steps = std::max(1, static_cast<int>(std::ceil(width / 0.25)));
    std::vector<SpectralSample> samples(bands);
    std::vector<double> photopic(bands);
    std::array<double, 4> total{};
    double total_photopic = 0;
    for (std::size_t band = 0; band < bands; ++band) {
        SpectralSample& sample = samples[band];
        const double begin = cie_first_wavelength_nm + width * static_cast<double>(band);
        sample.wavelength_nm = begin + width / 2;
        for (int s = 0; s < steps; ++s) {
            const double wavelength_nm = begin + width * (s + 0.5) / steps;
            const double power = spectrum(wavelength_nm);
            const Xyz cmf = colour_matching(wavelength_nm);
            const auto rgb = srgb_from_xyz({cmf.x * power, cmf.y * power, cmf.z * power});
            for (std::size_t c = 0; c < 3; ++c)
                sample.weight[c] += rgb[c];
            sample.weight[3] += power * scotopic_efficiency(wavelength_nm);
            photopic[band] += power * cmf.y;
        }
        for (std::size_t c = 0; c < 4; ++c)
            total[c] += sample.weight[c];
        total_photopic += photopic[band];
    }
    // A channel whose sum is small beside what cancels in it would be all noise, of either sign.
    std::array<bool, 4> shapeless{};
    for (std::size_t c = 0; c < 4; ++c) {
        double magnitude = 0;
        for (const SpectralSample& sample : samples)
            magnitude += std::abs(sample.weight[c]);
        shapeless[c] = !(std::abs(total[c]) > 0.5 * magnitude) || std::abs(total[c]) < 0.02 * total_photopic;
    }
    for (std::size_t band = 0; band < bands; ++band)
        for (std::size_t c = 0; c < 4; ++c) {
            double& weight = samples[band].weight[c];
            weight = shapeless[c] ? photopic[band] / total_photopic : weight / total[c];
        }
    std::erase_if(samples, [](const SpectralSample& sample) {
        return std::all_of(sample.weight.begin(), sample.weight.end(),
                           [](double w) { return std::abs(w) < 1e-6; });
    });
    return samples;
}

std::vector<SpectralSample> sample_d65(int count) {
    return sample_spectrum(d65, count);
}

}  // namespace seaglare::glare
