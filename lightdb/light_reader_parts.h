// The parts a light's JSON object is read in. Internal to lightdb/light_reader*.cpp and light_writer*.cpp.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/character.h"
#include "lightdb/json/reader.h"
#include "lightdb/light.h"
#include "lightdb/light_reader.h"

namespace seaglare::lightdb {

using ColourSet = std::array<bool, colour_count>;

constexpr std::size_t index_of(Colour colour) {
    return static_cast<std::size_t>(colour);
}

struct ColourName {
    std::string_view letters;  // as charts write it
    std::string_view name;
    Colour colour;
};
inline constexpr ColourName colour_names[] = {
    {"W", "white", Colour::white},    {"R", "red", Colour::red},    {"G", "green", Colour::green},
    {"Y", "yellow", Colour::yellow},  {"Bu", "blue", Colour::blue}, {"Or", "orange", Colour::orange},
    {"Vi", "violet", Colour::violet},
};

// The colours that the light shows somewhere at some time, for which it needs an intensity, and those that its character
// names besides.
struct Colours {
    ColourSet shown{};
    ColourSet named{};
};
// Needs the light's rhythm and sectors.
Colours colours_of(const Light& light, const std::optional<Character>& character);

// The parts throw json::Error at what is wrong. They write to the members of `light` that they are named for.

Colour read_colour(const json::Value& value);

std::optional<Character> read_character(json::ObjectReader& reader, Light& light,
                                        std::vector<std::string>& warnings);
// "phases" or "sigseq", and what belongs to the timing of the lamp.
void read_rhythm(json::ObjectReader& reader, const std::optional<Character>& character, Light& light,
                 std::vector<std::string>& warnings);

void read_sectors(json::ObjectReader& reader, Light& light);
void read_profiles(json::ObjectReader& reader, Light& light);
void read_rotation(json::ObjectReader& reader, Light& light);
// `beams` equal beams, the first in the optic's zero, whose factor falls from 1 as cos^2 and is 1/2 at +-width_deg / 2 from
// the middle and 0 at +-width_deg. Precondition: 1 <= beams <= most_beams, 0 < beams * width_deg <= 180.
inline constexpr int most_beams = 24;
AngleTable equal_beams(int beams, double width_deg);

// Its measured intensity, from the photometric file that it names, whose own warnings are told once.
void read_photometry(json::ObjectReader& reader, LightFolder& folder, Light& light,
                     std::vector<std::string>& warnings);
// Of a light whose file says nothing of its size.
double default_radius_m(const Light& light);

// By night and by day. Needs rhythm, sectors and photometry.
void read_intensities(json::ObjectReader& reader, const std::optional<Character>& character, Light& light);

// Its lamps. Needs intensities, by night and by day.
void read_spectrum(json::ObjectReader& reader, LightFolder& folder, Light& light,
                   std::vector<std::string>& warnings);
// The colours that it has an intensity for, by night or by day.
ColourSet lit_colours(const Light& light);

// What files may hold, which is what evaluation is tested for.
inline constexpr double farthest_m = 1e7;
inline constexpr double brightest_cd = 1e8;
inline constexpr double longest_range_nm = 38;      // 1e8 cd by the nominal range's formula
inline constexpr double longest_day_range_nm = 15;  // and by that of the day

}  // namespace seaglare::lightdb
