// Intensity against an angle, by tables: linear between samples.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "lightdb/light.h"

namespace seaglare::lightdb {

// Factor at an angle in degrees; beyond the ends the end's own factor. An empty table is 1 everywhere, a
// table of one sample is constant. NaN gives 0.
double clamped_factor(const AngleTable& table, double angle_deg);

// The same with period 360 degrees: between the last sample and the first it runs on through 360 = 0.
double periodic_factor(const AngleTable& table, double angle_deg);

// A vertical profile that files call by its name, or nothing. Elevation in degrees, fraction of the peak:
// "uniform"       the same in all directions.
// "sabik_vp"      Sabik VP LED lantern: half of the peak at +-5 degrees, a tenth at +-10 (data sheet).
// "colreg_power"  the least that COLREG 1972 Annex I section 10(a) allows: 100 % to +-5 degrees, 60 % to
// +-7.5. "colreg_sail"   section 10(b), sailing vessels under way: 100 % to +-5 degrees, 50 % to +-25.
std::optional<AngleTable> named_vertical_profile(std::string_view name);
std::span<const std::string_view> vertical_profile_names();

}  // namespace seaglare::lightdb
