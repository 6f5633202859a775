// All lights, for one eye at one instant: from the database to point sources with their illuminance at the eye. Every
// light left out is counted with its reason.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "glare/frame.h"
#include "lightdb/light_store.h"

namespace seaglare::lightdb {

struct Observer {
    std::array<double, 3> eye_m{};              // East-North-Up of the scene
    std::array<double, 16> view_from_scene{};   // column-major, rigid (a reflection is allowed: left-handed hosts)
    double time_s = 0;
    double exposure_s = 1.0 / 60;               // rhythms are averaged over it; at most 0.05 is used
    double extinction_per_m = 0;                // rho = -ln 0.05 / V_met; 0: clear
    double adaptation_luminance_cd_m2 = 0.001;
    bool geographic_horizon = true;             // a light below its geographical range is not seen
    std::uint64_t seed = 0;
};

struct Evaluated {
    std::vector<glare::PointSource> sources;
    std::vector<LightIndex> light;              // which light each source is; parallel to `sources`
    std::uint32_t total = 0;
    std::uint32_t dark = 0;                     // off, eclipsed, out of sector or profile, photometer
    std::uint32_t below_horizon = 0;
};

// Reuses the capacity of `out`: no allocation in a steady frame.
void evaluate(const LightStore& store, const Observer& observer, Evaluated& out);

}  // namespace seaglare::lightdb
