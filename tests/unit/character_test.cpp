#include "lightdb/character.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace seaglare::lightdb {
namespace {

// "0.5 (1) 0.5 (4)": light, and darkness in brackets.
std::string shape(const Character& character) {
    std::string text;
    for (const Phase& phase : character.rhythm.phases) {
        char figure[32];
        std::snprintf(figure, sizeof figure, "%.4g", phase.duration_s);
        text +=
            (text.empty() ? "" : " ") + (phase.lit ? std::string(figure) : "(" + std::string(figure) + ")");
    }
    return text;
}

std::string colours(const Character& character) {
    std::string text;
    for (const Colour colour : character.colours)
        text += colour_letter(colour);
    return text;
}

struct Row {
    const char* text;
    const char* light_class;
    const char* colours;
    double period_s;
    const char* shape;
};

// One row per class of INT 1 section P 10, and per spelling.
const Row rows[] = {
    {"F", "F", "W", 0, ""},
    {"F.R.\n", "F", "R", 0, ""},
    {"Oc WRG 6s", "Oc", "WRG", 6, "5 (1)"},
    {"Oc.W.\nperiod 8s \nfl. 5.0s, ec. 3.0s \n", "Oc", "W", 8, "5 (3)"},
    {"Oc(2)W 8s", "Oc(2)", "W", 8, "5 (1) 1 (1)"},
    {"Oc(2+1)G 20s", "Oc(2+1)", "G", 20, "9 (1) 2 (1) 6 (1)"},
    {"IsoWRG4s", "Iso", "WRG", 4, "2 (2)"},
    {"Iso. W.R.G.\nperiod 2s", "Iso", "WRG", 2, "1 (1)"},
    {"FlR3s", "Fl", "R", 3, "0.5 (2.5)"},
    {"Fl.W. period 5s fl. 1.0s, ec. 4.0s", "Fl", "W", 5, "1 (4)"},
    {"fl w 5s", "Fl", "W", 5, "1 (4)"},
    {"Fl(2)WRG 6s", "Fl(2)", "WRG", 6, "0.5 (1) 0.5 (4)"},
    {"Fl.(2)W.R.G.\nperiod 6s \nfl. 0.5s, ec. 1.0s \nfl. 0.5s, ec. 4.0s \n", "Fl(2)", "WRG", 6,
     "0.5 (1) 0.5 (4)"},
    {"Gp.Fl.(2)R. ev 10s", "Fl(2)", "R", 10, "0.5 (1) 0.5 (8)"},
    {"Fl(2+1)W 10s", "Fl(2+1)", "W", 10, "0.5 (1) 0.5 (3) 0.5 (4.5)"},
    {"LFl.10s", "LFl", "W", 10, "2 (8)"},
    {"L.Fl.W.R.G. period 6s", "LFl", "WRG", 6, "2 (4)"},
    {"L.Fl.(2)W.\nperiod 12s", "LFl(2)", "W", 12, "2 (2) 2 (6)"},
    {"Q", "Q", "W", 1, "0.3 (0.7)"},
    {"Q.Y.", "Q", "Y", 1, "0.3 (0.7)"},
    {"Qk.Fl.G.", "Q", "G", 1, "0.3 (0.7)"},
    {"VQ", "VQ", "W", 0.5, "0.2 (0.3)"},
    {"UQ", "UQ", "W", 0.25, "0.125 (0.125)"},
    {"Q(3)10s", "Q(3)", "W", 10, "0.3 (0.7) 0.3 (0.7) 0.3 (7.7)"},
    {"V.Q.(5)R.\nperiod 6s", "VQ(5)", "R", 6, "0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (3.8)"},
    {"I.V.Q.Y.\nperiod 6s", "IVQ", "Y", 6,
     "0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (2.8)"},
    {"IQ 5s", "IQ", "W", 5, "0.3 (0.7) 0.3 (0.7) 0.3 (2.7)"},
    {"IUQ 1s", "IUQ", "W", 1, "0.125 (0.125) 0.125 (0.625)"},
    {"Q(6)+LFl 15s", "Q(6)+LFl", "W", 15,
     "0.3 (0.7) 0.3 (0.7) 0.3 (0.7) 0.3 (0.7) 0.3 (0.7) 0.3 (0.7) 2 (7)"},
    {"V.Q.(6)+L.Fl.W.\nperiod 10s", "VQ(6)+LFl", "W", 10,
     "0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 0.2 (0.3) 2 (5)"},
    {"Mo(A)W 8s", "Mo(A)", "W", 8, "0.5 (0.5) 1.5 (5.5)"},
    {"Mo.(U) 15s", "Mo(U)", "W", 15, "0.5 (0.5) 0.5 (0.5) 1.5 (11.5)"},
    {"FFl W 10s", "FFl", "W", 10, "1 9"},
    {"F.Fl.(2)W. 15s fl. 1.0s, ec. 1.0s fl. 1.0s, ec. 12.0s", "FFl(2)", "W", 15, "1 1 1 12"},
    {"F.L.Fl.W. 15s", "FLFl", "W", 15, "2 13"},
    {"F & Fl R 5s", "FFl", "R", 5, "1 4"},
    {"AlWR 10s", "Al", "WR", 10, "5 5"},
    {"Al Fl WR 10s", "Al Fl", "WR", 10, "1 (4) 1 (4)"},
    {"Al.Oc.W.G. 8s", "Al Oc", "WG", 8, "3 (1) 3 (1)"},
    {"DirIsoWRG2s", "Dir Iso", "WRG", 2, "1 (1)"},
    {"Dir.W.R.G. period 6s fl. 5.0s, ec. 1.0s", "Dir", "WRG", 6, "5 (1)"},
    {"Aero Q.W.", "Aero Q", "W", 1, "0.3 (0.7)"},
    {"Oc.Or. period 4s", "Oc", "Or", 4, "3 (1)"},
    {"Iso Bu 2s", "Iso", "Bu", 2, "1 (1)"},
};

TEST(Character, EveryClassAndSpellingGivesItsPhases) {
    for (const Row& row : rows) {
        SCOPED_TRACE(row.text);
        const Character character = parse_character(row.text);
        EXPECT_EQ(character.light_class, row.light_class);
        EXPECT_EQ(colours(character), row.colours);
        EXPECT_DOUBLE_EQ(character.rhythm.period_s, row.period_s);
        EXPECT_EQ(shape(character), row.shape);
    }
}

TEST(Character, PhasesSumToThePeriod) {
    for (const Row& row : rows) {
        SCOPED_TRACE(row.text);
        const Character character = parse_character(row.text);
        double sum = 0;
        for (const Phase& phase : character.rhythm.phases) {
            EXPECT_GT(phase.duration_s, 0);
            sum += phase.duration_s;
        }
        EXPECT_NEAR(sum, character.rhythm.period_s, 1e-12);
        if (character.period_s) {
            EXPECT_NEAR(sum, *character.period_s, 1e-9);
        }
    }
}

TEST(Character, WritingAndReadingAgainKeepsTheLight) {
    for (const Row& row : rows) {
        const Character first = parse_character(row.text);
        const std::string text = format_character(first);
        SCOPED_TRACE(text);
        const Character second = parse_character(text);
        EXPECT_EQ(second.light_class, first.light_class);
        EXPECT_EQ(second.colours, first.colours);
        EXPECT_EQ(shape(second), shape(first));
        EXPECT_EQ(format_character(second), text);
    }
}

// S-57 LITCHR: the class bounds, and more darkness than light or the reverse.
TEST(Character, ClassesKeepTheirDefinitions) {
    for (double period_s = 1.5; period_s <= 30; period_s += 0.5) {
        for (const char* light_class : {"Fl", "Fl(2)", "Fl(3)", "Oc", "Oc(2)", "Oc(3)", "Iso", "Mo(A)"}) {
            const Character c =
                parse_character(std::string(light_class) + " " + std::to_string(period_s) + "s");
            SCOPED_TRACE(format_character(c));
            double lit = 0;
            double dark = 0;
            double longest_inner = 0;
            for (std::size_t i = 0; i < c.rhythm.phases.size(); ++i) {
                const Phase& phase = c.rhythm.phases[i];
                (phase.lit ? lit : dark) += phase.duration_s;
                if (!phase.lit && i + 1 < c.rhythm.phases.size())
                    longest_inner = std::max(longest_inner, phase.duration_s);
            }
            EXPECT_NEAR(lit + dark, period_s, 1e-9);
            switch (light_class[0]) {
                case 'F':
                    EXPECT_LT(lit, dark);
                    EXPECT_GT(c.rhythm.phases.back().duration_s, longest_inner) << "a group must have an end";
                    break;
                case 'O':
                    EXPECT_GT(lit, dark);
                    break;
                case 'I':
                    EXPECT_DOUBLE_EQ(lit, dark);
                    break;
                default:
                    break;
            }
        }
    }
}

TEST(Character, QuickGroupsThatFillTheirPeriodFlashFasterWithinTheirClass) {
    const Character c = parse_character("Q(5) 5s");
    const double pitch_s = c.rhythm.phases[0].duration_s + c.rhythm.phases[1].duration_s;
    EXPECT_GE(60 / pitch_s, 50);
    EXPECT_LT(60 / pitch_s, 79.5);
    EXPECT_GT(c.rhythm.phases.back().duration_s, 1.5 * c.rhythm.phases[1].duration_s);
    EXPECT_THROW(parse_character("Q(20) 3s"), CharacterError);
}

TEST(Character, ColoursHeightAndRangesStandInAnyPlace) {
    for (const char* text :
         {"Fl(2+1)WRG.10s15m12-9M", "Fl(2+1) 10s WRG 12-9M 15m", "WRG Fl(2+1) 15 m 10 s 12-9 M"}) {
        SCOPED_TRACE(text);
        const Character c = parse_character(text);
        EXPECT_EQ(c.light_class, "Fl(2+1)");
        EXPECT_EQ(colours(c), "WRG");
        EXPECT_DOUBLE_EQ(c.height_m.value(), 15);
        ASSERT_EQ(c.range_nm.size(), 2U);
        EXPECT_FALSE(c.range_nm[0].first.has_value());
        EXPECT_DOUBLE_EQ(c.range_nm[0].second, 12);
        EXPECT_DOUBLE_EQ(c.range_nm[1].second, 9);
    }
    EXPECT_DOUBLE_EQ(parse_character("Fl 5s 100ft").height_m.value(), 30.48);
}

TEST(Character, RangesWithSlashesBelongToTheColoursInOrder) {
    const Character c = parse_character("Fl WRG 5s 12/10/8M");
    ASSERT_EQ(c.range_nm.size(), 3U);
    EXPECT_EQ(c.range_nm[1].first, Colour::red);
    EXPECT_DOUBLE_EQ(c.range_nm[1].second, 10);
    EXPECT_THROW(parse_character("Fl WRG 5s 12/10M"), CharacterError);
    EXPECT_EQ(parse_character("Fl R 5s 7M").range_nm[0].first, Colour::red);
}

TEST(Character, MilesAreCapitalAndMetresSmall) {
    const Character c = parse_character("Iso G 2s 4m 3M");
    EXPECT_DOUBLE_EQ(c.height_m.value(), 4);
    EXPECT_DOUBLE_EQ(c.range_nm[0].second, 3);
}

TEST(Character, WrittenDurationsOverrideAssumedOnes) {
    const Character c = parse_character("Fl.W. period 3s fl. 0.8s, ec. 2.2s");
    EXPECT_EQ(shape(c), "0.8 (2.2)");
    EXPECT_TRUE(c.assumptions.empty());
    EXPECT_TRUE(c.warnings.empty());
    EXPECT_FALSE(parse_character("Fl W 3s").assumptions.empty());
}

// NGA Pub. 116 no. 6660: the durations add up to 8 s, the period is 10 s.
TEST(Character, AListThatMissesItsPeriodIsReportedAndKeptAsWritten) {
    const char* text =
        "Fl.(3)W.R.\nperiod 10s \nfl. 0.5s, ec. 1.5s \nfl. 0.5s, ec. 1.5s \nfl. 0.5s, ec. 3.5s \n";
    const Character c = parse_character(text);
    ASSERT_EQ(c.warnings.size(), 1U);
    EXPECT_NE(c.warnings[0].find("add up to 8 s, the period is 10 s"), std::string::npos);
    EXPECT_DOUBLE_EQ(c.rhythm.period_s, 10);
    EXPECT_DOUBLE_EQ(c.written_phases.back().duration_s, 3.5);
    EXPECT_EQ(parse_character(format_character(c)).warnings.size(), 1U) << "writing must not repair it";
    const Character too_long = parse_character("Fl R 3s fl. 1s, ec. 4s");
    EXPECT_DOUBLE_EQ(too_long.rhythm.period_s, 5);
    EXPECT_EQ(too_long.warnings.size(), 1U);
}

// No. 17663: two flashes by the class, one by the durations.
TEST(Character, AGroupThatContradictsItsDurationsIsReported) {
    const Character c = parse_character("Fl.(2)W.\nperiod 20s \nfl. 1.0s, ec. 15.0s \n");
    EXPECT_EQ(c.warnings.size(), 2U);
}

TEST(Character, AlternatingLightsChangeColourFromFlashToFlash) {
    const Character even = parse_character("Al Fl WR 10s");
    EXPECT_EQ(even.rhythm.phases[0].colour, Colour::white);
    EXPECT_EQ(even.rhythm.phases[2].colour, Colour::red);
    const Character odd = parse_character("Al Fl(3) WR 15s");
    EXPECT_DOUBLE_EQ(odd.rhythm.period_s, 30) << "three flashes of two colours come round after two periods";
    EXPECT_EQ(odd.rhythm.phases[6].colour, Colour::red);
}

TEST(Character, FixedAndFlashingIsNeverDark) {
    for (const Phase& phase : parse_character("FFl(2) W 15s").rhythm.phases) {
        EXPECT_TRUE(phase.lit);
        EXPECT_TRUE(phase.level == 1 || phase.level == 0.1);
    }
}

TEST(Character, LampsAndTheirArrangementAreCounted) {
    EXPECT_EQ(parse_character("2 F.R. (vert.)").lamp_count, 2);
    EXPECT_EQ(parse_character("2 F.R. (vert.)").arrangement, "vert");
    EXPECT_EQ(parse_character("F.R.W. (vert.)").lamp_count, 2);
    EXPECT_EQ(parse_character("3 Fl.W. (vert.)\nperiod 1.5s").lamp_count, 3);
    EXPECT_EQ(parse_character("F.G. (neon)").lamp_count, 1);
}

TEST(Character, WhatTheNotationLeavesOpenIsStated) {
    EXPECT_EQ(parse_character("Fl").assumptions.size(), 3U);  // colour, period, length of the flash
    EXPECT_FALSE(parse_character("Dir WRG 4s").assumptions.empty());
    EXPECT_TRUE(parse_character("Iso W 4s").assumptions.empty());
}

TEST(Character, WhatBelongsToNoLightIsRefusedWhereItStands) {
    struct Bad {
        const char* text;
        std::size_t offset;
    };
    for (const Bad& bad : {Bad{"", 0}, Bad{"Xy 10s", 0}, Bad{"Fl 10", 3}, Bad{"Fl(2)(3)", 5}, Bad{"F(2)", 1},
                           Bad{"Q(6)+", 5}, Bad{"Fl(2 5s", 2}, Bad{"F.R., F.G.", 6}, Bad{"Fl R -3s", 5},
                           Bad{"Fl R 0s", 5}, Bad{"Fl R 3s 4s", 8}, Bad{"Fl R 3s 99M", 8}, Bad{"Fl(0) 3s", 2},
                           Bad{"Fl R nan s", 5}, Bad{"Fl R 1e400s", 5}}) {
        SCOPED_TRACE(bad.text);
        try {
            parse_character(bad.text);
            ADD_FAILURE() << "was accepted";
        } catch (const CharacterError& error) {
            EXPECT_EQ(error.offset, bad.offset) << error.what();
        }
    }
}

}  // namespace
}  // namespace seaglare::lightdb
