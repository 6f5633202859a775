// Seventeen lights of the List of Lights, worked by hand: what a navigator sees from a bearing at a second of the period. The
// facts (characteristic, sectors as true bearings from seaward) are the U.S. NGA List of Lights Pub. 116's, under the number
// given with each; colour and state were read off those lists by hand, not by this program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightdb/character.h"
#include "lightdb/evaluate.h"
#include "lightdb/json/value.h"
#include "lightdb/rhythm.h"

namespace seaglare::lightdb {
namespace {

struct Arc {
    const char* colour;
    double from_deg;
    double to_deg;
    double factor = 1;
};

// "-": dark, or in no sector. A small letter: the weaker, steady part of a fixed and flashing light.
struct Seen {
    double bearing_deg;
    double second;  // of the period, from the list's first light on
    const char* colour;
};

struct Worked {
    const char* number;  // in Pub. 116
    const char* name;
    const char* characteristic;
    std::vector<Arc> arcs;
    std::vector<Seen> seen;
};

const std::vector<Worked>& worked() {
    static const std::vector<Worked> lights{
        // Light 0-2. Green runs through north.
        {"44",
         "Kabblingarna",
         "L.Fl.W.R.G. period 9s fl. 2.0s, ec. 7.0s",
         {{"R", 185.5, 201}, {"G", 201, 36}, {"W", 36, 62}, {"R", 62, 75.5}},
         {{190, 1, "R"},
          {300, 1.9, "G"},
          {10, 0.1, "G"},
          {50, 0.5, "W"},
          {70, 1, "R"},
          {100, 1, "-"},
          {190, 2.1, "-"},
          {50, 8.9, "-"}}},
        // Light 0-0.4. Seven sectors of three colours.
        {"88",
         "Rundegra",
         "Fl.W.R.G. period 2s fl. 0.4s, ec. 1.6s",
         {{"G", 197, 225}, {"W", 225, 240}, {"R", 240, 288}, {"G", 288, 15}, {"W", 15, 20}, {"R", 20, 37}},
         {{210, 0.2, "G"},
          {230, 0.3, "W"},
          {270, 0.1, "R"},
          {350, 0.2, "G"},
          {17, 0.2, "W"},
          {30, 0.2, "R"},
          {100, 0.2, "-"},
          {17, 0.5, "-"},
          {230, 1.9, "-"}}},
        // Light 0-2 and 4-6.
        {"96",
         "Ursholmen",
         "L.Fl.(2)W.R.G. period 15s fl. 2.0s, ec. 2.0s fl. 2.0s, ec. 9.0s",
         {{"R", 349, 36}, {"W", 36, 169}, {"R", 169, 174}, {"W", 174, 337}, {"G", 337, 341}, {"W", 341, 349}},
         {{0, 1, "R"},
          {100, 1, "W"},
          {171, 5, "R"},
          {339, 4.5, "G"},
          {345, 1, "W"},
          {250, 5.9, "W"},
          {100, 3, "-"},
          {100, 7, "-"},
          {0, 14.9, "-"}}},
        // Light 0-1 and 2-7: the short light stands first in the list.
        {"436",
         "Grundsund pier",
         "Oc.(2)W.R.G. period 8s fl. 1.0s, ec. 1.0s fl. 5.0s, ec. 1.0s",
         {{"G", 111, 132.7}, {"W", 132.7, 161.2}, {"R", 161.2, 172}},
         {{120, 0.5, "G"},
          {150, 3, "W"},
          {165, 6.5, "R"},
          {132.6, 3, "G"},
          {132.8, 3, "W"},
          {150, 1.5, "-"},
          {150, 7.5, "-"},
          {180, 0.5, "-"}}},
        // Light 0-6.
        {"1360",
         "Morups Tange",
         "Oc.W.R.G. period 8s fl. 6.0s, ec. 2.0s",
         {{"G", 300, 326}, {"W", 326, 148.7}, {"R", 148.7, 180}},
         {{310, 3, "G"}, {0, 3, "W"}, {148, 5.9, "W"}, {160, 3, "R"}, {250, 3, "-"}, {0, 6.5, "-"}}},
        // Light 0-4.
        {"2652",
         "Nordborg",
         "Oc.W.R.G. period 5s fl. 4.0s, ec. 1.0s",
         {{"G", 65, 70},
          {"W", 70, 73},
          {"R", 73, 171},
          {"G", 171, 184.5},
          {"W", 184.5, 236},
          {"R", 236, 254}},
         {{67, 1, "G"},
          {71, 1, "W"},
          {72, 4.5, "-"},
          {100, 3.9, "R"},
          {180, 1, "G"},
          {200, 1, "W"},
          {240, 1, "R"},
          {300, 1, "-"}}},
        // Light 0-5, 7-9, 11-13.
        {"2872",
         "Gammel-Pol",
         "Oc.(3)W.R.G. period 15s fl. 5.0s, ec. 2.0s fl. 2.0s, ec. 2.0s fl. 2.0s, ec. 2.0s",
         {{"W", 166.5, 320}, {"R", 320, 8}, {"G", 8, 36.5}, {"W", 36.5, 49}, {"R", 49, 166.5}},
         {{200, 4, "W"},
          {200, 6, "-"},
          {350, 8, "R"},
          {20, 12, "G"},
          {40, 10, "-"},
          {40, 12.5, "W"},
          {100, 1, "R"},
          {100, 14, "-"}}},
        // Light 0-3, a direction light of 8 degrees in all.
        {"2972",
         "Kielseng",
         "Dir.Oc.W.R.G. period 4s fl. 3.0s, ec. 1.0s",
         {{"G", 193, 195}, {"W", 195, 199}, {"R", 199, 201}},
         {{194, 1, "G"}, {197, 2.9, "W"}, {200, 1, "R"}, {197, 3.5, "-"}, {210, 1, "-"}, {180, 1, "-"}}},
        // Light 0-2, 3-5, 6-8, 9-14.
        {"3100",
         "N. mole, head",
         "Oc.(4)W.R. period 15s fl. 2.0s, ec. 1.0s fl. 2.0s, ec. 1.0s fl. 2.0s, ec. 1.0s fl. 5.0s, ec. 1.0s",
         {{"R", 16, 70}, {"W", 70, 162}, {"R", 162, 200}},
         {{50, 1, "R"},
          {100, 2.5, "-"},
          {100, 4, "W"},
          {180, 7, "R"},
          {180, 8.5, "-"},
          {100, 13.9, "W"},
          {100, 14.5, "-"},
          {300, 1, "-"}}},
        // Light 0-2.1, 9-11.1, 18-20.1, 27-29.1.
        {"3412",
         "Buk",
         "L.Fl.(4)W.R. period 45s fl. 2.1s, ec. 6.9s fl. 2.1s, ec. 6.9s fl. 2.1s, ec. 6.9s fl. 2.1s, ec. "
         "15.9s",
         {{"R", 40, 73}, {"W", 73, 265}},
         {{50, 1, "R"},
          {100, 9.5, "W"},
          {100, 8, "-"},
          {100, 20, "W"},
          {200, 28, "W"},
          {200, 30, "-"},
          {300, 1, "-"}}},
        // Light 0-0.3, 3-3.3, 6-6.3, 15-15.3.
        {"3428",
         "Warnemunde",
         "Fl.(3+1)W. period 24s fl. 0.3s, ec. 2.7s fl. 0.3s, ec. 2.7s fl. 0.3s, ec. 8.7s fl. 0.3s, ec. 8.7s",
         {{"W", 62.6, 242.6}},
         {{100, 0.1, "W"},
          {100, 3.1, "W"},
          {100, 6.2, "W"},
          {100, 15.1, "W"},
          {100, 9, "-"},
          {100, 18.1, "-"},
          {300, 0.1, "-"}}},
        // Light 0-0.7, 8.9-9.6, 11.1-11.8; visible through north.
        {"5606",
         "Smygehuk",
         "Fl.(1+2)W. period 20s fl. 0.7s, ec. 8.2s fl. 0.7s, ec. 1.5s fl. 0.7s, ec. 8.2s",
         {{"W", 262, 95}},
         {{0, 0.5, "W"},
          {0, 9.2, "W"},
          {0, 10, "-"},
          {0, 11.5, "W"},
          {0, 13, "-"},
          {180, 0.5, "-"},
          {262.5, 0.1, "W"}}},
        // Light 0-7.5, orange, over 8 degrees.
        {"6128",
         "Galeriowa Beacon",
         "Oc.Or. period 10s fl. 7.5s, ec. 2.5s",
         {{"Or", 166.2, 174.2}},
         {{170, 7, "Or"}, {170, 8, "-"}, {160, 1, "-"}}},
        // U is dot dot dash: light 0-1, 2-3, 4-7.
        {"8648",
         "Rear, 75 meters 213",
         "Mo.(U)W.R.G. period 10s fl. 1.0s, ec. 1.0s fl. 1.0s, ec. 1.0s fl. 3.0s, ec. 3.0s",
         {{"R", 177.5, 247.8},
          {"G", 247.8, 300.8},
          {"W", 300.8, 308.8},
          {"R", 308.8, 28},
          {"G", 28, 58},
          {"W", 58, 62.5},
          {"R", 62.5, 94.8},
          {"G", 94.8, 141.2}},
         {{200, 0.5, "R"},
          {280, 2.5, "G"},
          {305, 5, "W"},
          {0, 1.5, "-"},
          {0, 6.5, "R"},
          {40, 4.5, "G"},
          {60, 0.5, "W"},
          {80, 6.9, "R"},
          {100, 0.5, "G"},
          {60, 8, "-"},
          {160, 0.5, "-"}}},
        // N is dash dot: light 0-4, 8-9. Unintensified 115-205, by how much the List does not say: a tenth here.
        {"9040",
         "Huvudskar",
         "Mo.(N)W. period 25s fl. 4.0s, ec. 4.0s fl. 1.0s, ec. 16.0s",
         {{"W", 205, 115}, {"W", 115, 205, 0.1}},
         {{60, 2, "W"}, {150, 2, "w"}, {60, 5, "-"}, {60, 8.5, "W"}, {150, 20, "-"}}},
        // Flashes 0-1, 3-4, 6-8 over a steady light: never dark within its sectors, which meet all round.
        {"12684",
         "Vilsandi Saar",
         "F.Fl.(3)W.R. period 15s fl. 1.0s, ec. 2.0s fl. 1.0s, ec. 2.0s fl. 2.0s, ec. 7.0s",
         {{"W", 212, 164.5}, {"R", 164.5, 212}},
         {{0, 0.5, "W"},
          {0, 2, "w"},
          {190, 3.5, "R"},
          {190, 10, "r"},
          {211, 7.5, "R"},
          {213, 7.5, "W"},
          {100, 14.9, "w"}}},
        // The class says two flashes, the list one of 0.5 s: the list is shown, the contradiction reported.
        {"17492",
         "Kupeli",
         "V.Q.(2)W.R.G. period 3s fl. 0.5s, ec. 2.5s",
         {{"W", 0, 90}, {"R", 90, 222}, {"G", 222, 246}, {"W", 246, 252}, {"R", 252, 324}, {"G", 324, 0}},
         {{45, 0.2, "W"},
          {100, 0.2, "R"},
          {230, 0.4, "G"},
          {250, 0.2, "W"},
          {300, 0.2, "R"},
          {340, 0.2, "G"},
          {45, 1, "-"},
          {45, 2.9, "-"}}},
    };
    return lights;
}

Colour colour_of(const std::string& letter) {
    for (int c = 0; c < colour_count; ++c)
        if (colour_letter(static_cast<Colour>(c)) == letter) return static_cast<Colour>(c);
    ADD_FAILURE() << letter;
    return Colour::white;
}

Light make(const Worked& facts) {
    Light light;
    light.name = facts.name;
    light.character = facts.characteristic;
    light.rhythm = parse_character(facts.characteristic).rhythm;
    light.intensity_cd.fill(1000);
    light.height_m = 10;
    light.position_m = {1000, -2000, 10};
    for (const Arc& arc : facts.arcs)
        light.sectors.push_back({colour_of(arc.colour), arc.from_deg, arc.to_deg, arc.factor});
    light.stable_key = stable_key_of(light);
    return light;
}

// A mile off, where the light bears as asked.
Observer observer_at(const Light& light, double bearing_deg, double time_s, double exposure_s) {
    const double bearing_rad = bearing_deg * std::numbers::pi / 180;
    Observer observer;
    observer.eye_m = {light.position_m[0] - 1852 * std::sin(bearing_rad),
                      light.position_m[1] - 1852 * std::cos(bearing_rad), 10};
    observer.time_s = time_s;
    observer.exposure_s = exposure_s;
    observer.seed = 7;
    return observer;
}

std::string shown(const Light& light, double bearing_deg, double second, double periods, double exposure_s) {
    const double begin_s =
        periods * light.rhythm.period_s - phase_offset_s(light.rhythm, light.stable_key, 7);
    const LightStore store;
    const auto cd = intensity_towards_cd(
        store, light, observer_at(light, bearing_deg, begin_s + second + exposure_s / 2, exposure_s));
    std::string text;
    for (std::size_t c = 0; c < cd.size(); ++c) {
        if (cd[c] == 0) continue;
        std::string letter(colour_letter(static_cast<Colour>(c)));
        if (cd[c] < 500) letter[0] = static_cast<char>(letter[0] - 'A' + 'a');
        text += letter;
    }
    return text.empty() ? "-" : text;
}

TEST(RhythmWorkedLights, ColourAndStateAreWhatTheListSays) {
    ASSERT_GE(worked().size(), 12U);
    for (const Worked& facts : worked()) {
        const Light light = make(facts);
        for (const Seen& seen : facts.seen) {
            SCOPED_TRACE(std::string(facts.number) + " " + facts.name + " from " +
                         std::to_string(seen.bearing_deg) + " at " + std::to_string(seen.second));
            EXPECT_EQ(shown(light, seen.bearing_deg, seen.second, 0, 0), seen.colour) << "an instant";
            EXPECT_EQ(shown(light, seen.bearing_deg, seen.second, 0, 1.0 / 60), seen.colour) << "a frame";
            EXPECT_EQ(shown(light, seen.bearing_deg, seen.second, 123457, 1.0 / 240), seen.colour)
                << "much later";
        }
    }
}

TEST(RhythmWorkedLights, TheirListsFillTheirPeriods) {
    for (const Worked& facts : worked()) {
        const Character c = parse_character(facts.characteristic);
        EXPECT_NEAR(c.rhythm.period_s, c.period_s.value(), 1e-9) << facts.number;
        EXPECT_EQ(c.warnings.empty(), std::string(facts.number) != "17492") << facts.number;
    }
}

std::string plain(std::string_view text) {
    std::string words;
    for (const char c : text) {
        const bool blank = c == ' ' || c == '\n';
        if (!blank) words += c;
        if (blank && !words.empty() && words.back() != ' ') words += ' ';
    }
    if (!words.empty() && words.back() == ' ') words.pop_back();
    return words;
}

TEST(RhythmWorkedLights, TheCharacteristicsStandInPub116) {
    json::Document document = [] {
        try {
            return json::parse_file(std::string(SEAGLARE_SHARED_DIR) + "/data/nga/pub116.json");
        } catch (const std::system_error&) {
            return json::parse("{}", "none");
        }
    }();
    const json::Value* list = document.root().find("ngalol");
    if (list == nullptr) GTEST_SKIP() << "the List of Lights is not here";
    for (const Worked& facts : worked()) {
        const auto records = list->array();
        const bool found = std::any_of(records.begin(), records.end(), [&](const json::Value& record) {
            const std::string_view number = record.find("featureNumber")->string();
            return number.substr(0, number.find('\n')) == facts.number &&
                   record.find("name")->string().find(std::string(facts.name)) != std::string_view::npos &&
                   plain(record.find("characteristic")->string()) == facts.characteristic;
        });
        EXPECT_TRUE(found) << facts.number << " " << facts.name;
    }
}

// Two channels load the same lights in different orders and show the same at every instant.
TEST(RhythmWorkedLights, ChannelsAgreeWhateverTheLoadOrder) {
    LightStore forth;
    LightStore back;
    for (const Worked& facts : worked()) {
        Light light = make(facts);
        light.stable_key = 0;  // the store hashes the light's own data
        forth.add(light);
    }
    for (auto facts = worked().rbegin(); facts != worked().rend(); ++facts) {
        Light light = make(*facts);
        light.stable_key = 0;
        back.add(light);
    }
    const auto by_name = [](const LightStore& store) {
        std::vector<Light> lights;
        for (const LightId id : store.ids())
            lights.push_back(*store.find(id));
        std::sort(lights.begin(), lights.end(),
                  [](const Light& a, const Light& b) { return a.name < b.name; });
        return lights;
    };
    const std::vector<Light> one = by_name(forth);
    const std::vector<Light> other = by_name(back);
    ASSERT_EQ(one.size(), other.size());
    int lit = 0;
    for (double time_s = 0; time_s < 1e7; time_s = time_s * 1.37 + 0.31) {
        for (std::size_t i = 0; i < one.size(); ++i) {
            const Observer observer = observer_at(one[i], 120, time_s, 1.0 / 60);
            const auto a = intensity_towards_cd(forth, one[i], observer);
            EXPECT_EQ(a, intensity_towards_cd(back, other[i], observer)) << one[i].name << " " << time_s;
            for (const double cd : a)
                lit += cd > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 20);
}

}  // namespace
}  // namespace seaglare::lightdb
