// Spectra through the pattern: whiteness, one pattern for each spectrum in view, stand-ins, and what the filter
// approximation is off by.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <iterator>
#include <memory>

#include "glare/colour/lamp_list.h"
#include "glare/colour/named_spectra.h"
#include "glare/tone/operators.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

PatternSettings quick() {
    PatternSettings settings;
    settings.transform_size = 512;
    settings.wide_field_size = 0;
    settings.layer_radii_px = {0};
    settings.max_radius_nodes = 40;
    return settings;
}

std::shared_ptr<const LampList> list_of(std::initializer_list<const char*> names) {
    std::array<std::shared_ptr<const LampSpectrum>, most_lamps> spectra{};
    std::size_t next = lamp_count;
    for (const char* name : names)
        spectra[next++] = std::make_shared<const LampSpectrum>(*LampSpectrum::from(*named_spectrum(name)));
    return make_lamp_list(spectra);
}

PatternRequest request_for(std::uint32_t lamps, const LampList* list = nullptr) {
    PatternRequest request;
    request.pupil_mm = 6;
    request.pitch = 1 / 869.1;
    request.lamps = lamps;
    request.lamp_list = list;
    return request;
}

std::array<double, 4> energy_of_slot(const Pattern& pattern, std::size_t slot) {
    std::array<double, 4> sum = skirt_energy(pattern, slot * pattern.layer_radius_nodes.size());
    for (std::size_t c = 0; c < 4; ++c)
        sum[c] += static_cast<double>(pattern.core_energy[slot][c]);
    return sum;
}

class Spectra : public ::testing::TestWithParam<bool> {
  protected:
    // Null, and skipped, where there is no OpenCL.
    std::unique_ptr<PatternSource> made(const PatternSettings& settings) const {
        try {
            return GetParam() ? make_cl_pattern_source(young_eye(), settings, 7)
                              : make_cpu_pattern_source(young_eye(), settings, 7);
        } catch (const std::runtime_error& error) {
            if (!says_no_device(error.what())) throw;
            return nullptr;
        }
    }
};
constexpr const char* no_device = "no OpenCL device";

TEST_P(Spectra, TheSamplesOfTheWhitePatternAreWhite) {
    // Before each channel is scaled to its share, the pattern's energy is that of the samples: D65's white however few.
    for (const int count : {8, 30, 60}) {
        Xyz sum;
        std::array<double, 3> rgb{};
        for (const SpectralSample& sample : sample_d65(count))
            for (std::size_t c = 0; c < 3; ++c)
                rgb[c] += sample.weight[c];
        sum = xyz_from_srgb(rgb);
        EXPECT_NEAR(chromaticity_of(sum).x, srgb_white.x, 5e-4) << count;
        EXPECT_NEAR(chromaticity_of(sum).y, srgb_white.y, 5e-4) << count;
    }
    const auto source = made(quick());
    if (!source) GTEST_SKIP() << no_device;
    const auto energy = energy_of_slot(source->make(request_for(1)), 0);
    const Chromaticity xy = chromaticity_of(xyz_from_srgb({energy[0], energy[1], energy[2]}));
    EXPECT_NEAR(xy.x, srgb_white.x, 5e-4);
    EXPECT_NEAR(xy.y, srgb_white.y, 5e-4);
}

TEST_P(Spectra, ALampsPatternKeepsTheLampsOwnColour) {
    const auto source = made(quick());
    if (!source) GTEST_SKIP() << no_device;
    const auto list = list_of({"led_white", "led_white_poor", "a", "led_green"});
    const Pattern& pattern = source->make(request_for(0x780, list.get()));
    ASSERT_EQ(pattern.lamps, (std::vector<std::uint8_t>{7, 8, 9, 10}));
    for (std::size_t slot = 0; slot < 4; ++slot) {
        const UnitColour& colour = list->spectra[lamp_count + slot]->colour();
        const auto energy = energy_of_slot(pattern, slot);
        std::array<double, 3> rgb{};
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] = static_cast<double>(colour.rgb[c]) * energy[c];
        const Chromaticity drawn = chromaticity_of(xyz_from_srgb(rgb));
        const Chromaticity lamp = chromaticity_of(
            xyz_from_srgb(std::array<double, 3>{colour.rgb[0], colour.rgb[1], colour.rgb[2]}));
        EXPECT_NEAR(drawn.x, lamp.x, 5e-4) << slot;
        EXPECT_NEAR(drawn.y, lamp.y, 5e-4) << slot;
    }
    EXPECT_LT(list->spectra[10]->colour().rgb[0], 0) << "the sign of a colour beyond sRGB was lost";
}

