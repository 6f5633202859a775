// What a light sends towards an eye at an instant: candela of each colour, from its rhythm, sectors, profiles and rotation.
// Before air, distance and horizon, which are evaluate's.
#pragma once

#include <array>
#include <cstdint>

#include "lightdb/light.h"
#include "lightdb/rhythm.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

using Intensities = std::array<double, colour_count>;

struct Exposure {
    double end_s = 0;  // absolute time
    double duration_s = 1.0 / 60;
    std::uint64_t seed = 0;
    bool is_day = false;  // a light that has day intensities shows them
    std::uint64_t stable_key =
        0;  // of the light, where one description serves many lights; 0: light.stable_key
};

// What the light's phase hangs on.
inline std::uint64_t key_of(const Light& light, const Exposure& exposure) {
    return exposure.stable_key != 0 ? exposure.stable_key : light.stable_key;
}

// Candela of each colour while it is night, or day. By day a light without day intensities burns as by night.
const Intensities& intensities_cd(const Light& light, bool is_day);

// Where the eye is, as the light sees it.
struct Sightline {
    Vec3 to_eye_m;             // scene, East-North-Up
    Vec3 to_eye_in_light_m;    // the light's own frame: x to starboard, y ahead, z up
    double elevation_deg = 0;  // of the eye above the light's own horizon
};

// Whether the light looks different from different directions: else emitted_cd() does not read its sightline.
bool has_direction(const Light& light);

// Share of the exposure that each colour of the rhythm is lit.
LitFractions lit_during(const Light& light, const Exposure& exposure);

// Whether nothing of the rhythm is lit.
bool is_dark(const LitFractions& lit);

// Candela of each colour towards the eye, averaged over the exposure that gave `lit`: the colours' intensities by their
// sectors, times vertical and horizontal table, photometric solid and turning beam. Sectors outward from ahead, tables,
// solid and beam lie in the light's own frame and so turn, roll and pitch with its body; sectors from seaward are true
// bearings and stay. A turning beam is averaged over the exposure apart from the rhythm: what shares their times with each
// other (an optic with a shutter) is not resolved within one frame. leading_bearing_deg changes nothing here: it says which
// line the light was set up for, and checks of a file compare it; what the light shows there is its sectors' and tables'.
//
// Allocates nothing, and works out an angle only for a light that something of depends on it.
Intensities emitted_cd(const Light& light, const LitFractions& lit, const Exposure& exposure,
                       const Sightline& sightline);

}  // namespace seaglare::lightdb
