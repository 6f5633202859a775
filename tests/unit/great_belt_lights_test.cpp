// What the committed light files show a navigator, against limits read by hand from the List of Lights (NGA Pub. 116):
// a tenth of a degree to either side of each limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "lightdb/character.h"
#include "lightdb/light_file.h"
#include "lightdb/photometry.h"
#include "lightdb/sector.h"

namespace seaglare::lightdb {
namespace {

const LightFile& lights(const char* name) {
    static const LightFile great_belt =
        load_light_file(std::string(SEAGLARE_SOURCE_DIR) + "/config/lights/great_belt.json");
    static const LightFile sonderborg =
        load_light_file(std::string(SEAGLARE_SOURCE_DIR) + "/config/lights/sonderborg.json");
    return std::string(name) == "great_belt" ? great_belt : sonderborg;
}

const Light* find(const char* file, std::string_view name) {
    for (const Light& light : lights(file).lights)
        if (light.name == name) return &light;
    return nullptr;
}

// "W", "R", …, or "-" where nothing shows.
std::string shown(const Light& light, double bearing_deg) {
    const SectorFactors factors = sector_factors(light.sectors, wrapped_deg(bearing_deg));
    std::string text;
    for (std::size_t c = 0; c < factors.size(); ++c)
        if (factors[c] * light.intensity_cd[c] > 0) text += colour_letter(static_cast<Colour>(c));
    return text.empty() ? "-" : text;
}

struct Limit {
    const char* file;
    const char* light;
    double bearing_deg;  // true, from seaward
    const char* before;  // a tenth of a degree less
    const char* after;
};

constexpr double minute = 1.0 / 60;

const Limit limits[] = {
    // 2436 Korshavn: R. 259-292, G.-053, W.-058, R.-078.
    {"great_belt", "Korshavn", 259, "-", "R"},
    {"great_belt", "Korshavn", 292, "R", "G"},
    {"great_belt", "Korshavn", 53, "G", "W"},
    {"great_belt", "Korshavn", 58, "W", "R"},
    {"great_belt", "Korshavn", 78, "R", "-"},
    // 2344 Lushage: W. 204-095.
    {"great_belt", "Samso, Lushage, SE. point of Samso", 204, "-", "W"},
    {"great_belt", "Samso, Lushage, SE. point of Samso", 95, "W", "-"},
    // 3752 Knudshoved: G. 220-269, W.-276, R.-305 30, G.-359, W.-003 30, R.-095.
    {"great_belt", "Knudshoved", 220, "-", "G"},
    {"great_belt", "Knudshoved", 269, "G", "W"},
    {"great_belt", "Knudshoved", 276, "W", "R"},
    {"great_belt", "Knudshoved", 305 + 30 * minute, "R", "G"},
    {"great_belt", "Knudshoved", 359, "G", "W"},
    {"great_belt", "Knudshoved", 3 + 30 * minute, "W", "R"},
    {"great_belt", "Knudshoved", 95, "R", "-"},
    // 3648 Romso Tue: all round, nine sectors, one of them through north.
    {"great_belt", "Romso Tue, 24", 51 + 30 * minute, "R", "G"},
    {"great_belt", "Romso Tue, 24", 132, "G", "W"},
    {"great_belt", "Romso Tue, 24", 161, "G", "W"},
    {"great_belt", "Romso Tue, 24", 305 + 48 * minute, "R", "G"},
    {"great_belt", "Romso Tue, 24", 331 + 48 * minute, "W", "R"},
    {"great_belt", "Romso Tue, 24", 0, "R", "R"},
    // 3616 Asnaesvaerket: G. 113 31-115 31, W.-116 31, R.-118 31.
    {"great_belt", "Kalundborg Havn, Asnaesvaerket", 113 + 31 * minute, "-", "G"},
    {"great_belt", "Kalundborg Havn, Asnaesvaerket", 115 + 31 * minute, "G", "W"},
    {"great_belt", "Kalundborg Havn, Asnaesvaerket", 116 + 31 * minute, "W", "R"},
    {"great_belt", "Kalundborg Havn, Asnaesvaerket", 118 + 31 * minute, "R", "-"},
    // 3690.2 and 3690.3, the bridge's marks: seen from the north, and from the south.
    {"great_belt", "East Bridge, W. channel, N. side", 89 + 18 * minute, "-", "G"},
    {"great_belt", "East Bridge, W. channel, N. side", 270 + 42 * minute, "G", "-"},
    {"great_belt", "East Bridge, E. channel, S. side", 270 + 42 * minute, "-", "R"},
    {"great_belt", "East Bridge, E. channel, S. side", 89 + 18 * minute, "R", "-"},
    // 4080 Egholm Flak: G. 158-345, R.-158.
    {"great_belt", "Egholm Flak, 30", 158, "R", "G"},
    {"great_belt", "Egholm Flak, 30", 345, "G", "R"},
    // 2900 Kalkgrund, north of the Flensburg Fjord's mouth.
    {"sonderborg", "Kalkgrund (G.)", 12, "R", "W"},
    {"sonderborg", "Kalkgrund (G.)", 252.6, "W", "G"},
    {"sonderborg", "Kalkgrund (G.)", 258, "G", "W"},
    {"sonderborg", "Kalkgrund (G.)", 265, "W", "R"},
    {"sonderborg", "Kalkgrund (G.)", 292, "R", "W"},
    // 2876 Kegnaes: R. 217-266 30, G.-273, W.-289 30, R.-337, G.-026, ...
    {"sonderborg", "Flensborg Fjord, Kegnaes (Kekenis)", 217, "-", "R"},
    {"sonderborg", "Flensborg Fjord, Kegnaes (Kekenis)", 266 + 30 * minute, "R", "G"},
    {"sonderborg", "Flensborg Fjord, Kegnaes (Kekenis)", 273, "G", "W"},
    {"sonderborg", "Flensborg Fjord, Kegnaes (Kekenis)", 289 + 30 * minute, "W", "R"},
    {"sonderborg", "Flensborg Fjord, Kegnaes (Kekenis)", 26, "G", "W"},
    // 2704 Ballebro and 2892, the west side of Sonderborg's channel.
    {"sonderborg", "Ballebro", 140, "G", "W"},
    {"sonderborg", "Ballebro", 152, "W", "R"},
    {"sonderborg", "Ballebro", 283, "R", "-"},
    {"sonderborg", "Sonderborg, W. side of channel", 114, "-", "R"},
    {"sonderborg", "Sonderborg, W. side of channel", 342, "R", "-"},
};

TEST(GreatBeltLights, ColoursChangeWhereTheListOfLightsSays) {
    for (const Limit& limit : limits) {
        SCOPED_TRACE(std::string(limit.light) + " " + std::to_string(limit.bearing_deg));
        const Light* light = find(limit.file, limit.light);
        ASSERT_NE(light, nullptr);
        EXPECT_EQ(shown(*light, limit.bearing_deg - 0.1), limit.before);
        EXPECT_EQ(shown(*light, limit.bearing_deg + 0.1), limit.after);
    }
}

TEST(GreatBeltLights, IntensitiesFollowFromTheRanges) {
    const Light* knudshoved = find("great_belt", "Knudshoved");  // W. 12, R. 10, G. 10
    ASSERT_NE(knudshoved, nullptr);
    EXPECT_NEAR(knudshoved->intensity_cd[0], intensity_for_range_cd(12), 1e-9);
    EXPECT_NEAR(knudshoved->intensity_cd[1], 1372, 1);  // 10 M at 10 M of visibility
    EXPECT_EQ(knudshoved->intensity_cd[3], 0);
    EXPECT_DOUBLE_EQ(knudshoved->height_m, 16);
}

TEST(GreatBeltLights, ThePylonsLampsHangAtTheirThreeHeights) {
    for (const char* tower : {"East Bridge, W. tower", "East Bridge, E. tower"}) {
        const double heights_m[] = {258, 159, 62};
        for (int lamp = 1; lamp <= 3; ++lamp) {
            const Light* light =
                find("great_belt", std::string(tower) + ", lamp " + std::to_string(lamp) + " of 3");
            ASSERT_NE(light, nullptr);
            EXPECT_DOUBLE_EQ(light->height_m, heights_m[lamp - 1]);
        }
    }
}

TEST(GreatBeltLights, EveryLightLiesInItsAreaAndSaysWhereItIsFrom) {
    EXPECT_EQ(lights("great_belt").lights.size(), 77U);
    EXPECT_EQ(lights("sonderborg").lights.size(), 21U);
    for (const Light& light : lights("great_belt").lights) {
        EXPECT_TRUE(light.geographic);
        EXPECT_GE(light.latitude_deg, 55.2);
        EXPECT_LE(light.latitude_deg, 55.9);
        EXPECT_GE(light.longitude_deg, 10.6);
        EXPECT_LE(light.longitude_deg, 11.3);
        EXPECT_EQ(light.source.rfind("NGA Pub. 116 (", 0), 0U) << light.name;
    }
    EXPECT_TRUE(lights("great_belt").warnings.empty());
    EXPECT_TRUE(lights("sonderborg").warnings.empty());
}

// Bearing from the front light to the rear one, from the positions.
double line_deg(const Light& front, const Light& rear) {
    const double mean_rad = front.latitude_deg * std::numbers::pi / 180;
    const double east = (rear.longitude_deg - front.longitude_deg) * std::cos(mean_rad);
    return wrapped_deg(std::atan2(east, rear.latitude_deg - front.latitude_deg) * 180 / std::numbers::pi);
}

TEST(GreatBeltLights, LeadingLightsStandOnTheLineTheyAreSeenOn) {
    struct Pair {
        const char* file;
        const char* front;
        const char* rear;
        double line_deg;
        double tolerance_deg;  // positions print tenths of seconds or minutes
    };
    for (const Pair& pair :
         {Pair{"great_belt", "Lindeskov Range, front",
               "Lindeskov Range, Rear, 500 meters 110\xC2\xB0"
               "06' from front",
               110.1, 1},
          Pair{"great_belt", "Egholm Range, front", "Egholm Range, Rear, 520 meters 321\xC2\xB0 from front",
               321, 1},
          Pair{"great_belt", "Korsor Havn, Entrance Range, front",
               "Korsor Havn, Entrance Range, Rear, E. ferry berth mole, 198 meters 073\xC2\xB0"
               "30' from front",
               73.5, 1},
          Pair{"sonderborg", "Skodsbol (Schottsbull) Range (D), front",
               "Skodsbol (Schottsbull) Range (D), Rear, 900 meters 028\xC2\xB0 from front", 28, 1},
          Pair{"sonderborg", "Lagemade Range, front",
               "Lagemade Range, Rear, 700 meters 048\xC2\xB0 from front", 48, 1}}) {
        SCOPED_TRACE(pair.front);
        const Light* front = find(pair.file, pair.front);
        const Light* rear = find(pair.file, pair.rear);
        ASSERT_NE(front, nullptr);
        ASSERT_NE(rear, nullptr);
        EXPECT_NEAR(line_deg(*front, *rear), pair.line_deg, pair.tolerance_deg);
        EXPECT_NE(shown(*front, pair.line_deg), "-");
        EXPECT_NE(shown(*rear, pair.line_deg), "-");
        EXPECT_GT(rear->height_m, front->height_m);
    }
}

TEST(GreatBeltLights, LangballigausLeadingLightsAreInStep) {
    const Light* front = find("sonderborg", "Langballigau (G.) Range, front");
    ASSERT_NE(front, nullptr);
    EXPECT_FALSE(front->rhythm.sync_group.empty());
    const auto same =
        std::count_if(lights("sonderborg").lights.begin(), lights("sonderborg").lights.end(),
                      [&](const Light& l) { return l.rhythm.sync_group == front->rhythm.sync_group; });
    EXPECT_EQ(same, 2);
}

}  // namespace
}  // namespace seaglare::lightdb
