// What lint says of contradictions, and what it must not say of sound lights.
#include "lightdb/lint.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lightdb/light_file.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb {
namespace {

std::vector<Light> lights_of(const std::string& lights) {
    return parse_light_file("{\"lights\": [" + lights + "]}", "lint.json").lights;
}
// A white light, 10 m high, with these members.
std::string light(const std::string& members, const std::string& name = "A") {
    std::string text = "{\"name\": \"" + name + "\"";
    if (members.find("\"lat\"") == std::string::npos) text += ", \"lat\": 55, \"lon\": 11";
    if (members.find("\"height_m\"") == std::string::npos) text += ", \"height_m\": 10";
    if (members.find("_cd\"") == std::string::npos && members.find("_nm\"") == std::string::npos)
        text += ", \"intensity_cd\": 100";
    return text + ", " + members + "}";
}
std::size_t count(const std::string& lights, LintKind kind) {
    const std::vector<Light> parsed = lights_of(lights);
    const auto findings = lint(parsed);
    return static_cast<std::size_t>(
        std::count_if(findings.begin(), findings.end(), [&](const auto& f) { return f.kind == kind; }));
}
std::string sectors(const std::string& text) {
    return light("\"character\": \"F WRG\", \"sectors\": [" + text + "]");
}
std::string sector(const char* colour, double from, double to) {
    return std::string("{\"colour\": \"") + colour + "\", \"from\": " + std::to_string(from) +
           ", \"to\": " + std::to_string(to) + "}";
}

TEST(Lint, ASoundLightHasNoFindings) {
    EXPECT_TRUE(
        lint(lights_of(light("\"character\": \"Fl(2) W 6s fl. 0.5s, ec. 1s, fl. 0.5s, ec. 4s\""))).empty());
    EXPECT_TRUE(lint({}).empty());
}

TEST(Lint, EveryKindHasANameAndAMeaning) {
    EXPECT_EQ(lint_kinds().size(), static_cast<std::size_t>(LintKind::chromaticity) + 1);
    for (const LintKind kind : lint_kinds()) {
        EXPECT_FALSE(lint_name(kind).empty());
        EXPECT_FALSE(lint_meaning(kind).empty());
    }
}

// NGA Pub. 116 has three of them.
TEST(Lint, DurationsThatDoNotSumToThePeriodAreFound) {
    EXPECT_EQ(count(light("\"character\": \"Fl W 6s fl. 0.5s, ec. 5s\""), LintKind::phases_miss_period), 1U);
    EXPECT_EQ(count(light("\"character\": \"Fl W 6s fl. 0.5s, ec. 5.5s\""), LintKind::phases_miss_period),
              0U);
    EXPECT_EQ(count(light("\"character\": \"Fl W 6s\", \"phases\": [{\"lit\": 1}, {\"eclipse\": 4}]"),
                    LintKind::phases_miss_period),
              1U);
    EXPECT_EQ(count(light("\"character\": \"Al.Fl(3)WR 15s\""), LintKind::phases_miss_period), 0U)
        << "its colours come round after two periods";
}

// IHO S-57 Appendix A, LITCHR 3, 7 and 8.
TEST(Lint, ClassesAreHeldToTheirDurations) {
    EXPECT_EQ(count(light("\"character\": \"Iso W 4s fl. 1s, ec. 3s\""), LintKind::class_against_rhythm), 1U);
    EXPECT_EQ(count(light("\"character\": \"Oc W 8s fl. 2s, ec. 6s\""), LintKind::class_against_rhythm), 1U);
    EXPECT_EQ(count(light("\"character\": \"LFl W 10s fl. 1s, ec. 9s\""), LintKind::class_against_rhythm),
              1U);
    EXPECT_EQ(count(light("\"character\": \"LFl W 10s fl. 2s, ec. 8s\""), LintKind::class_against_rhythm),
              0U);
}

TEST(Lint, ASectorWithItsLimitsTheWrongWayRoundIsFound) {
    const std::string others = sector("W", 100, 110) + ", " + sector("G", 110, 150);
    EXPECT_EQ(count(sectors(sector("R", 60, 100) + ", " + others), LintKind::sector_swapped), 0U);
    EXPECT_EQ(count(sectors(sector("R", 100, 60) + ", " + others), LintKind::sector_swapped), 1U);
    EXPECT_EQ(count(sectors(sector("R", 100, 60) + ", " + others), LintKind::sector_overlap), 0U)
        << "told once, by its cause";
}

TEST(Lint, OverlapsAreOfDifferentColoursOnly) {
    EXPECT_EQ(count(sectors(sector("W", 10, 40) + "," + sector("R", 35, 60) + "," + sector("G", 60, 90)),
                    LintKind::sector_overlap),
              1U);
    EXPECT_EQ(count(sectors(sector("W", 350, 20) + "," + sector("R", 15, 60)), LintKind::sector_overlap), 1U)
        << "through north";
    EXPECT_EQ(
        count(sectors(sector("W", 10, 40) + ", {\"colour\": \"W\", \"from\": 20, \"to\": 30, "
                                            "\"intensity_factor\": 0.25}, {\"colour\": null, \"from\": 32, "
                                            "\"to\": 35}"),
              LintKind::sector_overlap),
        0U);
}

TEST(Lint, AGapBetweenSectorsIsFoundAndTheLandwardSideIsNot) {
    EXPECT_EQ(count(sectors(sector("G", 10, 30) + "," + sector("W", 40, 50) + "," + sector("R", 50, 90)),
                    LintKind::sector_gap),
              1U);
    EXPECT_EQ(count(sectors(sector("G", 10, 40) + "," + sector("W", 40, 50) + "," + sector("R", 50, 90)),
                    LintKind::sector_gap),
              0U);
    EXPECT_EQ(count(sectors(sector("G", 10, 30) + ",{\"colour\": null, \"from\": 30, \"to\": 40}," +
                            sector("W", 40, 50) + "," + sector("R", 50, 90)),
                    LintKind::sector_gap),
              0U)
        << "what is said to be dark is no gap";
    EXPECT_EQ(count(sectors(sector("W", 0, 180) + "," + sector("R", 183, 360)), LintKind::sector_gap), 1U)
        << "3 degrees are no landward side";
}

TEST(Lint, ColoursOfCharacterAndSectorsAreCompared) {
    EXPECT_EQ(
        count(sectors(sector("W", 10, 40) + "," + sector("R", 40, 60)), LintKind::colour_without_sector), 1U);
    EXPECT_EQ(count(light("\"character\": \"F W\", \"sectors\": [" + sector("R", 10, 40) + "]"),
                    LintKind::colour_unnamed),
              1U);
    EXPECT_EQ(count(light("\"character\": \"F WRG\""), LintKind::colours_without_sectors), 1U);
    EXPECT_EQ(count(light("\"character\": \"Al WR 4s\""), LintKind::colours_without_sectors), 0U);
}

// A charted "12M" stands for 11.5 to 12.5 M.
TEST(Lint, ARangeAndAnIntensityMayDifferByRoundingOnly) {
    const auto found = [](double range_nm) {
        return count(light("\"character\": \"F W 12M\", \"intensity_cd\": " +
                           std::to_string(intensity_for_range_cd(range_nm))),
                     LintKind::range_against_intensity);
    };
    EXPECT_EQ(found(12), 0U);
    EXPECT_EQ(found(11.55), 0U);
    EXPECT_EQ(found(12.45), 0U);
    EXPECT_EQ(found(11.4), 1U);
    EXPECT_EQ(found(12.6), 1U);
}

// Blondel and Rey: a flash of 0.2 s is worth half its intensity to the eye, so either reading of the range is sound.
TEST(Lint, TheRangeOfAFlashMayBeThatOfItsEffectiveIntensity) {
    const std::string peak = std::to_string(2 * intensity_for_range_cd(12));
    EXPECT_EQ(count(light("\"character\": \"Fl W 5s 12M fl. 0.2s, ec. 4.8s\", \"intensity_cd\": " + peak),
                    LintKind::range_against_intensity),
              0U);
    EXPECT_EQ(count(light("\"character\": \"F W 12M\", \"intensity_cd\": " + peak),
                    LintKind::range_against_intensity),
              1U);
}

TEST(Lint, ImplausibleRangesHeightsAndLightsThatNeverShow) {
    EXPECT_EQ(count(light("\"character\": \"F W\", \"nominal_range_nm\": 31"), LintKind::range_implausible),
              1U);
    EXPECT_EQ(count(light("\"character\": \"F W\", \"nominal_range_nm\": 30"), LintKind::range_implausible),
              0U);
    EXPECT_EQ(count(light("\"character\": \"F W\", \"height_m\": 0"), LintKind::height_not_positive), 1U);
    EXPECT_EQ(count(light("\"character\": \"F W 12m\""), LintKind::height_against_character), 1U);
    EXPECT_EQ(count(light("\"character\": \"F W\", \"intensity_cd\": 0"), LintKind::no_visible_light), 1U);
    EXPECT_EQ(
        count(light("\"character\": \"F W\", \"sectors\": [{\"colour\": null, \"from\": 0, \"to\": 90}]"),
              LintKind::no_visible_light),
        1U);
}

TEST(Lint, TheSameLightTwiceWithinMetresIsADuplicate) {
    const std::string a = light("\"lat\": 55, \"lon\": 11, \"character\": \"Fl W 5s\"", "a");
    const auto with = [&](const std::string& other) { return count(a + "," + other, LintKind::duplicate); };
    EXPECT_EQ(with(light("\"lat\": 55.00005, \"lon\": 11.00005, \"character\": \"Fl W 5s\"", "b")), 1U);
    EXPECT_EQ(with(light("\"lat\": 55.001, \"lon\": 11, \"character\": \"Fl W 5s\"", "b")), 0U) << "111 m";
    EXPECT_EQ(with(light("\"lat\": 55, \"lon\": 11, \"character\": \"Fl W 6s\"", "b")), 0U);
    EXPECT_EQ(with(light("\"lat\": 55, \"lon\": 11, \"character\": \"Fl W 5s\", \"height_m\": 12", "b")), 0U)
        << "a lamp above it";
}

// 1852 m north and as many metres east as to make the line 045 degrees.
TEST(Lint, FrontAndRearLightsMustStandOnTheirLine) {
    const std::string front =
        light("\"lat\": 55.1234567, \"lon\": 11, \"character\": \"F W\"", "Haven Range, front");
    const auto rear = [](const char* bearing, const char* height) {
        return light("\"lat\": 55.1401234, \"lon\": 11.0291539, \"character\": \"F W\", \"height_m\": " +
                         std::string(height),
                     std::string("Haven Range, Rear, 2,622 meters ") + bearing + "\xC2\xB0 from front");
    };
    EXPECT_EQ(count(front + "," + rear("045", "20"), LintKind::leading_bearing), 0U);
    EXPECT_EQ(count(front + "," + rear("050", "20"), LintKind::leading_bearing), 1U);
    EXPECT_EQ(count(front + "," + rear("225", "20"), LintKind::leading_bearing), 1U) << "the wrong way round";
    EXPECT_EQ(count(front + "," + rear("045", "20"), LintKind::leading_heights), 0U);
    EXPECT_EQ(count(front + "," + rear("045", "5"), LintKind::leading_heights), 1U);
}

TEST(Lint, ALeadingLightMustShowAlongItsLine) {
    const auto pair = [](const char* from, const char* to) {
        return light(std::string(
                         "\"lat\": 55.1, \"lon\": 11, \"character\": \"F W\", \"sectors\": [{\"colour\": "
                         "\"W\", \"from\": ") +
                         from + ", \"to\": " + to + "}]",
                     "Haven, front") +
               "," +
               light("\"lat\": 55.2, \"lon\": 11, \"character\": \"F W\", \"height_m\": 30", "Haven, rear");
    };
    EXPECT_EQ(count(pair("350", "10"), LintKind::leading_invisible), 0U);
    EXPECT_EQ(count(pair("170", "190"), LintKind::leading_invisible), 1U);
}

// COLREG 1972 Annex I section 7: sRGB's red (0.64, 0.33) and the yellow drawn for it lie outside their regions.
TEST(Lint, ColoursOutsideTheirColregRegionAreToldOnce) {
    const std::string red = light("\"character\": \"F R\"");
    EXPECT_EQ(count(red, LintKind::chromaticity), 1U);
    EXPECT_EQ(
        count(red + "," + light("\"lat\": 56, \"lon\": 11, \"character\": \"F R\""), LintKind::chromaticity),
        1U);
    EXPECT_EQ(count(light("\"character\": \"F Y\""), LintKind::chromaticity), 1U);
    EXPECT_EQ(count(light("\"character\": \"F W\"") + "," + light("\"character\": \"F G\""),
                    LintKind::chromaticity),
              0U);
}

}  // namespace
}  // namespace seaglare::lightdb
