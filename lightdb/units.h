// The units that lists of lights and photometry are written in.
#pragma once

namespace seaglare::lightdb {

inline constexpr double metres_per_nautical_mile = 1852;  // exact, international nautical mile
inline constexpr double metres_per_foot = 0.3048;         // exact, international foot

}  // namespace seaglare::lightdb
