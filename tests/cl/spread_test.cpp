// The two kernels that spread energy over wavelengths make the same cells, and disc layers are what the stencil makes of the
// point layer.
#include <algorithm>
#include <array>

#include "glare/psf/cl_screen_stage.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

PatternSettings settings_of(int n, double plane_mm, double angular_scale) {
    PatternSettings settings;
    settings.transform_size = n;
    settings.plane_width_mm = plane_mm;
    settings.angular_scale = angular_scale;
    settings.layer_radii_px = {0, 1.7F, 10};
    return settings;
}

Pattern made(const ClDevice& device, const PatternSettings& settings, double pitch, bool in_tiles) {
    const EyeModel model = young_eye();
    ClEyeStage eye(device, model, settings, 7);
    ClScreenStage screen(device, settings, sample_lamps(settings.wavelengths));
    screen.spread_in_tiles(in_tiles);
    Pattern pattern;
    pattern.layer_radius_nodes = {0};
    eye.update(3.3, 0);
    screen.make(eye, nullptr, plan_grid(settings, pitch), 1, pattern);
    return pattern;
}

// Boxes of one sample, of five and of sixteen: the tiles' dense and sparse ways. Both differ by rounding alone: a cell's
// energy is a difference of sums that may be a thousand times its size, each to 6e-8.
TEST(Spread, TilesAndCellsAreTheSame) {
    SEAGLARE_CL_DEVICE(device);
    struct Case {
        PatternSettings settings;
        double pitch;
    };
    for (const Case& c :
         {Case{settings_of(256, 9, 18), 1 / 869.1}, Case{settings_of(1024, 4.5, 1), 1 / 1303.7},
          Case{settings_of(1024, 9, 1), 1 / 869.1}}) {
        const Pattern tiles = made(*device, c.settings, c.pitch, true);
        const Pattern cells = made(*device, c.settings, c.pitch, false);
        ASSERT_EQ(tiles.skirt.size(), cells.skirt.size());
        double apart = 0;
        double sum = 0;
        for (std::size_t i = 0; i < cells.skirt.size(); ++i) {
            const auto a = static_cast<double>(tiles.skirt[i]);
            const auto b = static_cast<double>(cells.skirt[i]);
            apart = std::max(apart, std::abs(a - b) / (std::abs(b) + 1e-3));
            sum += std::abs(b);
        }
        EXPECT_GT(sum, 0);
        EXPECT_LT(apart, 2e-3);
        for (std::size_t channel = 0; channel < 4; ++channel)
            EXPECT_NEAR(tiles.core_energy[0][channel], cells.core_energy[0][channel], 1e-5F);
    }
}

// Brute force in double precision at nodes near, on and far from the middle, and at the rim.
TEST(DiscLayers, AreTheStencilsMeanOfThePointLayer) {
    const PatternSettings settings = settings_of(512, 9, 18);
    SEAGLARE_CL_SOURCE(source, young_eye(), settings, sample_d65(30));
    PatternRequest request;
    request.pupil_mm = 5;
    request.pitch = 1 / 869.1;
    request.largest_disc_nodes = 10;
    const Pattern& pattern = source->make(request);
    ASSERT_EQ(pattern.layer_radius_nodes.size(), 3U);
    const int r = pattern.radius_nodes;
    for (std::size_t layer = 1; layer < 3; ++layer) {
        const DiscStencil disc = make_disc_stencil(static_cast<double>(pattern.layer_radius_nodes[layer]));
        for (const auto& at :
             {std::pair{0, 0}, {1, 0}, {-7, 0}, {0, 9}, {13, -4}, {-50, 61}, {r - 12, 0}, {r, r}}) {
            const int a = at.first;
            const int b = at.second;
            double sum = 0;
            const auto add = [&](int dx, int dy, double weight) {
                if (std::abs(a + dx) > r || std::abs(b + dy) > r) return;
                sum += weight * static_cast<double>(node(pattern, 0, a + dx, b + dy)[1]);
            };
            for (const DiscSpan& span : disc.spans)
                for (int dx = -span.half_width; dx <= span.half_width; ++dx)
                    add(dx, span.dy, disc.span_weight);
            for (const DiscTap& tap : disc.taps)
                add(tap.dx, tap.dy, tap.weight);
            EXPECT_NEAR(node(pattern, layer, a, b)[1], sum, 2e-5 * std::abs(sum) + 1e-6) << a << ", " << b;
        }
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(skirt_energy(pattern, layer)[c], skirt_energy(pattern, 0)[c], 1e-4);
    }
}

