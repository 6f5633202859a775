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
// "colreg_power"  COLREG 1972 Annex I section 10(a), electric lights but for sailing vessels under way: the required
//                 intensity to +-5 degrees, at least 60 % of it to +-7.5.
// "colreg_sail"   section 10(b), sailing vessels under way: the required intensity to +-5 degrees, at least 50 % to +-25.
// The two of COLREG fall evenly from the one share to the other. Beyond its last angle every profile keeps its last share:
// there the rule asks for nothing and the data sheet says nothing, and a lantern near by is still seen to burn.
std::optional<AngleTable> named_vertical_profile(std::string_view name);
std::span<const std::string_view> vertical_profile_names();

}  // namespace seaglare::lightdb
