// Real lights from the project's light files, seen from either side of every limit that the List of Lights gives them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>

#include "lightdb/json/value.h"
#include "tests/accuracy/channel.h"
#include "tests/accuracy/displayed.h"

namespace seaglare::test {
namespace {

constexpr double deg = std::numbers::pi / 180;
constexpr double two_miles_m = 2 * 1852;

struct Place {
    double lat_deg, lon_deg, height_m;
};

// WGS 84, written anew: the product's own geodesy must not judge itself.
struct Radii {
    double meridian_m, prime_vertical_m;
};
Radii radii_at(double lat_deg) {
    constexpr double a = 6378137, e2 = 0.0066943799901413;
    const double s = std::sin(lat_deg * deg);
    const double w = 1 - e2 * s * s;
    return {a * (1 - e2) / std::pow(w, 1.5), a / std::sqrt(w)};
}
Point earth_centred(const Place& p) {
    constexpr double e2 = 0.0066943799901413;
    const double n = radii_at(p.lat_deg).prime_vertical_m;
    const double c = std::cos(p.lat_deg * deg);
    return {(n + p.height_m) * c * std::cos(p.lon_deg * deg),
            (n + p.height_m) * c * std::sin(p.lon_deg * deg),
            (n * (1 - e2) + p.height_m) * std::sin(p.lat_deg * deg)};
}
// East and north on the tangent plane at the origin, up = height: the flat world of the header.
Point world_of(const Place& p, const Place& origin) {
    const Point a = earth_centred(p);
    const Point o = earth_centred(origin);
    const Point d = {a[0] - o[0], a[1] - o[1], a[2] - o[2]};
    const double sl = std::sin(origin.lat_deg * deg), cl = std::cos(origin.lat_deg * deg);
    const double so = std::sin(origin.lon_deg * deg), co = std::cos(origin.lon_deg * deg);
    return {-so * d[0] + co * d[1], -sl * co * d[0] - sl * so * d[1] + cl * d[2], p.height_m};
}
// The place two miles from a light from which it bears `bearing_deg` (true, at the light's meridian as charts draw it).
Place seaward_of(const Place& light, double bearing_deg, double height_m) {
    const Radii r = radii_at(light.lat_deg);
    const double north_m = -two_miles_m * std::cos(bearing_deg * deg);
    const double east_m = -two_miles_m * std::sin(bearing_deg * deg);
    const double middle_lat = light.lat_deg + north_m / r.meridian_m / deg / 2;
    return {
        light.lat_deg + north_m / r.meridian_m / deg,
        light.lon_deg + east_m / (radii_at(middle_lat).prime_vertical_m * std::cos(middle_lat * deg)) / deg,
        height_m};
}

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// One light of a file, alone: the others are switched off.
struct Station {
    Place place;
    std::vector<std::array<double, 2>> sectors;  // from, to
    std::string colours;                         // a letter each
};

// The file's own numbers; the record counts the file's lights in their order, which is the order of list_lights.
Station isolate(Channel& channel, const json::Document& file, const std::string& name) {
    const auto& records = file.root().find("lights")->array();
    std::vector<seaglare_light_id> ids(records.size() + 8);
    std::uint32_t count = 0;
    channel.plugin()->list_lights(channel.context(), ids.data(), static_cast<std::uint32_t>(ids.size()),
                                  &count);
    EXPECT_EQ(count, records.size());
    Station station;
    std::size_t found = 0;
    for (std::size_t i = 0; i < records.size(); ++i) {
        auto update = sized<seaglare_light_update>();
        update.id = ids[i];
        update.set = SEAGLARE_SET_ON;
        update.on = records[i].find("name")->string() == name ? 1 : 0;
        EXPECT_EQ(channel.plugin()->update_lights(channel.context(), &update, 1, 0), SEAGLARE_OK);
        if (update.on == 0) continue;
        ++found;
        station.place = {records[i].find("lat")->number(), records[i].find("lon")->number(),
                         records[i].find("height_m")->number()};
        for (const json::Value& sector : records[i].find("sectors")->array()) {
            station.sectors.push_back({sector.find("from")->number(), sector.find("to")->number()});
            station.colours += sector.find("colour")->string()[0];
        }
    }
    EXPECT_EQ(found, 1U) << name;
    return station;
}

// What is seen of the light on a bearing, at the first moment of 20 s in which it is lit; nothing when it stays dark.
std::optional<Displayed> seen_on(Channel& channel, const Station& station, const Place& origin,
                                 double bearing_deg) {
    const Place eye = seaward_of(station.place, bearing_deg, 12);
    channel.place_eye(world_of(eye, origin));
    channel.look_at(world_of(station.place, origin));
    for (int step = 0; step < 80; ++step) {
        channel.draw_black();
        seaglare_frame frame = channel.frame();
        frame.time_s = 5000.02 + step * 0.25;
        const seaglare_result drawn = channel.render(frame);
        EXPECT_GE(drawn, 0) << channel.last_error();
        if (drawn == SEAGLARE_OK)
            return displayed(channel.picture(), channel.width_px(), channel.height_px(), 5);
    }
    return std::nullopt;
}

// The letter of the hue that dominates; W when none does.
char hue_of(const Displayed& d) {
    const auto& [r, g, b] = d.linear;
    if (r > 1.6 * g && r > 1.6 * b) return 'R';
    if (g > 1.3 * r && g > b) return 'G';
    const double most = std::max({r, g, b}), least = std::min({r, g, b});
    return least > 0.6 * most ? 'W' : '?';
}

class AccuracySector : public ::testing::Test {
  protected:
    void check(const std::string& file_name, const Place& origin, const std::vector<std::string>& names) {
        ChannelOptions options;
        options.quality.threshold_codes = 0.25;
        options.width_px = options.height_px = 96;
        options.origin_latitude_deg = origin.lat_deg;
        options.origin_longitude_deg = origin.lon_deg;
        SEAGLARE_CHANNEL(channel, options);
        const std::string path = SEAGLARE_SOURCE_DIR "/config/lights/" + file_name;
        ASSERT_EQ(channel.plugin()->load_lights(channel.context(), path.c_str()), SEAGLARE_OK)
            << channel.last_error();
        const json::Document file = json::parse(text_of(path), path);
        for (const std::string& name : names) {
            const Station station = isolate(channel, file, name);
            for (std::size_t i = 0; i < station.sectors.size(); ++i) {
                expect(channel, station, origin, name, station.sectors[i][0] + 0.2, station.colours[i]);
                expect(channel, station, origin, name, station.sectors[i][1] - 0.2, station.colours[i]);
                // Beyond a limit where no other sector begins the light is obscured.
                const bool joined =
                    std::any_of(station.sectors.begin(), station.sectors.end(), [&](const auto& s) {
                        return std::fmod(s[0], 360) == std::fmod(station.sectors[i][1], 360);
                    });
                if (!joined) expect(channel, station, origin, name, station.sectors[i][1] + 0.2, '-');
            }
        }
        std::printf("  %s: %d views of %zu lights\n", file_name.c_str(), views_, names.size());
    }
    void expect(Channel& channel, const Station& station, const Place& origin, const std::string& name,
                double bearing_deg, char colour) {
        ++views_;
        const auto seen = seen_on(channel, station, origin, bearing_deg);
        if (colour == '-') {
            EXPECT_FALSE(seen.has_value()) << name << " on " << bearing_deg;
            return;
        }
        ASSERT_TRUE(seen.has_value()) << name << " is dark on " << bearing_deg;
        EXPECT_EQ(hue_of(*seen), colour) << name << " on " << bearing_deg << ": " << seen->linear[0] << " "
                                         << seen->linear[1] << " " << seen->linear[2];
    }
    int views_ = 0;
};

// The limits as the List of Lights prints them, so that a light file gone wrong cannot bless itself.
TEST_F(AccuracySector, KalkgrundShowsThePrintedColoursOnEitherSideOfItsLimits) {
    const Place origin = {54.9, 9.78, 0};
    ChannelOptions options;
    options.quality.threshold_codes = 0.25;
    options.width_px = options.height_px = 96;
    options.origin_latitude_deg = origin.lat_deg;
    options.origin_longitude_deg = origin.lon_deg;
    SEAGLARE_CHANNEL(channel, options);
    const std::string path = SEAGLARE_SOURCE_DIR "/config/lights/sonderborg.json";
    ASSERT_EQ(channel.plugin()->load_lights(channel.context(), path.c_str()), SEAGLARE_OK)
        << channel.last_error();
    const json::Document file = json::parse(text_of(path), path);
    const Station station = isolate(channel, file, "Kalkgrund (G.)");
    const struct {
        double limit_deg;
        char before, after;
    } limits[] = {{252.6, 'W', 'G'}, {258, 'G', 'W'}, {265, 'W', 'R'}, {292, 'R', 'W'},
                  {157, 'G', 'W'},   {164, 'W', 'R'}, {12, 'R', 'W'}};
    for (const auto& limit : limits) {
        expect(channel, station, origin, "Kalkgrund", limit.limit_deg - 0.2, limit.before);
        expect(channel, station, origin, "Kalkgrund", limit.limit_deg + 0.2, limit.after);
    }
}

// Far from the light its meridian and the scene's are not parallel: 40 km east of the origin they differ by half a degree,
// more than the 0.2 degrees tested here.
TEST_F(AccuracySector, HoldForALightWhoseMeridianIsNotTheScenes) {
    check("sonderborg.json", {54.9, 9.2, 0}, {"Kalkgrund (G.)"});
}

TEST_F(AccuracySector, OfSonderborgsWatersAreWhereTheListOfLightsHasThem) {
    check("sonderborg.json", {54.9, 9.78, 0}, {"Kalkgrund (G.)", "Ballebro", "Sottrupskov"});
}

TEST_F(AccuracySector, OfTheGreatBeltAreWhereTheListOfLightsHasThem) {
    check("great_belt.json", {55.5, 10.95, 0},
          {"Romso Tue, 24", "Knudshoved", "Korshavn", "Agerso Flak", "Vengeancegrund, 31",
           "Nyborg Fjord, Avernakke Pynt, Mole, head"});
}

}  // namespace
}  // namespace seaglare::test
