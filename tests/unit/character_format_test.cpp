// Writing and reading again, over thousands of generated characters: parse(format(x)) means x, and however the same light is
// spelled, it is the same light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <random>

#include "lightdb/character.h"

namespace seaglare::lightdb {
namespace {

// One light in words that can be set in many ways.
struct Words {
    std::string prefix;
    std::string alternating;
    std::vector<std::string> class_parts;  // what blanks or dots may separate
    std::vector<std::string> colours;
    std::vector<std::string> figures;  // in any order
};

class Generator {
  public:
    explicit Generator(unsigned seed) : random_(seed) {}

    bool chance(double share) { return std::uniform_real_distribution<double>(0, 1)(random_) < share; }
    int number(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
    template <class List>
    const auto& one_of(const List& list) {
        return list[static_cast<std::size_t>(number(0, static_cast<int>(std::size(list)) - 1))];
    }

    Words words() {
        static const std::vector<std::vector<std::string>> classes{{"F"},
                                                                   {"Oc"},
                                                                   {"Oc", "(2)"},
                                                                   {"Oc", "(2+1)"},
                                                                   {"Iso"},
                                                                   {"Fl"},
                                                                   {"Fl", "(2)"},
                                                                   {"Fl", "(2+1)"},
                                                                   {"Fl", "(5)"},
                                                                   {"L", "Fl"},
                                                                   {"L", "Fl", "(3)"},
                                                                   {"Q"},
                                                                   {"Q", "(3)"},
                                                                   {"Q", "(9)"},
                                                                   {"V", "Q"},
                                                                   {"V", "Q", "(5)"},
                                                                   {"U", "Q"},
                                                                   {"U", "Q", "(2)"},
                                                                   {"I", "Q"},
                                                                   {"I", "V", "Q"},
                                                                   {"I", "U", "Q"},
                                                                   {"Mo", "(A)"},
                                                                   {"Mo", "(SOS)"},
                                                                   {"Mo", "(7)"},
                                                                   {"F", "Fl"},
                                                                   {"F", "Fl", "(2)"},
                                                                   {"F", "L", "Fl"},
                                                                   {"Q", "(6)", "+", "L", "Fl"},
                                                                   {"V", "Q", "(6)", "+", "L", "Fl"},
                                                                   {"Fl", "(3)", "+", "L", "Fl"}};
        Words w;
        w.prefix = chance(0.15) ? "Dir" : chance(0.1) ? "Aero" : "";
        w.class_parts = one_of(classes);
        const int colours = number(1, 3);
        std::vector<std::string> letters{"W", "R", "G", "Y", "Bu", "Or", "Vi"};
        std::shuffle(letters.begin(), letters.end(), random_);
        w.colours.assign(letters.begin(), letters.begin() + colours);
        const bool flashes_add = w.class_parts.size() > 3;
        if (colours > 1 && !flashes_add && chance(0.25)) w.alternating = "Al";
        const bool continuous = w.class_parts.back() == "Q" && w.class_parts.front() != "I";
        if (w.class_parts != std::vector<std::string>{"F"} && !continuous)
            w.figures.push_back(decimal(number(150, 600)) + "s");
        if (chance(0.5))
            w.figures.push_back(chance(0.3) ? std::to_string(number(3, 900)) + "ft"
                                            : decimal(number(5, 1200)) + "m");
        if (chance(0.7)) w.figures.push_back(range(colours, w.colours));
        return w;
    }

    // Set the words with or without blanks and dots, in one of the orders.
    std::string set(const Words& w) {
        const bool dots = chance(0.3);
        const bool close = chance(0.4);
        const std::string gap = dots ? "." : close ? "" : " ";
        std::string text;
        const auto add = [&](const std::string& word, const std::string& after) { text += word + after; };
        const bool colours_first = w.prefix.empty() && chance(0.1);
        std::string colours;
        for (const std::string& colour : w.colours)
            colours += colour + (dots ? "." : "");
        if (colours_first) add(colours, " ");
        if (!w.prefix.empty()) add(w.prefix, gap);
        if (!w.alternating.empty()) add(w.alternating, gap);
        const bool apart = chance(0.3);
        for (const std::string& part : w.class_parts)
            add(part, dots && part[0] != '(' && part != "+" ? "." : apart ? " " : "");
        if (!close) text += " ";
        if (!colours_first) add(colours, gap);
        std::vector<std::string> figures = w.figures;
        std::shuffle(figures.begin(), figures.end(), random_);
        for (const std::string& figure : figures)
            text += (chance(0.5) ? " " : chance(0.2) ? ", " : "") + figure;
        if (chance(0.15))
            for (char& c : text)  // but for the metre and the mile
                if (c != 'm' && c != 'M' && chance(0.5))
                    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return text;
    }

  private:
    static std::string decimal(int tenths) {
        return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10));
    }
    std::string range(int colours, const std::vector<std::string>& letters) {
        if (colours == 1 || chance(0.3)) return decimal(number(10, 300)) + "M";
        if (chance(0.3)) return std::to_string(number(10, 20)) + "-" + std::to_string(number(3, 9)) + "M";
        std::string text;
        if (chance(0.5)) {
            for (int i = 0; i < colours; ++i)
                text += (i == 0 ? "" : "/") + decimal(number(10, 300));
            return text + "M";
        }
        for (const std::string& letter : letters)
            text += " " + letter + " " + decimal(number(10, 300));
        return text + "M";
    }