// Grids of every remainder by four, discs within a node, of some and of more than the rows' way has room for, and a grid that
// is hardly larger than its disc. Nothing is subtracted in rows; the other way subtracts sums of columns.
TEST(DiscLayers, AreTheSameInRowsAndNodeByNode) {
    SEAGLARE_CL_DEVICE(device);
    for (const int most : {12, 61, 62, 63, 64, 200}) {
        PatternSettings settings = settings_of(256, 9, 18);
        settings.max_radius_nodes = most;
        settings.layer_radii_px = {0, 0.4F, 1.7F, 5, 10, 15.4F, 22};
        const EyeModel model = young_eye();
        ClEyeStage eye(*device, model, settings, 7);
        ClScreenStage screen(*device, settings, sample_lamps(settings.wavelengths));
        const PatternGrid grid = plan_grid(settings, 1 / 869.1);
        eye.update(3.3, 0);
        std::array<Pattern, 2> made;
        for (const bool in_rows : {false, true}) {
            screen.discs_in_rows(in_rows);
            Pattern& pattern = made[in_rows ? 1 : 0];
            pattern.layer_radius_nodes = plan_layers(settings, grid, 22);
            screen.make(eye, nullptr, grid, 1, pattern);
        }
        ASSERT_EQ(made[0].skirt.size(), made[1].skirt.size());
        ASSERT_GT(made[0].layer_radius_nodes.size(), 3U);
        const float largest = *std::max_element(made[0].skirt.begin(), made[0].skirt.end());
        ASSERT_GT(largest, 0);
        for (std::size_t i = 0; i < made[0].skirt.size(); ++i)
            ASSERT_NEAR(made[0].skirt[i], made[1].skirt[i],
                        2e-5F * std::abs(made[1].skirt[i]) + 1e-6F * largest)
                << most << " nodes, value " << i;
    }
}

// At 30 degrees over 2160 lines thirty wavelengths lie eight pixels apart at the rim, and the needles break into beads: their
// contrast is too high. With as many as the pixel asks for it is that of a spectrum without gaps.
TEST(Spread, WavelengthsFollowThePixel) {
    PatternSettings settings = settings_of(1024, 2.25, 1);
    settings.layer_radii_px = {0};
    const double pitch = 1 / 4030.6;
    PatternRequest request;
    request.pupil_mm = 2;
    request.pitch = pitch;
    SEAGLARE_CL_SOURCE(thirty, young_eye(), settings, sample_d65(30));
    SEAGLARE_CL_SOURCE(fine, young_eye(), settings, sample_d65(480));
    settings.wavelength_step_px = 1;
    SEAGLARE_CL_SOURCE(follow, young_eye(), settings, sample_d65(30));
    const auto contrast = [](const Pattern& p) {
        double sum = 0;
        double squares = 0;
        double count = 0;
        for_each_node(p, [&](int a, int b) {
            const double r = std::hypot(a, b);
            if (r < 150 || r > 250) return;
            const double level = r * r * static_cast<double>(node(p, 0, a, b)[1]);
            sum += level;
            squares += level * level;
            count += 1;
        });
        const double mean = sum / count;
        return std::sqrt(squares / count - mean * mean) / mean;
    };
    const double truth = contrast(fine->make(request));
    EXPECT_GT(contrast(thirty->make(request)) / truth, 1.1);
    EXPECT_NEAR(contrast(follow->make(request)) / truth, 1, 0.03);
}

// What thirty wavelengths miss of a spectrum without gaps, at the scale of 45 degrees and 720 lines: the mean over rings to a
// thousandth, a pixel to some per cent (the needles' texture), and sixty miss half of that at most.
TEST(Spread, ThirtyWavelengthsKeepTheRingsAndSixtyTheirTexture) {
    const PatternSettings settings = settings_of(1024, 4.5, 1);
    SEAGLARE_CL_SOURCE(fine, young_eye(), settings, sample_d65(480));
    SEAGLARE_CL_SOURCE(thirty, young_eye(), settings, sample_d65(30));
    SEAGLARE_CL_SOURCE(sixty, young_eye(), settings, sample_d65(60));
    PatternRequest request;
    request.pupil_mm = 3;
    request.pitch = 1 / 869.1;
    const Pattern& truth = fine->make(request);
    const auto l1 = [&](const Pattern& p) {
        double apart = 0;
        double sum = 0;
        for_each_node(p, [&](int a, int b) {
            const double level = a * a + b * b;
            apart += level * std::abs(static_cast<double>(node(p, 0, a, b)[1]) -
                                      static_cast<double>(node(truth, 0, a, b)[1]));
            sum += level * static_cast<double>(node(truth, 0, a, b)[1]);
        });
        return apart / sum;
    };
    const Pattern& coarse = thirty->make(request);
    const std::vector<double> a = radial_mean(coarse, 1);
    const std::vector<double> b = radial_mean(truth, 1);
    const auto last = static_cast<std::size_t>(0.7 * truth.window_outer / truth.pitch);
    for (std::size_t r = 4; r < last; ++r)
        EXPECT_NEAR(a[r] / b[r], 1, 0.01) << r;
    EXPECT_LT(l1(coarse), 0.03);
    EXPECT_LT(l1(sixty->make(request)), 0.5 * l1(coarse) + 1e-4);
}

}  // namespace
}  // namespace seaglare::glare