TEST_P(Spectra, LightsOfTwoSpectraGetTwoPatternsAndLightsOfOneGetOne) {
    const auto source = made(quick());
    if (!source) GTEST_SKIP() << no_device;
    const auto list = list_of({"a", "led_white"});
    const int one = source->make(request_for(1U << 7, list.get())).kernel_launches;
    EXPECT_EQ(source->make(request_for(1U << 7, list.get())).lamps.size(), 1U);
    const Pattern& two = source->make(request_for(3U << 7, list.get()));
    EXPECT_EQ(two.lamps.size(), 2U);
    EXPECT_EQ(two.slot_of_lamp[7], 0);
    EXPECT_EQ(two.slot_of_lamp[8], 1);
    EXPECT_NE(skirt_energy(two, 0), skirt_energy(two, 1));
    if (GetParam()) {
        const int both = source->make(request_for(3U << 7, list.get())).kernel_launches;
        const int again = source->make(request_for(1U << 8, list.get())).kernel_launches;
        EXPECT_GT(both, again);
        EXPECT_LE(both - again, one) << "the second spectrum repeated the eye's part";
    }
}

TEST_P(Spectra, AnotherListGivesItsLampsOtherPatterns) {
    const auto source = made(quick());
    if (!source) GTEST_SKIP() << no_device;
    const auto first = list_of({"led_red"});
    const auto second = list_of({"led_blue"});
    const Rgbv red = source->make(request_for(1U << 7, first.get())).core_energy[0];
    const Rgbv blue = source->make(request_for(1U << 7, second.get())).core_energy[0];
    EXPECT_GT(blue[1], red[1] * 1.02F) << "blue is diffracted less, so more of it is in the core";
    EXPECT_EQ(source->make(request_for(1U << 7, first.get())).core_energy[0], red);
}

TEST_P(Spectra, ALampBeyondTheLimitTakesThePatternOfTheNearest) {
    PatternSettings settings = quick();
    settings.max_lamps_in_view = 2;
    const auto source = made(settings);
    if (!source) GTEST_SKIP() << no_device;
    const Pattern& pattern = source->make(request_for(0b11011));  // white and red stay; yellow, blue do not
    EXPECT_EQ(pattern.lamps, (std::vector<std::uint8_t>{0, 1}));
    EXPECT_EQ(pattern.slot_of_lamp[3], 1) << "yellow is nearer to red";
    EXPECT_EQ(pattern.slot_of_lamp[4], 0) << "blue is nearer to white";
}

TEST_P(Spectra, AsAFilterThereIsOnePatternForAll) {
    PatternSettings settings = quick();
    const auto own = made(settings);
    if (!own) GTEST_SKIP() << no_device;
    settings.spectra = SpectraMode::filter;
    const auto filter = made(settings);
    if (!filter) GTEST_SKIP() << no_device;
    const Pattern& white = own->make(request_for(1));
    const Pattern& any = filter->make(request_for(0b1111110));
    EXPECT_EQ(any.lamps, std::vector<std::uint8_t>{0});
    EXPECT_EQ(any.skirt, white.skirt);
    for (const std::uint8_t slot : any.slot_of_lamp)
        EXPECT_EQ(slot, 0);
}

INSTANTIATE_TEST_SUITE_P(Sources, Spectra, ::testing::Values(true, false),
                         [](const auto& given) { return given.param ? "OpenCL" : "Plain"; });