    std::mt19937 random_;
};

void expect_same(const Character& a, const Character& b) {
    EXPECT_EQ(a.light_class, b.light_class);
    EXPECT_EQ(a.terms, b.terms);
    EXPECT_EQ(a.prefixes, b.prefixes);
    EXPECT_EQ(a.colours, b.colours);
    EXPECT_EQ(a.period_s, b.period_s);
    EXPECT_EQ(a.height_m, b.height_m);
    EXPECT_EQ(a.range_nm, b.range_nm);
    EXPECT_EQ(a.lamp_count, b.lamp_count);
    EXPECT_EQ(a.arrangement, b.arrangement);
    EXPECT_EQ(a.direction_deg, b.direction_deg);
    EXPECT_EQ(a.remarks, b.remarks);
    EXPECT_EQ(a.rhythm, b.rhythm);
    EXPECT_EQ(a.written_phases, b.written_phases);
}

TEST(CharacterFormat, ALampAloneInItsRowKeepsItsCount) {
    const Character one = parse_character("1 Al RW (hor) 1s");
    EXPECT_EQ(one.lamp_count, 1);
    EXPECT_EQ(format_character(one), "1 Al RW (hor) 1s");
    EXPECT_EQ(parse_character(format_character(one)).lamp_count, 1);
}

TEST(CharacterFormat, WhatIsWrittenReadsBackAsTheSameLight) {
    Generator generator(3);
    int read = 0;
    for (int i = 0; i < 6000; ++i) {
        const std::string text = generator.set(generator.words());
        SCOPED_TRACE(text);
        Character first;
        try {
            first = parse_character(text);
        } catch (const CharacterError& error) {
            // The one thing that can be wrong with these words: too many flashes for the period.
            ASSERT_NE(std::string(error.what()).find("do not fit into"), std::string::npos) << error.what();
            continue;
        }
        ++read;
        const std::string canonical = format_character(first);
        SCOPED_TRACE(canonical);
        const Character second = parse_character(canonical);
        expect_same(first, second);
        EXPECT_EQ(format_character(second), canonical);
        if (::testing::Test::HasFailure()) return;
    }
    EXPECT_GT(read, 5000);
}

TEST(CharacterFormat, HoweverItIsSetItIsTheSameLight) {
    Generator generator(4);
    for (int i = 0; i < 2000; ++i) {
        const Words words = generator.words();
        const std::string one = generator.set(words);
        const std::string other = generator.set(words);
        SCOPED_TRACE(one + " | " + other);
        std::string first;
        std::string second;
        try {
            first = format_character(parse_character(one));
        } catch (const CharacterError&) {
            EXPECT_THROW(parse_character(other), CharacterError);
            continue;
        }
        second = format_character(parse_character(other));
        EXPECT_EQ(first, second);
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(CharacterFormat, EveryGeneratedRhythmFillsItsPeriod) {
    Generator generator(5);
    for (int i = 0; i < 3000; ++i) {
        const std::string text = generator.set(generator.words());
        SCOPED_TRACE(text);
        Character c;
        try {
            c = parse_character(text);
        } catch (const CharacterError&) {
            continue;
        }
        double sum_s = 0;
        for (const Phase& phase : c.rhythm.phases) {
            ASSERT_GT(phase.duration_s, 0);
            sum_s += phase.duration_s;
        }
        if (!c.period_s || c.rhythm.phases.empty()) continue;
        const double periods = sum_s / *c.period_s;
        ASSERT_NEAR(periods, std::round(periods), 1e-9)
            << "a whole number of periods: one, or one turn of the colours";
        if (!c.alternating) {
            ASSERT_NEAR(periods, 1, 1e-9);
        }
    }
}

TEST(CharacterFormat, CanonicalFormsAreThoseOfCharts) {
    const std::pair<const char*, const char*> rows[] = {
        {"Gp.Fl.(2+1)W.R.G. ev 10 sec 15m 12-9M", "Fl(2+1) WRG 10s 15m 12-9M"},
        {"2F.R(vert)10m4M", "2 F R (vert) 10m 4M"},
        {"AeroAlFlWG 7\xC2\xB7"
         "5s11M",
         "Aero Al Fl WG 7.5s 11M"},
        {"Oc WRG 6s G 8 W 12 R 9", "Oc WRG 6s G 8M W 12M R 9M"},
        {"Oc WRG 6s W 12 R 9 G 8", "Oc WRG 6s 12/9/8M"},
        {"Al WR R 8M", "Al WR R 8M"},
        {"Fl.W. period 3s fl. 0.8s, ec. 2.2s", "Fl W 3s fl. 0.8s, ec. 2.2s"},
        {"Dir Iso WRG 2s 180\xC2\xB0 (occas)", "Dir Iso WRG (occas) 180\xC2\xB0 2s"},
    };
    for (const auto& [text, canonical] : rows)
        EXPECT_EQ(format_character(parse_character(text)), canonical);
}

}  // namespace
}  // namespace seaglare::lightdb
