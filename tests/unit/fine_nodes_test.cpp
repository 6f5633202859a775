// Finer nodes near a light: they add no energy at any place of the light under the grid, and are drawn as far as they show.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "glare/apply/fine_reach.h"
#include "glare/plan/filter_blend.h"
#include "glare/psf/fine_nodes.h"
#include "glare/psf/pattern_mix.h"
#include "glare/psf/pattern_sources.h"

namespace seaglare::glare {
namespace {

Pattern made(double pupil_mm) {
    EyeModel eye = circular_pupil_eye();
    PatternSettings settings;
    settings.transform_size = 1024;
    settings.layer_radii_px = {0, 1.5F};
    settings.max_radius_nodes = 24;
    settings.wavelengths = 4;
    PatternRequest request;
    request.pupil_mm = pupil_mm;
    request.pitch = 1 / 869.1;
    request.lamps = 0b11;
    return make_cpu_pattern_source(eye, settings, 1)->make(request);
}

constexpr int radius = fine_per_node * fine_radius_nodes;
float fine_at(const Pattern& pattern, std::size_t slot, int a, int b, std::size_t channel) {
    const int row = b + radius;
    const int column = a + radius;
    const std::size_t node = static_cast<std::size_t>(row) * fine_side + static_cast<std::size_t>(column);
    return pattern.fine[slot * fine_floats + 4 * node + channel];
}

TEST(FineNodes, AddNoEnergyAtAnyPlaceUnderTheGrid) {
    const Pattern pattern = made(6);
    ASSERT_EQ(pattern.fine.size(), 2 * fine_floats);
    for (std::size_t slot = 0; slot < 2; ++slot) {
        for (std::size_t c = 0; c < 4; ++c) {
            double largest = 0;
            for (int y = 0; y < fine_per_node; ++y) {
                for (int x = 0; x < fine_per_node; ++x) {
                    double sum = 0;
                    double size = 0;
                    for (int b = y - radius; b <= radius; b += fine_per_node)
                        for (int a = x - radius; a <= radius; a += fine_per_node) {
                            sum += static_cast<double>(fine_at(pattern, slot, a, b, c));
                            size += std::abs(static_cast<double>(fine_at(pattern, slot, a, b, c)));
                        }
                    largest = std::max(largest, size);
                    EXPECT_LT(std::abs(sum) * pattern.pitch * pattern.pitch, 1e-7) << x << ", " << y;
                }
            }
            // And they are there: per mille of a light's energy move.
            EXPECT_GT(largest * pattern.pitch * pattern.pitch, 1e-3);
        }
    }
}

TEST(FineNodes, VanishAtTheirRimAndAreThereOnBothSidesOfTheLight) {
    const Pattern pattern = made(6);
    for (int a = -radius; a <= radius; ++a) {
        EXPECT_EQ(fine_at(pattern, 0, a, radius, 1), 0);
        EXPECT_EQ(fine_at(pattern, 0, -radius, a, 1), 0);
        for (int b = 0; b <= radius; ++b)
            EXPECT_NEAR(fine_at(pattern, 0, a, b, 1), fine_at(pattern, 0, -a, -b, 1),
                        1e-5 * std::abs(fine_at(pattern, 0, a, b, 1)) + 0.1);
    }
}

TEST(FineNodes, NeedAllTheirCells) {
    Pattern pattern = made(6);
    const PatternGrid grid = plan_grid(PatternSettings{}, pattern.pitch);
    std::vector<Rgbv> few(10);
    EXPECT_THROW(fill_fine_nodes(few, {}, grid, 0, pattern), std::invalid_argument);
}

TEST(FineNodes, AreMixedAndDimmedWithTheirPatterns) {
    const Pattern a = made(4);
    const Pattern b = made(6);
    Pattern mixed;
    mix_patterns(a, b, 0.25, mixed, 0.5);
    ASSERT_EQ(mixed.fine.size(), a.fine.size());
    for (std::size_t i = 0; i < a.fine.size(); ++i)
        ASSERT_NEAR(mixed.fine[i], 0.375F * a.fine[i] + 0.125F * b.fine[i],
                    1e-5F * std::abs(mixed.fine[i]) + 1e-3F);
    Pattern bare = b;
    bare.fine.clear();
    bare.generation = b.generation + 1;
    mix_patterns(a, bare, 0.25, mixed);
    ASSERT_EQ(mixed.fine.size(), a.fine.size());
    for (std::size_t i = 0; i < a.fine.size(); ++i)
        ASSERT_FLOAT_EQ(mixed.fine[i], 0.75F * a.fine[i]);
    Pattern dimmed = a;
    dim_pattern(0.25, dimmed);
    for (std::size_t i = 0; i < a.fine.size(); ++i)
        ASSERT_FLOAT_EQ(dimmed.fine[i], 0.25F * a.fine[i]);
    Pattern one_lamp;
    blend_towards_first_lamp(a, 1, one_lamp);
    for (std::size_t i = 0; i < fine_floats; ++i)
        ASSERT_NEAR(one_lamp.fine[fine_floats + i], a.fine[i],
                    1e-6F * std::abs(a.fine[fine_floats + i]) + 1e-6F * std::abs(a.fine[i]));
}

TEST(FineReach, BeyondItNothingShows) {
    const Pattern pattern = made(6);
    FineReach reach;
    EXPECT_EQ(reach.nodes(0, 0), 0) << "of no pattern yet";
    reach.update(pattern);
    EXPECT_EQ(reach.nodes(0, 0), fine_radius_nodes);
    EXPECT_EQ(reach.nodes(0, 1e12), 0);
    EXPECT_EQ(reach.nodes(2, 0), 0) << "a slot that is not there";
    double before = fine_radius_nodes;
    for (const double psf_sr : {1e-1, 1e0, 1e1, 1e2, 1e3, 1e4}) {
        const double nodes = reach.nodes(1, psf_sr);
        EXPECT_LE(nodes, before);
        before = nodes;
        for (int b = -radius; b <= radius; ++b) {
            for (int a = -radius; a <= radius; ++a) {
                if (std::hypot(a, b) / fine_per_node < nodes) continue;
                for (std::size_t c = 0; c < 4; ++c)
                    ASSERT_LE(std::abs(fine_at(pattern, 1, a, b, c)), psf_sr) << a << ", " << b;
            }
        }
    }
    EXPECT_LT(reach.nodes(1, 1e3), fine_radius_nodes) << "of some lights less is drawn";
}

}  // namespace
}  // namespace seaglare::glare
