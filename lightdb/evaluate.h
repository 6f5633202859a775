// All lights, for one eye at one instant: from the database to point sources with their illuminance at the
// eye. Every light left out is counted with its reason.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "glare/frame.h"
#include "lightdb/light_store.h"

namespace seaglare::lightdb {

// Adaptation luminance above which lights with a photometer are off. Photometers switch at about 100 lx on a
// horizontal surface; the luminance of a white one is then 100 / pi = 32 cd/m2. One sharp value for both
// directions: a state that remembers would make channels disagree.
inline constexpr double photometer_off_above_cd_m2 = 30;

struct Observer {
    std::array<double, 3> eye_m{};  // East-North-Up of the scene
    std::array<double, 16>
        view_from_scene{};  // column-major, rigid (a reflection is allowed: left-handed hosts)
    double time_s = 0;
    double exposure_s = 1.0 / 60;  // rhythms are averaged over it; at most 0.05 is used
    double extinction_per_m = 0;   // rho = -ln 0.05 / V_met; 0: clear
    double adaptation_luminance_cd_m2 = 0.001;
    bool geographic_horizon = true;  // a light below its geographical range is not seen
    bool round_earth = false;  // the scene's sea curves down from the tangent plane: heights above it follow
    double water_level_m = 0;  // z of the water at the scene's origin
    std::uint64_t seed = 0;
};

struct Evaluated {
    std::vector<glare::PointSource> sources;
    std::vector<LightIndex> light;  // which light each source is; parallel to `sources`
    std::uint32_t total = 0;        // live lights = sources + dark + below_horizon
    std::uint32_t dark =
        0;  // off, eclipsed, out of sector or profile, photometer, underflown in fog, not finite
    std::uint32_t below_horizon = 0;
};

// Illuminance at the eye by the chain I h v b T / max(D, r)^2: intensity, sector, vertical profile, rhythm
// over the exposure, air, distance. A light of a body that was never posed stands at the scene's origin with
// it. Reuses the capacity of `out`: no allocation in a steady frame. Never throws, never gives a value that
// is not finite.
void evaluate(const LightStore& store, const Observer& observer, Evaluated& out);

// What one light sends towards the eye before air, distance and horizon: candela of each colour. For tools
// and tests.
std::array<double, colour_count> intensity_towards_cd(const LightStore& store, const Light& light,
                                                      const Observer& observer);

// Where a light is in the scene: its position, or its body's pose applied to it.
std::array<double, 3> scene_position_m(const LightStore& store, const Light& light);

}  // namespace seaglare::lightdb
