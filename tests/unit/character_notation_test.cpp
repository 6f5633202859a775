// Every class and form of IHO INT 1 section P, of the NGA List of Lights and of the older English lists, as one table: what the
// notation says, taken apart.
#include <gtest/gtest.h>

#include <cstdio>

#include "lightdb/character.h"

namespace seaglare::lightdb {
namespace {

std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string colours(const Character& character) {
    std::string text;
    for (const Colour colour : character.colours)
        text += colour_letter(colour);
    return text;
}

// "W12 R8" per colour, "12-9" without.
std::string ranges(const Character& character) {
    std::string text;
    for (const auto& [colour, range_nm] : character.range_nm) {
        if (!text.empty()) text += colour ? " " : "-";
        text += (colour ? std::string(colour_letter(*colour)) : "") + figure(range_nm);
    }
    return text;
}

// "R0.5 (1)": colour and length of light, and darkness in brackets; a weak light with a star.
std::string phases(const Character& character) {
    std::string text;
    for (const Phase& phase : character.rhythm.phases) {
        text += text.empty() ? "" : " ";
        text += phase.lit ? std::string(colour_letter(phase.colour)) + figure(phase.duration_s)
                          : "(" + figure(phase.duration_s) + ")";
        if (phase.level != 1) text += "*";
    }
    return text;
}

struct Row {
    const char* text;
    const char* light_class;
    const char* group;  // as S-57 SIGGRP
    const char* colours;
    double period_s;
    double height_m;  // 0: none
    const char* ranges;
    const char* phases;
};

void expect_row(const Row& row, bool old_form) {
    SCOPED_TRACE(row.text);
    Character c;
    try {
        c = parse_character(row.text);
    } catch (const CharacterError& error) {
        ADD_FAILURE() << "at " << error.offset << ": " << error.what();
        return;
    }
    EXPECT_EQ(c.light_class, row.light_class);
    EXPECT_EQ(group_text(c), row.group);
    EXPECT_EQ(colours(c), row.colours);
    EXPECT_DOUBLE_EQ(c.rhythm.period_s, row.period_s);
    EXPECT_NEAR(c.height_m.value_or(0), row.height_m, 1e-9);
    EXPECT_EQ(ranges(c), row.ranges);
    EXPECT_EQ(phases(c), row.phases);
    bool says_old = false;
    for (const std::string& warning : c.warnings)
        says_old = says_old || warning.find("is an old form") != std::string::npos;
    EXPECT_EQ(says_old, old_form);
    if (!old_form) {
        EXPECT_TRUE(c.warnings.empty()) << c.warnings.front();
    }
}

const Row today[] = {
    // INT 1 P 10.1 to 10.11, one class after the other.
    {"F R", "F", "", "R", 0, 0, "", ""},
    {"Oc R 6s", "Oc", "", "R", 6, 0, "", "R5 (1)"},
    {"Oc(2)G 8s", "Oc(2)", "(2)", "G", 8, 0, "", "G5 (1) G1 (1)"},
    {"Oc(2+1)W 20s", "Oc(2+1)", "(2+1)", "W", 20, 0, "", "W9 (1) W2 (1) W6 (1)"},
    {"Iso Y 4s", "Iso", "", "Y", 4, 0, "", "Y2 (2)"},
    {"Fl G 5s", "Fl", "", "G", 5, 0, "", "G1 (4)"},
    {"Fl(3)W 15s", "Fl(3)", "(3)", "W", 15, 0, "", "W0.5 (1) W0.5 (1) W0.5 (11.5)"},
    {"Fl(2+1)R 12s", "Fl(2+1)", "(2+1)", "R", 12, 0, "", "R0.5 (1) R0.5 (3) R0.5 (6.5)"},
    {"Fl(2+1+1)R 20s", "Fl(2+1+1)", "(2+1+1)", "R", 20, 0, "", "R0.5 (1) R0.5 (3) R0.5 (3) R0.5 (11)"},
    {"LFl W 8s", "LFl", "", "W", 8, 0, "", "W2 (6)"},
    {"LFl(2)W 15s", "LFl(2)", "(2)", "W", 15, 0, "", "W2 (2) W2 (9)"},
    {"Q R", "Q", "", "R", 1, 0, "", "R0.3 (0.7)"},
    {"Q(3)W 10s", "Q(3)", "(3)", "W", 10, 0, "", "W0.3 (0.7) W0.3 (0.7) W0.3 (7.7)"},
    {"Q(9) 15s", "Q(9)", "(9)", "W", 15, 0, "",
     "W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (6.7)"},
    {"IQ W 8s", "IQ", "", "W", 8, 0, "", "W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (4.7)"},
    {"VQ G", "VQ", "", "G", 0.5, 0, "", "G0.2 (0.3)"},
    {"VQ(3)W 5s", "VQ(3)", "(3)", "W", 5, 0, "", "W0.2 (0.3) W0.2 (0.3) W0.2 (3.8)"},
    {"IVQ W 3s", "IVQ", "", "W", 3, 0, "", "W0.2 (0.3) W0.2 (0.3) W0.2 (1.8)"},
    {"UQ", "UQ", "", "W", 0.25, 0, "", "W0.125 (0.125)"},
    {"UQ(2) 2s", "UQ(2)", "(2)", "W", 2, 0, "", "W0.1 (0.15) W0.1 (1.65)"},
    {"IUQ Y 2s", "IUQ", "", "Y", 2, 0, "", "Y0.125 (0.125) Y0.125 (0.125) Y0.125 (0.125) Y0.125 (1.125)"},
    {"Mo(K)W 10s", "Mo(K)", "(K)", "W", 10, 0, "", "W1.5 (0.5) W0.5 (0.5) W1.5 (5.5)"},
    {"Mo(SOS) 20s", "Mo(SOS)", "(SOS)", "W", 20, 0, "",
     "W0.5 (0.5) W0.5 (0.5) W0.5 (1.5) W1.5 (0.5) W1.5 (0.5) W1.5 (1.5) W0.5 (0.5) W0.5 (0.5) W0.5 (6.5)"},
    {"Mo(5) 10s", "Mo(5)", "(5)", "W", 10, 0, "", "W0.5 (0.5) W0.5 (0.5) W0.5 (0.5) W0.5 (0.5) W0.5 (5.5)"},
    {"FFl W 10s", "FFl", "", "W", 10, 0, "", "W1 W9*"},
    {"FFl(2)R 10s", "FFl(2)", "(2)", "R", 10, 0, "", "R0.5 R1* R0.5 R8*"},
    {"FLFl G 10s", "FLFl", "", "G", 10, 0, "", "G2 G8*"},
    {"Al WR 6s", "Al", "", "WR", 6, 0, "", "W3 R3"},
    {"Al WRG 6s", "Al", "", "WRG", 6, 0, "", "W2 R2 G2"},
    // Combinations.
    {"Q(6)+LFl 15s", "Q(6)+LFl", "(6)(1)", "W", 15, 0, "",
     "W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W2 (7)"},
    {"VQ(6) + L Fl 10s", "VQ(6)+LFl", "(6)(1)", "W", 10, 0, "",
     "W0.2 (0.3) W0.2 (0.3) W0.2 (0.3) W0.2 (0.3) W0.2 (0.3) W0.2 (0.3) W2 (5)"},
    {"UQ(6)+LFl 10s", "UQ(6)+LFl", "(6)(1)", "W", 10, 0, "",
     "W0.125 (0.125) W0.125 (0.125) W0.125 (0.125) W0.125 (0.125) W0.125 (0.125) W0.125 (0.125) W2 (6.5)"},
    {"Fl+LFl W 12s", "Fl+LFl", "(1)(1)", "W", 12, 0, "", "W0.5 (1) W2 (8.5)"},
    {"FlLFl W 12s", "Fl+LFl", "(1)(1)", "W", 12, 0, "", "W0.5 (1) W2 (8.5)"},  // as OpenSeaMap writes it
    {"Al.Fl.W.R. 10s", "Al Fl", "", "WR", 10, 0, "", "W1 (4) R1 (4)"},
    {"AlFl(2)WR 12s", "Al Fl(2)", "(2)", "WR", 12, 0, "", "W0.5 (1) R0.5 (10)"},
    {"Al Fl(2+1)WR 20s", "Al Fl(2+1)", "(2+1)", "WR", 40, 0, "",
     "W0.5 (1) R0.5 (3) W0.5 (14.5) R0.5 (1) W0.5 (3) R0.5 (14.5)"},
    {"Al.Oc.BuY.3s", "Al Oc", "", "BuY", 3, 0, "",
     "Bu1 (0.5) Y1 (0.5)"},  // IALA O-133: emergency wreck marking
    {"Al.Oc.W.R. 10s", "Al Oc", "", "WR", 10, 0, "", "W4 (1) R4 (1)"},
    {"Al LFl WR 20s", "Al LFl", "", "WR", 20, 0, "", "W2 (8) R2 (8)"},
    {"Al Iso RG 8s", "Al Iso", "", "RG", 8, 0, "", "R2 (2) G2 (2)"},
    {"Al Q WR", "Al Q", "", "WR", 2, 0, "", "W0.3 (0.7) R0.3 (0.7)"},
    {"Al FFl WR 10s", "Al FFl", "", "WR", 10, 0, "", "R1 W4* R1 W4*"},
    // Prefixes, suffixes, several lamps, remarks (INT 1 P 15, P 30, P 50 to 65).
    {"Dir WRG 4s", "Dir", "", "WRG", 4, 0, "", "W2 (2)"},
    {"DirOcWRG10s6M", "Dir Oc", "", "WRG", 10, 0, "6", "W8 (2)"},
    {"Dir Fl W 5s 269.5\xC2\xB0", "Dir Fl", "", "W", 5, 0, "", "W1 (4)"},
    {"Aero Al Fl WG 7.5s 11M", "Aero Al Fl", "", "WG", 7.5, 0, "11", "W1 (2.75) G1 (2.75)"},
    {"AeroFR353m11M", "Aero F", "", "R", 0, 353, "R11", ""},
    {"F&FlW10s", "FFl", "", "W", 10, 0, "", "W1 W9*"},
    {"F & L Fl W 10s", "FLFl", "", "W", 10, 0, "", "W2 W8*"},
    {"2F.R(vert)", "F", "", "R", 0, 0, "", ""},
    {"2 F G (hor) 7m 3M", "F", "", "G", 0, 7, "G3", ""},
    {"Fl R 2s (priv)", "Fl", "", "R", 2, 0, "", "R0.5 (1.5)"},
    {"Iso W 4s (occas)", "Iso", "", "W", 4, 0, "", "W2 (2)"},
    {"Q R (T)", "Q", "", "R", 1, 0, "", "R0.3 (0.7)"},
    // Spaces, dots, typography, order, case.
    {"Fl(2+1)WRG.10s15m12-9M", "Fl(2+1)", "(2+1)", "WRG", 10, 15, "12-9", "W0.5 (1) W0.5 (3) W0.5 (4.5)"},
    {"FL (2+1) W.R.G. 10 sec 15 m 12 - 9 M", "Fl(2+1)", "(2+1)", "WRG", 10, 15, "12-9",
     "W0.5 (1) W0.5 (3) W0.5 (4.5)"},
    {"Fl.(3)W.R.G.\nperiod 10s \n", "Fl(3)", "(3)", "WRG", 10, 0, "", "W0.5 (1) W0.5 (1) W0.5 (6.5)"},
    {"L.Fl.W.\nperiod 9s \nfl. 3.0s, ec. 6.0s", "LFl", "", "W", 9, 0, "", "W3 (6)"},
    {"GRW Iso 4s", "Iso", "", "GRW", 4, 0, "", "G2 (2)"},
    {"Fl W 7\xC2\xB7"
     "5s 12\xE2\x80\x93"
     "9M",
     "Fl", "", "W", 7.5, 0, "12-9", "W1 (6.5)"},
    {"Iso Bu 2s", "Iso", "", "Bu", 2, 0, "", "Bu1 (1)"},
    {"Iso Vi 2s", "Iso", "", "Vi", 2, 0, "", "Vi1 (1)"},
    {"Iso Or 2s", "Iso", "", "Or", 2, 0, "", "Or1 (1)"},
    {"Iso Am 2s", "Iso", "", "Y", 2, 0, "", "Y1 (1)"},
    {"fl green 3s", "Fl", "", "G", 3, 0, "", "G0.5 (2.5)"},
    // Heights and ranges.
    {"Fl W 5s 100ft 15M", "Fl", "", "W", 5, 30.48, "W15", "W1 (4)"},
    {"Fl W 5s 33 feet", "Fl", "", "W", 5, 10.0584, "", "W1 (4)"},
    {"Oc WRG 6s 12/10/8M", "Oc", "", "WRG", 6, 0, "W12 R10 G8", "W5 (1)"},
    {"Oc WRG 6s 12 / 10 / 8 M", "Oc", "", "WRG", 6, 0, "W12 R10 G8", "W5 (1)"},
    {"Oc WRG 6s 15m W 12 R 8 G 8", "Oc", "", "WRG", 6, 15, "W12 R8 G8", "W5 (1)"},
    {"OcWRG6sW12M,R8M,G8M", "Oc", "", "WRG", 6, 0, "W12 R8 G8", "W5 (1)"},
    {"Oc 6s W. 12 R. 8 G. 8 M", "Oc", "", "WRG", 6, 0, "W12 R8 G8", "W5 (1)"},
    {"Oc WRG 6s W12/R8/G8M", "Oc", "", "WRG", 6, 0, "W12 R8 G8", "W5 (1)"},
    {"Oc WRG 6s G 8 W 12 R 9", "Oc", "", "WRG", 6, 0, "G8 W12 R9", "W5 (1)"},
    {"Oc WR 6s R 8M", "Oc", "", "WR", 6, 0, "R8", "W5 (1)"},
    {"Oc WR 6s 8-11M", "Oc", "", "WR", 6, 0, "11-8", "W5 (1)"},
    {"Oc WR 6s 11.5M", "Oc", "", "WR", 6, 0, "11.5", "W5 (1)"},
    {"Oc R 6s 8 nm", "Oc", "", "R", 6, 0, "R8", "R5 (1)"},
};

const Row old[] = {
    {"Occ W 6s", "Oc", "", "W", 6, 0, "", "W5 (1)"},
    {"Gp Occ(2) W 8s", "Oc(2)", "(2)", "W", 8, 0, "", "W5 (1) W1 (1)"},
    {"Gp.Fl.(2)R. ev 10s", "Fl(2)", "(2)", "R", 10, 0, "", "R0.5 (1) R0.5 (8)"},
    {"GpFl(4)W20sec", "Fl(4)", "(4)", "W", 20, 0, "", "W0.5 (1) W0.5 (1) W0.5 (1) W0.5 (15)"},
    {"Qk.Fl.G.", "Q", "", "G", 1, 0, "", "G0.3 (0.7)"},
    {"V Qk Fl(3) 5s", "VQ(3)", "(3)", "W", 5, 0, "", "W0.2 (0.3) W0.2 (0.3) W0.2 (3.8)"},
    {"Qk Fl(6)+L Fl 15s", "Q(6)+LFl", "(6)(1)", "W", 15, 0, "",
     "W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W2 (7)"},
    {"Int Qk Fl 8s", "IQ", "", "W", 8, 0, "", "W0.3 (0.7) W0.3 (0.7) W0.3 (0.7) W0.3 (4.7)"},
    {"I.V.Qk.Fl. 3s", "IVQ", "", "W", 3, 0, "", "W0.2 (0.3) W0.2 (0.3) W0.2 (1.8)"},
    {"E Int 4s", "Iso", "", "W", 4, 0, "", "W2 (2)"},
    {"Alt W R 6s", "Al", "", "WR", 6, 0, "", "W3 R3"},
    {"Alt.Fl.W.G. 10s", "Al Fl", "", "WG", 10, 0, "", "W1 (4) G1 (4)"},
    {"S-L Fl W 12s", "Fl+LFl", "(1)(1)", "W", 12, 0, "", "W0.5 (1) W2 (8.5)"},
};

TEST(CharacterNotation, EveryFormOfTodaySaysWhatInt1Says) {
    for (const Row& row : today)
        expect_row(row, false);
}

TEST(CharacterNotation, OldFormsAreUnderstoodWithAWarning) {
    for (const Row& row : old)
        expect_row(row, true);
}

TEST(CharacterNotation, WordsAndUnitsWrittenOutAreUnderstood) {
    EXPECT_EQ(format_character(parse_character("Flashing Red 4 seconds 12 metres 5 nmi")), "Fl R 4s 12m 5M");
    EXPECT_EQ(format_character(parse_character("Long flashing W 10s")), "LFl W 10s");
    EXPECT_EQ(format_character(parse_character("Fixed and Flashing")), "FFl W");
    EXPECT_EQ(format_character(parse_character("Isophase G 4s")), "Iso G 4s");
}

// Two figures and an m cannot be heights: a light has one.
TEST(CharacterNotation, RangesInSmallLettersAreReadWithAWarning) {
    const Character c = parse_character("fl.wrg.5s13m10-7m");
    EXPECT_EQ(format_character(c), "Fl WRG 5s 13m 10-7M");
    EXPECT_EQ(c.warnings.size(), 1U);
}

TEST(CharacterNotation, InterruptedLightsShowTheGroupThatIsWritten) {
    const Character c = parse_character("IQ(9) 10s");
    int flashes = 0;
    for (const Phase& phase : c.rhythm.phases)
        if (phase.lit) ++flashes;
    EXPECT_EQ(flashes, 9);
    EXPECT_EQ(c.rhythm.period_s, 10);
}

TEST(CharacterNotation, PrefixesLampsAndRemarksAreKept) {
    EXPECT_EQ(parse_character("Aero Dir Iso W 2s").prefixes, (std::vector<std::string>{"Aero", "Dir"}));
    EXPECT_EQ(parse_character("2F.R(vert)").lamp_count, 2);
    EXPECT_EQ(parse_character("2F.R(vert)").arrangement, "vert");
    EXPECT_EQ(parse_character("3 F G (hor)").arrangement, "hor");
    EXPECT_DOUBLE_EQ(parse_character("Dir Fl W 5s 269.5\xC2\xB0").direction_deg.value(), 269.5);
    EXPECT_EQ(parse_character("F W (Fog)").remarks, std::vector<std::string>{"fog"});
    EXPECT_FALSE(parse_character("F W (Fog)").assumptions.empty()) << "it is not always shown";
    EXPECT_EQ(parse_character("Iso W 4s (occasional)").remarks, std::vector<std::string>{"occas"});
}

// ITU-R M.1677-1, section 1.1: letters and figures.
TEST(CharacterNotation, MorseSpellsEveryLetterAndFigure) {
    const std::pair<char, const char*> code[] = {
        {'A', ".-"},    {'B', "-..."},  {'C', "-.-."},  {'D', "-.."},   {'E', "."},     {'F', "..-."},
        {'G', "--."},   {'H', "...."},  {'I', ".."},    {'J', ".---"},  {'K', "-.-"},   {'L', ".-.."},
        {'M', "--"},    {'N', "-."},    {'O', "---"},   {'P', ".--."},  {'Q', "--.-"},  {'R', ".-."},
        {'S', "..."},   {'T', "-"},     {'U', "..-"},   {'V', "...-"},  {'W', ".--"},   {'X', "-..-"},
        {'Y', "-.--"},  {'Z', "--.."},  {'0', "-----"}, {'1', ".----"}, {'2', "..---"}, {'3', "...--"},
        {'4', "....-"}, {'5', "....."}, {'6', "-...."}, {'7', "--..."}, {'8', "---.."}, {'9', "----."}};
    for (const auto& [letter, marks] : code) {
        const Character c = parse_character(std::string("Mo(") + letter + ") 20s");
        std::string shown;
        for (std::size_t i = 0; i < c.rhythm.phases.size(); ++i) {
            const Phase& phase = c.rhythm.phases[i];
            EXPECT_EQ(phase.lit, i % 2 == 0);
            if (phase.lit) shown += phase.duration_s > 1 ? '-' : '.';
        }
        EXPECT_EQ(shown, marks) << letter;
        EXPECT_NEAR(c.rhythm.period_s, 20, 1e-12);
    }
}

struct Bad {
    const char* text;
    std::size_t offset;
    const char* says;
};

TEST(CharacterNotation, WhatIsWrongIsNamedWithItsPlaceAndWhatWasExpected) {
    const Bad rows[] = {
        {"WRG 10s", 0, "expected F, Oc, Iso"},
        {"Fl Pink 3s", 3, "expected F, Oc, Iso"},
        {"Fl R 10", 5, "expected s (period), m or ft (height) or M"},
        {"Fl R 10x", 5, "expected s (period)"},
        {"Fl WR 5s W 12 W 9", 16, "a second range of one colour"},
        {"Fl WRG 5s 12/9M", 10, "2 ranges for 3 colours: expected one for each"},
        {"Fl WRG 5s 12/10-9M", 15, "expected one of them"},
        {"Fl W 5s 12M 9M", 12, "a second range: expected one"},
        {"Fl W 5s 12m 9m", 12, "a second height: expected one"},
        {"Fl(2", 2, "expected ')'"},
        {"Fl() 5s", 2, "expected a group or a remark"},
        {"Fl(2+) 5s", 2, "(3) or (2+1)"},
        {"Fl(1.5) 5s", 2, "(3) or (2+1)"},
        {"Fl W 5s Racon(K)", 9, "'Racon' is neither"},
        {"Fl(99) 5s", 2, "a group counts 1 to 20"},
        {"Fl(2)(pink) 5s", 5, "expected (3), (2+1), (vert)"},
        {"Iso(2) 4s", 3, "expected none"},
        {"Mo 10s", 2, "expected (A)"},
        {"Mo(\xC3\x84) 10s", 2, "A to Z and 0 to 9"},
        {"Q(6)+", 5, "expected one, as in Q(6)+LFl"},
        {"+LFl", 0, "expected a class"},
        {"Q(6)+Oc 15s", 0, "expected Fl, LFl, Q, VQ or UQ"},
        {"Q(6)+LFl 8s", 9, "expected a longer period or fewer flashes"},
        {"Fl R 5s fl. 1", 13, "expected the duration's unit, s"},
        {"Fl R 5s fl. 0s", 8, "longer than 0 s"},
        {"Dir W 400\xC2\xB0", 6, "between 000"},
        {"7\xC2\xB7"
         "5s %",
         6,
         "expected a class, a colour, a bracket or a figure"},  // counted in the bytes of the text as given
    };
    for (const Bad& row : rows) {
        SCOPED_TRACE(row.text);
        try {
            parse_character(row.text);
            ADD_FAILURE() << "was accepted";
        } catch (const CharacterError& error) {
            EXPECT_EQ(error.offset, row.offset) << error.what();
            EXPECT_NE(std::string(error.what()).find(row.says), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace seaglare::lightdb
