// What the tests of the OpenCL pattern share: a source or the reason why there is none, and sums over a pattern.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "glare/psf/pattern_sources.h"
#include "tests/cl/cl_device.h"

namespace seaglare::glare {

// Null where the machine has no OpenCL; `reason` says what is missing.
inline std::unique_ptr<PatternSource> cl_source(const EyeModel& eye, const PatternSettings& settings,
                                                const std::vector<SpectralSample>& spectrum,
                                                std::string& reason) {
    try {
        LampSamples samples;
        samples.fill(spectrum);
        return make_cl_pattern_source(eye, settings, 7, std::move(samples));
    } catch (const std::runtime_error& error) {
        reason = error.what();
        return nullptr;
    }
}

// A statement for the body of a test.
#define SEAGLARE_CL_SOURCE(name, eye, settings, spectrum)                 \
    std::string name##_reason;                                            \
    const auto name = cl_source(eye, settings, spectrum, name##_reason);  \
    if (!name && !says_no_device(name##_reason)) FAIL() << name##_reason; \
    if (!name) GTEST_SKIP() << name##_reason

// An eye with nothing in it, whose pattern is the pupil's alone.
inline EyeModel clear_eye() {
    EyeModel eye;
    eye.cie_tail = false;
    return eye;
}

inline std::vector<SpectralSample> one_wavelength(double wavelength_nm) {
    return {{wavelength_nm, {1, 1, 1, 1}}};
}

inline Rgbv node(const Pattern& pattern, std::size_t layer, int a, int b) {
    const int side = 2 * pattern.radius_nodes + 1;
    const auto nodes = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    const auto at = static_cast<std::size_t>(b + pattern.radius_nodes) * static_cast<std::size_t>(side) +
                    static_cast<std::size_t>(a + pattern.radius_nodes);
    const float* const value = pattern.skirt.data() + (layer * nodes + at) * 4;
    return {value[0], value[1], value[2], value[3]};
}

inline void for_each_node(const Pattern& pattern, const std::function<void(int, int)>& visit) {
    const int r = pattern.radius_nodes;
    for (int b = -r; b <= r; ++b)
        for (int a = -r; a <= r; ++a)
            visit(a, b);
}

inline std::array<double, 4> skirt_energy(const Pattern& pattern, std::size_t layer) {
    std::array<double, 4> sum{};
    for_each_node(pattern, [&](int a, int b) {
        const Rgbv value = node(pattern, layer, a, b);
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += static_cast<double>(value[c]) * pattern.pitch * pattern.pitch;
    });
    return sum;
}

// Mean of a channel of the point layer over rings one node wide.
inline std::vector<double> radial_mean(const Pattern& pattern, std::size_t channel) {
    std::vector<double> sum(static_cast<std::size_t>(pattern.radius_nodes) + 1);
    std::vector<double> count(sum.size());
    for_each_node(pattern, [&](int a, int b) {
        const auto ring = static_cast<std::size_t>(std::lround(std::hypot(a, b)));
        if (ring >= sum.size()) return;
        sum[ring] += static_cast<double>(node(pattern, 0, a, b)[channel]);
        count[ring] += 1;
    });
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] /= count[i];
    return sum;
}

// Where the parabola through three neighbouring values has its extremum, relative to the middle one.
inline double parabola_offset(double before, double middle, double after) {
    return 0.5 * (before - after) / (before - 2 * middle + after);
}

}  // namespace seaglare::glare
