// What seaglare-report compares with and how it writes it down: published curves, the 2012 thesis's algorithm, tables.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "glare/psf/pattern_sources.h"
#include "host_stub/report/pattern_image.h"
#include "host_stub/report/report_page.h"
#include "host_stub/report/stability.h"
#include "host_stub/report/thesis_pattern.h"

namespace seaglare::report {
namespace {

template <typename Curve>
double hemisphere_integral(Curve curve) {
    double sum = 0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        const double theta = std::numbers::pi / 2 * t * t * t;
        sum += curve(theta * 180 / std::numbers::pi) * 2 * std::numbers::pi * std::sin(theta) *
               std::numbers::pi / 2 * 3 * t * t / steps;
    }
    return sum;
}

// CIE 135/1-1999 total glare for 24 years and brown eyes; its integral over the hemisphere is 1.0102.
TEST(ReportCurves, TheCiesHasItsValues) {
    const auto cie = [](double angle_deg) { return reference::cie_curve_sr(angle_deg, 24, 0.5); };
    EXPECT_NEAR(cie(0.01), 7.943e5, 50);
    EXPECT_NEAR(cie(0.1), 11443, 1);
    EXPECT_NEAR(cie(1), 18.85, 0.005);
    EXPECT_NEAR(cie(4), 0.4940, 5e-5);
    EXPECT_NEAR(cie(30), 0.007585, 5e-7);
    EXPECT_NEAR(hemisphere_integral(cie), 1.0102, 2e-4);
}

// Spencer et al. 1995: every component is normalised over the hemisphere, and so are their sums.
TEST(ReportCurves, SpencersIntegrateToOne) {
    EXPECT_NEAR(hemisphere_integral(spencer_photopic_sr), 1, 0.01);
    EXPECT_NEAR(hemisphere_integral(spencer_scotopic_sr), 1, 0.01);
    // The halo, at 3 degrees for 568 nm.
    EXPECT_GT(spencer_scotopic_sr(3), spencer_scotopic_sr(2.6));
    EXPECT_GT(spencer_scotopic_sr(3), spencer_scotopic_sr(3.4));
}

TEST(ReportImage, HoldsAllThatThePatternHas) {
    glare::EyeModel eye = glare::young_eye();
    eye.cie_tail = false;
    glare::PatternSettings settings;
    settings.transform_size = 256;
    settings.wavelengths = 5;
    const auto source = glare::make_cpu_pattern_source(eye, settings, 1);
    glare::PatternRequest request;
    request.pupil_mm = 3;
    request.pitch = 1 / 869.1;
    const glare::Pattern& pattern = source->make(request);
    const PatternImage image = image_of(pattern, settings.core_radius_nodes, pattern.radius_nodes);
    double energy = 0;
    for (const auto& pixel : image.pixels)
        energy += photopic(pixel) * image.pitch * image.pitch;
    EXPECT_NEAR(energy, 1, 1e-4);
    const auto rings = rings_of(image);
    EXPECT_NEAR(rings.back().energy_inside, 1, 0.01);
    for (std::size_t i = 1; i < rings.size(); ++i) {
        EXPECT_GT(rings[i].outer_deg, rings[i - 1].outer_deg);
        EXPECT_GE(rings[i].energy_inside, rings[i - 1].energy_inside);
    }
}

TEST(ReportYardstick, TheThesissPatternIsWhiteCentredAndOfUnitEnergy) {
    const ThesisPattern made = make_thesis_pattern(glare::thesis_eye(), 6.5, 9, 1, {0, 2});
    double red = 0;
    double blue = 0;
    double luminance = 0;
    double layer = 0;
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < made.pixels.size(); ++i) {
        const auto& p = made.pixels[i];
        red += static_cast<double>(p[0]);
        blue += static_cast<double>(p[2]);
        luminance += 0.2126 * static_cast<double>(p[0]) + 0.7152 * static_cast<double>(p[1]) +
                     0.0722 * static_cast<double>(p[2]);
        layer += 0.2126 * static_cast<double>(made.layers[1][i][0]) +
                 0.7152 * static_cast<double>(made.layers[1][i][1]) +
                 0.0722 * static_cast<double>(made.layers[1][i][2]);
        if (p[1] > made.pixels[brightest][1]) brightest = i;
    }
    EXPECT_EQ(brightest, static_cast<std::size_t>(256 * 512 + 256));
    // A look-up where a pixel's integral is wanted: the sum is out by some per cent, and that is part of its error.
    EXPECT_NEAR(luminance, 1, 0.1);
    EXPECT_NEAR(red / luminance, 1, 0.1);
    // At short wavelengths the look-up steps over samples but always meets the brightest.
    EXPECT_NEAR(blue / luminance, 1.225, 0.05);
    EXPECT_NEAR(layer, luminance, 0.02);
    EXPECT_GT(made.times.spread_ms, 0);
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(ReportPage, WritesTablesByRfc4180AndAPageThatShowsThem) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "seaglare_report_page";
    Page page(folder, "A <title>");
    Table table({"name", "value"});
    table.add() << "a, \"b\"" << 0.5;
    table.add() << "none" << std::nan("");
    table.add() << "whole" << 3;
    page.table("numbers", "Numbers & more", table);
    page.finish();
    EXPECT_EQ(text_of(folder / "numbers.csv"), "name,value\n\"a, \"\"b\"\"\",0.5\nnone,\nwhole,3\n");
    const std::string html = text_of(folder / "index.html");
    EXPECT_NE(html.find("A &lt;title&gt;"), std::string::npos);
    EXPECT_NE(html.find("<td>a, &quot;b&quot;</td>"), std::string::npos);
    EXPECT_EQ(html.find("http"), std::string::npos) << "the page opens without a server or a network";
    std::filesystem::remove_all(folder);
}

TEST(ReportStability, EverythingThatMovesHolds) {
    for (const Check& check : moving_parts())
        EXPECT_TRUE(check.passed()) << check.what << ", " << check.cases << ": " << check.holds << ": "
                                    << check.worst;
}

TEST(ReportStability, LightsThatMoveAndWhatGoesOverHold) {
    for (const Check& check : moving_lights())
        EXPECT_TRUE(check.passed()) << check.what << ", " << check.cases << ": " << check.holds << ": "
                                    << check.worst;
}

TEST(ReportStability, ScenesAndPicturesOfEverySizeHold) {
    for (const Check& check : scene_extremes(10000))
        EXPECT_TRUE(check.passed()) << check.what << ", " << check.cases << ": " << check.holds << ": "
                                    << check.worst;
}

TEST(ReportStability, EveryExtremeHolds) {
    for (const Check& check : extremes())
        EXPECT_TRUE(check.passed()) << check.what << ", " << check.cases << ": " << check.holds << ": "
                                    << check.worst;
}

TEST(ReportStability, NothingThatIsNotFiniteAndNothingUntriedPasses) {
    Check check{"", "", "", 0, 1};
    EXPECT_FALSE(check.passed());
    check.see(0.5);
    EXPECT_TRUE(check.passed());
    check.see(std::nan(""));
    EXPECT_FALSE(check.passed());
    check.see(0.1);
    EXPECT_FALSE(check.passed());
}

}  // namespace
}  // namespace seaglare::report