// CIE 1976 L*a*b* of an XYZ relative to a white of luminance `white_y`.
std::array<double, 3> lab(const std::array<double, 3>& rgb, double white_y) {
    const Xyz xyz = xyz_from_srgb(rgb);
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const Xyz white = xyz_from_chromaticity(srgb_white, white_y);
    const double fx = f(xyz.x / white.x);
    const double fy = f(xyz.y / white.y);
    const double fz = f(xyz.z / white.z);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

struct FilterError {
    double relative_l1 = 0;   // of the skirt's luminance on screen pixels
    double core_share = 0;    // luminance in the core, filter over own, less 1
    double ring_delta_e = 0;  // mean colour of the ring 2 to 4 degrees
    int worst_code = 0;       // of an 8-bit picture, in the skirt
};

// What a light of E = 1e-2 lx by starlight (10 000 cd at 1 km) is off by when it has the white pattern.
FilterError filter_error(const Pattern& pattern, std::size_t own, const UnitColour& colour) {
    FilterError error;
    const ToneSettings tone;
    constexpr double lux = 1e-2;
    double sum = 0;
    double apart = 0;
    std::array<double, 3> ring_own{};
    std::array<double, 3> ring_filter{};
    for_each_node(pattern, [&](int a, int b) {
        const Rgbv p = node(pattern, own, a, b);
        const Rgbv q = node(pattern, 0, a, b);
        std::array<double, 3> rgb_own{};
        std::array<double, 3> rgb_filter{};
        for (std::size_t c = 0; c < 3; ++c) {
            rgb_own[c] = lux * static_cast<double>(colour.rgb[c] * p[c]);
            rgb_filter[c] = lux * static_cast<double>(colour.rgb[c] * q[c]);
        }
        const double y_own = luminance(rgb_own);
        const double y_filter = luminance(rgb_filter);
        sum += std::abs(y_own);
        apart += std::abs(y_own - y_filter);
        const double degrees = std::hypot(a, b) * pattern.pitch * 57.2958;
        for (std::size_t c = 0; c < 3 && degrees >= 2 && degrees <= 4; ++c) {
            ring_own[c] += rgb_own[c];
            ring_filter[c] += rgb_filter[c];
        }
        const auto shown = [&](const std::array<double, 3>& rgb, float scotopic) {
            const double rods = lux * static_cast<double>(scotopic * colour.scotopic_per_photopic);
            return display_delta(tone, 0.001, 0, {0, 0, 0}, rgb, rods);
        };
        const Rgb d = shown(rgb_own, p[3]);
        const Rgb e = shown(rgb_filter, q[3]);
        for (std::size_t c = 0; c < 3; ++c) {
            const int codes =
                static_cast<int>(std::lround(std::abs(srgb_encode(d[c]) - srgb_encode(e[c])) * 255));
            error.worst_code = std::max(error.worst_code, codes);
        }
    });
    error.relative_l1 = apart / sum;
    const double core_own = static_cast<double>(pattern.core_energy[own][1]);
    const double core_white = static_cast<double>(pattern.core_energy[0][1]);
    error.core_share = core_white / core_own - 1;
    const double white_y = std::max(luminance(ring_own), luminance(ring_filter));
    const auto x = lab(ring_own, white_y);
    const auto y = lab(ring_filter, white_y);
    error.ring_delta_e = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
    return error;
}

// The table of glare/colour/README.md: what "spectra": "filter" costs, by starlight, for a light of 1e-2 lx.
TEST(FilterApproximation, IsOffByWhatTheReadmeSays) {
    PatternSettings settings = quick();
    settings.transform_size = 4096;
    settings.max_radius_nodes = 72;
    std::unique_ptr<PatternSource> source;
    try {
        source = make_cl_pattern_source(young_eye(), settings, 7);
    } catch (const std::runtime_error& error) {
        if (!says_no_device(error.what())) throw;
        GTEST_SKIP() << error.what();
    }
    const auto list = list_of({"led_white", "led_white_poor", "a"});
    PatternRequest request = request_for(0b1111111, list.get());
    request.pupil_mm = 7;
    struct Row {
        const char* name;
        double l1, core, delta_e;
        int codes;  // at most
    };
    constexpr Row rows[] = {{"red", 0.038, 0.0232, 1.3, 61},      {"green", 0.024, -0.0052, 4.4, 21},
                            {"yellow", 0.023, 0.0126, 4.9, 32},   {"blue", 0.036, -0.0267, 3.9, 53},
                            {"orange", 0.024, 0.0135, 3.6, 37},   {"violet", 0.020, 0.0094, 3.0, 43},
                            {"led_white", 0.005, 0.0026, 1.3, 8}, {"led_white_poor", 0.019, 0.0090, 4.7, 24},
                            {"a", 0.007, -0.0009, 5.0, 15}};
    const auto check = [&](const Row& row, const Pattern& pattern, std::size_t slot,
                           const UnitColour& colour) {
        const FilterError e = filter_error(pattern, slot, colour);
        std::printf("{\"%s\", %.3f, %+.4f, %.1f, %d},\n", row.name, e.relative_l1, e.core_share,
                    e.ring_delta_e, e.worst_code);
        EXPECT_NEAR(e.relative_l1, row.l1, 0.1 * row.l1) << row.name;
        EXPECT_NEAR(e.core_share, row.core, 0.1 * std::abs(row.core) + 1e-3) << row.name;
        EXPECT_NEAR(e.ring_delta_e, row.delta_e, 0.1 * row.delta_e + 0.5) << row.name;
        EXPECT_LE(e.worst_code, row.codes) << row.name;
    };
    const Pattern& navigation = source->make(request);
    for (std::size_t lamp = 1; lamp < lamp_count; ++lamp)
        check(rows[lamp - 1], navigation, lamp, navigation_colour(static_cast<int>(lamp)));
    request.lamps = 1 | 7U << 7;
    const Pattern& named = source->make(request);
    for (std::size_t i = 0; i < 3; ++i)
        check(rows[lamp_count - 1 + i], named, i + 1, list->spectra[lamp_count + i]->colour());
}

}  // namespace
}  // namespace seaglare::glare
