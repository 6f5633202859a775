#include "glare/psf/wavelength_steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "glare/colour/cie_tables.h"

namespace seaglare::glare {

namespace {

constexpr double brightest_nm = 555;
constexpr int most_parts = 16;
constexpr std::size_t colour_bands = 30;

// The band of a sample; those that a spectrum has nothing in are left out of the list, and leave a wider gap.
double band_nm(const std::vector<SpectralSample>& samples) {
    double least = 0;
    for (std::size_t k = 1; k < samples.size(); ++k) {
        const double step = std::abs(samples[k].wavelength_nm - samples[k - 1].wavelength_nm);
        least = k == 1 ? step : std::min(least, step);
    }
    return least;
}

double photopic(const SpectralSample& sample) {
    return 0.2126 * sample.weight[0] + 0.7152 * sample.weight[1] + 0.0722 * sample.weight[2];
}

int colour_band(double wavelength_nm) {
    constexpr double first = cie_first_wavelength_nm;
    constexpr double width = (cie_last_wavelength_nm - first) / static_cast<double>(colour_bands);
    return static_cast<int>(std::floor((wavelength_nm - first) / width));
}

}  // namespace

int wavelength_parts(const std::vector<SpectralSample>& samples, double radius_nodes, double step_nodes) {
    if (!(step_nodes > 0)) return 1;
    const double apart = 0.5 * radius_nodes * band_nm(samples) / brightest_nm;
    return static_cast<int>(std::clamp(std::ceil(apart / step_nodes), 1.0, static_cast<double>(most_parts)));
}

std::vector<SpectralSample> divided(const std::vector<SpectralSample>& samples, int parts) {
    const double band = band_nm(samples);
    std::vector<SpectralSample> finer;
    finer.reserve(samples.size() * static_cast<std::size_t>(parts));
    for (const SpectralSample& sample : samples) {
        for (int part = 0; part < parts; ++part) {
            SpectralSample share = sample;
            share.wavelength_nm += band * ((part + 0.5) / parts - 0.5);
            for (double& weight : share.weight)
                weight /= parts;
            finer.push_back(share);
        }
    }
    return finer;
}

std::vector<SpectralSample> shared_colours(std::vector<SpectralSample> samples) {
    if (samples.size() < 2 * colour_bands) return samples;
    const double band = band_nm(samples);
    for (std::size_t first = 0; first < samples.size();) {
        std::size_t end = first + 1;
        while (end < samples.size() &&
               colour_band(samples[end].wavelength_nm) == colour_band(samples[first].wavelength_nm))
            ++end;
        // The luminance of the band stays where it was on the mean: its samples move by a part of their step.
        double luminance = 0;
        double moment = 0;
        double mean_nm = 0;
        for (std::size_t k = first; k < end; ++k) {
            luminance += photopic(samples[k]);
            moment += photopic(samples[k]) * samples[k].wavelength_nm;
            mean_nm += samples[k].wavelength_nm / static_cast<double>(end - first);
        }
        const double half_step = 0.5 * band;
        const double shift =
            luminance > 0 ? std::clamp(moment / luminance - mean_nm, -half_step, half_step) : 0;
        for (std::size_t k = first; k < end; ++k)
            samples[k].wavelength_nm += shift;
        for (std::size_t channel = 0; channel < 4; ++channel) {
            double sum = 0;
            for (std::size_t k = first; k < end; ++k)
                sum += samples[k].weight[channel];
            for (std::size_t k = first; k < end; ++k)
                samples[k].weight[channel] = sum / static_cast<double>(end - first);
        }
        first = end;
    }
    return samples;
}

}  // namespace seaglare::glare
