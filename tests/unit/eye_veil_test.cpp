// Lids and lashes before the pupil: where they hang, what they cover, and the light that they leave.
#include "glare/eye/veil.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/eye/aperture.h"
#include "glare/psf/cpu_aperture.h"

namespace seaglare::glare {
namespace {

constexpr int n = 1024;
constexpr double plane_width_mm = 9;

EyeInstant open_pupil(double pupil_mm, double lid_closure = 0) {
    EyeInstant instant;
    instant.pupil_mm = pupil_mm;
    instant.lid_closure = lid_closure;
    return instant;
}

EyeModel bare_eye() {
    return circular_pupil_eye();
}

// Sum of P^2 of the aperture as the plain source draws it, over the open pupil's.
double drawn_fraction(const EyeModel& eye, const EyeInstant& instant, std::uint64_t seed) {
    std::vector<Quad> quads;
    Veil(eye, seed).place(instant, quads);
    to_samples(quads, n, plane_width_mm);
    const double radius = instant.pupil_mm / 2 / plane_width_mm * n;
    std::vector<float> amplitude = draw_pupil(n, radius);
    cover(amplitude, n, quads);
    double sum = 0;
    for (const float a : amplitude)
        sum += static_cast<double>(a);
    return sum / (std::numbers::pi * radius * radius);
}

TEST(EyeVeil, AnEyeWithoutLashesWhoseLidsAreOpenHasNoneAtAnyPupil) {
    std::vector<Quad> quads;
    for (double pupil_mm = 1.5; pupil_mm <= 8.5; pupil_mm += 0.5) {
        Veil(young_eye(), 3).place(open_pupil(pupil_mm), quads);
        EXPECT_TRUE(quads.empty()) << pupil_mm;
    }
}

TEST(EyeVeil, WithoutAVeilTheLightThatPassesIsThatOfTheGratings) {
    const EyeModel eye = young_eye();
    for (double pupil_mm : {3.0, 6.5, 8.0})
        EXPECT_EQ(transmitted_fraction(eye, open_pupil(pupil_mm), {}), transmitted_fraction(eye, pupil_mm));
}

// The gratings' ring worked over lines is the closed form of the ring's area.
TEST(EyeVeil, AStrainedLensHasItsRingWhereTheStrainPutsIt) {
    const EyeModel eye = young_eye();
    EyeInstant instant = open_pupil(8);
    instant.lens_scale = 0.95;
    EyeModel scaled = eye;
    scaled.gratings.inner_radius_mm *= 0.95;
    scaled.gratings.outer_radius_mm *= 0.95;
    EXPECT_NEAR(transmitted_fraction(eye, instant, {}), transmitted_fraction(scaled, 8), 2e-5);
}

TEST(EyeVeil, AHalfShutLidTakesHalfOfTheLight) {
    EyeModel eye = bare_eye();
    eye.lids.edge_radius_mm = 1e9;
    std::vector<Quad> quads;
    // The upper margin goes from 4.5 mm above the centre to 5 mm below it less the lower lid's share.
    const EyeInstant instant = open_pupil(6, 4.5 / (9.5 * 0.95));
    Veil(eye, 1).place(instant, quads);
    EXPECT_NEAR(upper_margin_mm(eye.lids, instant.lid_closure, 0), 0, 1e-12);
    EXPECT_NEAR(transmitted_fraction(eye, instant, quads), 0.5, 1e-4);
    eye.lids.edge_radius_mm = 12;
    Veil(eye, 1).place(open_pupil(6, 0.5), quads);
    EXPECT_NEAR(transmitted_fraction(eye, open_pupil(6, 0.5), quads), 0.45, 0.06);
}

// A chord at height h leaves of a disc of radius r: (acos(-h/r) + h/r sqrt(1 - h^2/r^2)) / pi.
TEST(EyeVeil, AStraightMarginLeavesTheSegmentBelowIt) {
    EyeModel eye = bare_eye();
    eye.lids.edge_radius_mm = 1e9;
    std::vector<Quad> quads;
    for (double closure = 0.2; closure < 0.75; closure += 0.05) {
        const EyeInstant instant = open_pupil(6, closure);
        Veil(eye, 1).place(instant, quads);
        const double h = std::clamp(upper_margin_mm(eye.lids, closure, 0) / 3, -1.0, 1.0);
        const double left = (std::acos(-h) + h * std::sqrt(1 - h * h)) / std::numbers::pi;
        EXPECT_NEAR(transmitted_fraction(eye, instant, quads), left, 2e-4) << closure;
    }
}

TEST(EyeVeil, LightFallsWithoutAJumpFromAllToNoneAsTheLidsShut) {
    EyeModel eye = bare_eye();
    eye.eyelashes.count = 6;
    std::vector<Quad> quads;
    double last = -1;
    for (int i = 0; i <= 400; ++i) {
        const EyeInstant instant = open_pupil(7, i / 400.0);
        Veil(eye, 5).place(instant, quads);
        EXPECT_LE(quads.size(), Veil(eye, 5).capacity());
        const double passed = transmitted_fraction(eye, instant, quads);
        if (last >= 0) {
            EXPECT_LT(std::abs(passed - last), 0.01) << i;
        }
        last = passed;
    }
    EXPECT_EQ(last, 0);
}

// What is drawn is what is counted.
TEST(EyeVeil, TheLightThatIsCountedIsThatOfTheDrawnAperture) {
    EyeModel eye = bare_eye();
    eye.eyelashes.count = 8;
    for (std::uint64_t seed : {1U, 2U, 3U}) {
        for (double closure : {0.0, 0.3, 0.55}) {
            const EyeInstant instant = open_pupil(7, closure);
            std::vector<Quad> quads;
            Veil(eye, seed).place(instant, quads);
            const double counted = transmitted_fraction(eye, instant, quads);
            EXPECT_NEAR(drawn_fraction(eye, instant, seed), counted, 0.0015) << seed << ", " << closure;
            EXPECT_LT(counted, 0.995);
            EXPECT_GT(counted, 0.1);
        }
    }
}

// Area of a straight tapered line: length times its mean width.
TEST(EyeVeil, OneLashCoversItsLengthTimesItsMeanWidth) {
    EyeModel eye = bare_eye();
    eye.eyelashes = {1, 0, 0, 100, 4, 0};
    eye.lids.upper_margin_mm = 2;
    eye.lids.edge_radius_mm = 1e9;
    eye.lids.lower_margin_mm = 7;
    std::vector<Quad> quads;
    const EyeInstant instant = open_pupil(8.5);
    Veil(eye, 4).place(instant, quads);
    EyeModel lid_alone = eye;
    lid_alone.eyelashes.count = 0;
    std::vector<Quad> lid;
    Veil(lid_alone, 4).place(instant, lid);
    const double taken = transmitted_fraction(eye, instant, lid) - transmitted_fraction(eye, instant, quads);
    EXPECT_NEAR(taken * std::numbers::pi * 4.25 * 4.25, 4 * 0.1 * 0.55, 0.002);
}

TEST(EyeVeil, LashesHangAtTheAnglesThatTheyAreGiven) {
    EyeModel eye = bare_eye();
    eye.eyelashes.count = 64;
    eye.eyelashes.curvature_per_mm = 0;
    eye.eyelashes.spread_deg = 20;
    double sum = 0;
    double squares = 0;
    int count = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::vector<Quad> quads;
        Veil(eye, seed).place(open_pupil(8), quads);
        for (const Quad& q : quads) {
            const double dx = static_cast<double>(q.xy[4] + q.xy[6] - q.xy[0] - q.xy[2]) / 2;
            const double dy = static_cast<double>(q.xy[5] + q.xy[7] - q.xy[1] - q.xy[3]) / 2;
            const double angle_deg = std::atan2(dx, -dy) * 180 / std::numbers::pi;
            EXPECT_LT(std::abs(angle_deg), 80);
            sum += angle_deg;
            squares += angle_deg * angle_deg;
            ++count;
        }
    }
    EXPECT_NEAR(sum / count, 0, 2);
    EXPECT_NEAR(std::sqrt(squares / count), 20, 2);
}

TEST(EyeVeil, AnotherSeedHasOtherLashesAndTheSameSeedTheSame) {
    EyeModel eye = bare_eye();
    eye.eyelashes.count = 5;
    const auto lashes = [&](std::uint64_t seed) {
        std::vector<Quad> quads;
        Veil(eye, seed).place(open_pupil(7), quads);
        std::vector<float> all;
        for (const Quad& q : quads)
            all.insert(all.end(), q.xy.begin(), q.xy.end());
        return all;
    };
    EXPECT_EQ(lashes(9), lashes(9));
    EXPECT_NE(lashes(9), lashes(10));
    const auto first = lashes(9);
    eye.eyelashes.seed = 1;
    EXPECT_NE(lashes(9), first);
}

TEST(EyeVeil, StrangeLidsAndLashesAreFiniteAndBounded) {
    EyeModel eye = bare_eye();
    eye.eyelashes = {8, 90, 90, 5000, 40, 10};
    eye.lids = {0, {}, -5, -5, 1, 0};
    for (double closure : {0.0, 0.5, 1.0}) {
        for (double pupil_mm : {0.1, 3.0, 8.9}) {
            std::vector<Quad> quads;
            const EyeInstant instant = open_pupil(pupil_mm, closure);
            Veil(eye, 2).place(instant, quads);
            for (const Quad& q : quads)
                for (const float v : q.xy)
                    ASSERT_TRUE(std::isfinite(v));
            const double passed = transmitted_fraction(eye, instant, quads);
            EXPECT_GE(passed, 0);
            EXPECT_LE(passed, 1 + 1e-3);
        }
    }
}

// ---- the instant --------------------------------------------------------------------------------------------------

// What does not move must not cost a new table.
TEST(EyeInstant, OfAnEyeAtRestIsTheSameWhateverTheTime) {
    const EyeModel eye = young_eye();
    const EyeInstant first = eye_instant(eye, 6, 0, {}, 0, 1);
    EXPECT_EQ(eye_instant(eye, 6, 1e7, {}, 0, 1), first);
    EXPECT_EQ(eye_instant(eye, 6, std::nan(""), {}, 0, 1), first);
    EXPECT_NE(eye_instant(eye, 6, 0, {0.1, 0}, 0, 1), first);
    EXPECT_NE(eye_instant(eye, 6, 0, {}, 0.1, 1), first);
    EyeModel moving = no_lash_eye();
    EXPECT_NE(eye_instant(moving, 6, 3, {}, 0, 1), eye_instant(moving, 6, 4, {}, 0, 1));
    for (ParticleFamily& family : moving.particles)
        family.site = ParticleSite::cornea;
    EXPECT_EQ(eye_instant(moving, 6, 3, {}, 0.5, 1).vitreous_roll_rad, 0);
}

TEST(EyeInstant, TheLidsLeaveOpenWhatSquintAndBlinkAndStandingClosureAllLeave) {
    EyeModel eye = young_eye();
    eye.lids.closure = 0.5;
    EXPECT_DOUBLE_EQ(eye_instant(eye, 6, 0, {0.5, 0.2}, 0, 1).lid_closure, 1 - 0.5 * 0.5 * 0.8);
    EXPECT_DOUBLE_EQ(eye_instant(eye, 6, 0, {std::nan(""), -3}, 0, 1).lid_closure, 0.5);
}

TEST(EyeInstant, AccommodationStrainsTheLensAndMovesTheFocusOnlyWhereTheEyeSaysSo) {
    EyeModel eye = no_lash_eye();
    const EyeInstant strained = eye_instant(eye, 7, 12.3, {}, 0, 1);
    EXPECT_NE(strained.lens_scale, 1);
    EXPECT_NEAR(strained.lens_scale, 1, 0.25 * 0.004);
    EXPECT_EQ(strained.defocus_dioptre, 0);
    eye.accommodation_moves_focus = true;
    EXPECT_NE(eye_instant(eye, 7, 12.3, {}, 0, 1).defocus_dioptre, 0);
}

// ---- parts that move ----------------------------------------------------------------------------------------------

TEST(EyeParts, EachFamilyMovesWithWhatCarriesItAndWithNothingElse) {
    EyeModel eye;
    eye.particles = {{1, 10, 10, 2, 3, 0, 10, ParticleSite::cornea},
                     {1, 10, 10, 2, 3, 0, 10, ParticleSite::lens},
                     {1, 10, 10, 2, 3, 0, 10, ParticleSite::vitreous}};
    const ApertureParts parts(eye, 5);
    EyeInstant instant = open_pupil(6);
    std::vector<Disc> rest;
    std::vector<Disc> moved;
    parts.place(instant, n, plane_width_mm, rest);
    instant.lens_scale = 0.9;
    instant.vitreous_roll_rad = std::numbers::pi / 2;
    parts.place(instant, n, plane_width_mm, moved);
    const auto from_axis = [](const Disc& d) { return std::pair(d.x - n / 2.0F, d.y - n / 2.0F); };
    EXPECT_EQ(from_axis(moved[0]), from_axis(rest[0]));
    EXPECT_NEAR(from_axis(moved[1]).first, 0.9F * from_axis(rest[1]).first, 1e-3F);
    EXPECT_NEAR(from_axis(moved[1]).second, 0.9F * from_axis(rest[1]).second, 1e-3F);
    EXPECT_NEAR(from_axis(moved[2]).first, -from_axis(rest[2]).second, 1e-3F);
    EXPECT_NEAR(from_axis(moved[2]).second, from_axis(rest[2]).first, 1e-3F);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(moved[i].radius, rest[i].radius);
}

TEST(EyeParts, AStrainedLensTakesItsGratingsWithIt) {
    const ApertureParts parts(young_eye(), 1);
    const GratingShape rest = parts.gratings(n, plane_width_mm);
    const GratingShape strained = parts.gratings(n, plane_width_mm, 0.95);
    EXPECT_FLOAT_EQ(strained.inner_radius, 0.95F * rest.inner_radius);
    EXPECT_FLOAT_EQ(strained.outer_radius, 0.95F * rest.outer_radius);
    EXPECT_EQ(strained.count, rest.count);
}

// Watson & Yellott 2012: D + (y - 28.58)(0.02132 - 0.009562 D), worked by hand for 7 mm and 60 years.
TEST(EyePupil, ShrinksWithAgeAsWatsonAndYellottHaveIt) {
    EXPECT_NEAR(aged_pupil_diameter_mm(7, 60), 7 + 31.42 * (0.02132 - 0.066934), 1e-9);
    EXPECT_DOUBLE_EQ(aged_pupil_diameter_mm(7, 28.58), 7);
    EXPECT_EQ(aged_pupil_diameter_mm(7, 95), aged_pupil_diameter_mm(7, 83));
    EXPECT_EQ(aged_pupil_diameter_mm(7, 5), aged_pupil_diameter_mm(7, 20));
    EyeModel eye = young_eye();
    eye.hippus_amplitude_mm = 0;
    eye.age_years = 70;
    const double as_young = pupil_diameter_mm(eye, 0.001, 0, 1);
    eye.pupil_shrinks_with_age = true;
    EXPECT_EQ(pupil_diameter_mm(eye, 0.001, 0, 1), aged_pupil_diameter_mm(as_young, 70));
    eye.fixed_pupil_mm = 5;
    EXPECT_EQ(pupil_diameter_mm(eye, 0.001, 0, 1), 5);
}

}  // namespace
}  // namespace seaglare::glare
