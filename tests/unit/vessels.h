// Vessels for the tests of colreg*.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "lightdb/colreg.h"

namespace seaglare::lightdb::test {

inline Vessel vessel_of(VesselKind kind, double length_m, double breadth_m = 0) {
    Vessel vessel;
    vessel.kind = kind;
    vessel.length_m = length_m;
    vessel.breadth_m = breadth_m > 0 ? breadth_m : length_m / 6;
    return vessel;
}

inline const Light& find(const std::vector<Light>& lights, const std::string& name) {
    const auto found =
        std::find_if(lights.begin(), lights.end(), [&](const Light& light) { return light.name == name; });
    if (found == lights.end()) throw std::runtime_error("no " + name);
    return *found;
}

inline Colour colour_of(const Light& light) {
    const auto found =
        std::find_if(light.intensity_cd.begin(), light.intensity_cd.end(), [](double i) { return i > 0; });
    return static_cast<Colour>(found - light.intensity_cd.begin());
}

}  // namespace seaglare::lightdb::test
