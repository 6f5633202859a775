// One navigation light as data: what files and the C interface fill in, and what evaluation reads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightdb/light_spectrum.h"
#include "lightdb/photometric_solid.h"

namespace seaglare::lightdb {

enum class Colour : std::uint8_t { white, red, green, yellow, blue, orange, violet };
inline constexpr int colour_count = 7;
static_assert(LightSpectrum::colours == colour_count);

// A light phase or an eclipse. Phases follow each other and sum to the period.
struct Phase {
    double duration_s = 0;
    bool lit = false;
    Colour colour = Colour::white;  // while lit; lights with sectors of their own colours show the sector's
    double level = 1;  // share of the full intensity while lit: the steady part of a fixed and flashing light
    friend bool operator==(const Phase&, const Phase&) = default;
};

struct Rhythm {
    std::vector<Phase> phases;  // empty: fixed
    double period_s = 0;        // sum of the phases; 0: fixed
    std::string sync_group;     // lights of one group share their phase
    double delay_s = 0;         // begins its period this much later than its group does
    // Of the lamp: its light approaches what the phase asks for exponentially and has come 90 % of the way after this
    // time. 0: at once, as an LED or a shutter; an incandescent lamp takes tenths of a second.
    double rise_s = 0;
    double fall_s = 0;
    friend bool operator==(const Rhythm&, const Rhythm&) = default;
};

// Bearings in degrees clockwise from `from_deg` to `to_deg`, may wrap through 000. A vertical sector is narrower than the
// whole range of elevations.
struct Sector {
    std::optional<Colour> colour;  // nullopt: obscured
    double from_deg = 0;
    double to_deg = 0;
    double intensity_factor = 1;      // below 1: unintensified
    double transition_deg = 0;        // width over which the edge grades, centred on the limit
    double from_elevation_deg = -90;  // above the light's own horizon
    double to_elevation_deg = 90;
    friend bool operator==(const Sector&, const Sector&) = default;
};
enum class SectorReference : std::uint8_t { from_seaward, outward_from_ahead };

// Intensity against an angle, linear between samples. Vertical: elevation in degrees above the light's own
// horizon, clamped at the ends. Horizontal: bearing from ahead, clockwise, periodic.
struct AngleTable {
    std::vector<double> angle_deg;  // ascending
    std::vector<double> factor;     // same length, >= 0
    friend bool operator==(const AngleTable&, const AngleTable&) = default;
};

// A beam that turns: the optic's intensity against the bearing from its own zero, carried round once in |period_s|.
struct RotatingBeam {
    double period_s = 0;  // clockwise seen from above; negative: the other way; 0: nothing turns
    AngleTable beam;      // periodic; bearing clockwise from the optic's zero
    friend bool operator==(const RotatingBeam&, const RotatingBeam&) = default;
};

struct Light {
    std::string name;
    std::array<double, 3> position_m{};  // East-North-Up of the scene, or of the body
    bool geographic = false;             // position came from lat/lon
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;  // above the water
    double radius_m = 0.05;
    std::array<double, colour_count> intensity_cd{};      // per colour; 0: the light has no such colour
    std::array<double, colour_count> day_intensity_cd{};  // while it is day; all 0: as by night
    std::string character;                                // chart notation as written
    Rhythm rhythm;
    std::vector<Sector> sectors;  // empty: all round
    SectorReference sector_reference = SectorReference::from_seaward;
    double true_north_deg = 0;  // at the light, clockwise from the scene's y axis (meridian convergence)
    AngleTable horizontal;      // from ahead, clockwise, periodic; empty: uniform
    AngleTable vertical;        // empty: uniform
    // Measured intensity over the sphere; then intensity_cd stands for its reference_cd. Empty: uniform.
    SharedSolid photometry;
    RotatingBeam rotation;
    std::optional<double>
        leading_bearing_deg;    // true, from seaward: of the leading line or the direction light
    std::uint32_t body_id = 0;  // 0: fixed to the world
    // Quaternion x y z w: scene (or body) from the light's frame, whose x points to starboard, y ahead and z
    // up. So no rotation means upright, ahead to the north (or to the body's y axis, its bow).
    std::array<double, 4> orientation{0, 0, 0, 1};
    bool day_off = false;          // a photometer switches it off by day
    SharedLightSpectrum spectrum;  // of its lamps; none: its colours' own
    std::string source;            // where the facts come from, e.g. "NGA Pub. 116, 4640"
    std::uint64_t stable_key = 0;  // hash of the light's own data: phase never depends on load order
    // Set at run time.
    bool on = true;
    float visibility = 1;
    friend bool operator==(const Light&, const Light&) = default;
};

}  // namespace seaglare::lightdb
