// Phases written out: the three spellings, how they take the place of assumed ones, and that a list which misses its period is
// reported and stays as it is.
#include <gtest/gtest.h>

#include "lightdb/character.h"
#include "lightdb/json/value.h"

namespace seaglare::lightdb {
namespace {

using Phases = std::vector<ListedPhase>;

TEST(CharacterPhases, TheThreeSpellingsSayTheSame) {
    const Phases wanted{{0.8, true, {}, 1}, {2.2, false, {}, 1}, {0.8, true, {}, 1}, {5.2, false, {}, 1}};
    EXPECT_EQ(parse_phase_list("fl. 0.8s, ec. 2.2s, fl. 0.8s, ec. 5.2s"), wanted);
    EXPECT_EQ(parse_phase_list("fl 0.8s ec 2.2s\nlt. 0.8s\nec. 5.2s\n"), wanted);
    EXPECT_EQ(parse_sigseq("00.8+(02.2)+00.8+(05.2)"), wanted);  // the example of S-57 Appendix A, SIGSEQ
    EXPECT_EQ(parse_phase_list(R"([{"lit": 0.8}, {"eclipse": 2.2}, {"lit": 0.8}, {"eclipse": 5.2}])"),
              wanted);
}

// Phases are sums of thirds and elevenths: the period is what is written all the same.
TEST(CharacterPhases, AssumedPhasesSumToThePeriodToTheLastBit) {
    for (const char* light :
         {"Oc(2)", "Oc(2+1)", "Fl(2)", "Fl(3+1)", "IQ", "IVQ", "Mo(AB)", "Mo(SOS)", "Q(9)"})
        for (const double period_s : {15.0, 12.5, 20.0, 7.5, 33.3}) {
            const std::string text = std::string(light) + " " + std::to_string(period_s) + "s";
            EXPECT_EQ(parse_character(text).rhythm.period_s, period_s) << text;
        }
}

// S-57 SIGSEQ: for occulting lights the eclipse stands first.
TEST(CharacterPhases, OccultingSequencesMayBeginDark) {
    const Character c = parse_character("Oc(2)W 9s", parse_sigseq("(00.8)+02.2+(00.8)+05.2"));
    ASSERT_EQ(c.rhythm.phases.size(), 4U);
    EXPECT_FALSE(c.rhythm.phases[0].lit);
    EXPECT_DOUBLE_EQ(c.rhythm.phases[3].duration_s, 5.2);
    EXPECT_NEAR(c.rhythm.period_s, 9, 1e-12);
    EXPECT_TRUE(c.warnings.empty());
}

TEST(CharacterPhases, GivenPhasesTakeThePlaceOfAssumedOnes) {
    const Character assumed = parse_character("Fl W 3s");
    EXPECT_DOUBLE_EQ(assumed.rhythm.phases[0].duration_s, 0.5);
    EXPECT_EQ(assumed.assumptions.size(), 1U);
    const Character given = parse_character("Fl W 3s", parse_sigseq("00.8+(02.2)"));
    EXPECT_DOUBLE_EQ(given.rhythm.phases[0].duration_s, 0.8);
    EXPECT_DOUBLE_EQ(given.rhythm.phases[1].duration_s, 2.2);
    EXPECT_TRUE(given.assumptions.empty());
    EXPECT_TRUE(given.warnings.empty());
    // They take the place of written ones, too; an empty list changes nothing.
    EXPECT_DOUBLE_EQ(
        parse_character("Fl W 3s fl. 1s, ec. 2s", parse_sigseq("00.8+(02.2)")).rhythm.phases[0].duration_s,
        0.8);
    EXPECT_DOUBLE_EQ(parse_character("Fl W 3s fl. 1s, ec. 2s", Phases{}).rhythm.phases[0].duration_s, 1);
}

TEST(CharacterPhases, AListThatMissesItsPeriodIsReportedAndNeverRepaired) {
    for (const char* list : {"fl. 0.8s, ec. 2.0s", "fl. 0.8s, ec. 2.19s", "fl. 0.8s, ec. 2.3s"}) {
        SCOPED_TRACE(list);
        const Phases given = parse_phase_list(list);
        const Character c = parse_character("Fl W 3s", given);
        ASSERT_EQ(c.warnings.size(), 1U);
        EXPECT_NE(c.warnings[0].find("the period is 3 s"), std::string::npos);
        ASSERT_EQ(c.written_phases.size(), 2U);
        ASSERT_GE(c.rhythm.phases.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(c.written_phases[i].duration_s, given[i].duration_s);
            EXPECT_EQ(c.rhythm.phases[i].duration_s, given[i].duration_s);
        }
        EXPECT_EQ(parse_character(format_character(c)).warnings, c.warnings);
    }
    // Tenths add up in decimal, if not in binary: no contradiction.
    EXPECT_TRUE(parse_character("Fl(3)W 1.8s fl. 0.1s, ec. 0.2s, fl. 0.1s, ec. 0.2s, fl. 0.1s, ec. 1.1s")
                    .warnings.empty());
}

TEST(CharacterPhases, JsonPhasesSayColoursAndLevels) {
    const Character c = parse_character(
        "Al WR 4s",
        parse_phase_list(R"([{"lit": 1, "colour": "R"}, {"lit": 3, "colour": "W", "level": 0.5}])"));
    EXPECT_EQ(c.rhythm.phases[0].colour, Colour::red);
    EXPECT_EQ(c.rhythm.phases[1].colour, Colour::white);
    EXPECT_DOUBLE_EQ(c.rhythm.phases[1].level, 0.5);
    EXPECT_TRUE(c.warnings.empty());
    EXPECT_EQ(parse_character("Fl W 4s", parse_phase_list(R"([{"lit": 1, "colour": "G"}, {"eclipse": 3}])"))
                  .warnings.size(),
              1U)
        << "the character names no green";
}

TEST(CharacterPhases, PhasesThatContradictTheClassAreReported) {
    EXPECT_EQ(parse_character("Fl(2)W 3s", parse_sigseq("00.8+(02.2)")).warnings.size(), 1U);
    EXPECT_EQ(parse_character("Iso W 3s", parse_sigseq("00.8+(02.2)")).warnings.size(), 1U);
    EXPECT_EQ(parse_character("Oc W 3s", parse_sigseq("00.8+(02.2)")).warnings.size(), 1U);
    EXPECT_EQ(parse_character("LFl W 3s", parse_sigseq("00.8+(02.2)")).warnings.size(), 1U);
    EXPECT_EQ(parse_character("F W", parse_sigseq("00.8+(02.2)")).warnings.size(), 1U);
}

TEST(CharacterPhases, WhatIsNoListIsRefusedWhereItStands) {
    struct Bad {
        const char* text;
        std::size_t offset;
    };
    for (const Bad& bad :
         {Bad{"", 0}, Bad{"fl. 0.8s, 2.2s", 10}, Bad{"fl. 0.8", 7}, Bad{"fl. 0s", 0}, Bad{"Fl. 1s", 0}}) {
        try {
            parse_phase_list(bad.text);
            ADD_FAILURE() << bad.text;
        } catch (const CharacterError& error) {
            EXPECT_EQ(error.offset, bad.offset) << bad.text;
        }
    }
    for (const Bad& bad : {Bad{"", 0}, Bad{"00.8+", 5}, Bad{"00.8+(02.2", 10}, Bad{"00.8 02.2", 5},
                           Bad{"(0)", 0}, Bad{"-1", 0}, Bad{"00.8+(02.2)x", 11}}) {
        try {
            parse_sigseq(bad.text);
            ADD_FAILURE() << bad.text;
        } catch (const CharacterError& error) {
            EXPECT_EQ(error.offset, bad.offset) << bad.text;
        }
    }
    for (const char* text :
         {"[]", "[1]", R"([{"lit": 1, "eclipse": 1}])", R"([{"lit": 0}])",
          R"([{"lit": 1, "colour": "pink"}])", R"([{"lit": 1, "lenght": 1}])", "[{\"lit\": 1}"}) {
        EXPECT_THROW(parse_phase_list(text), json::Error) << text;
    }
}

}  // namespace
}  // namespace seaglare::lightdb
