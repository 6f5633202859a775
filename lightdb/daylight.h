// Whether it is day for the lamps: photometers switch lights off and lamps change to their intensity by day.
#pragma once

#include <optional>

namespace seaglare::lightdb {

// Adaptation luminances at which photometers switch. They are made for about 100 lx on a horizontal surface; a white
// one then has 100 / pi = 32 cd/m2. Assumed: two levels a factor of two apart, so that a cloud at dusk does not make a
// coast blink.
inline constexpr double day_above_cd_m2 = 30;
inline constexpr double night_below_cd_m2 = 15;

// Whether it is day at this adaptation luminance, given whether it was. Between the two levels it stays as it was; where
// nothing is known of before, it is night: a light too many misleads less than one too few. NaN changes nothing.
//
// The state makes frames depend on those before, so it belongs to what all channels share: a context holds it for its
// views, and get_eye_state / set_eye_state carry it to other processes.
constexpr bool is_day(double adaptation_luminance_cd_m2, std::optional<bool> was_day) {
    if (adaptation_luminance_cd_m2 > day_above_cd_m2) return true;
    if (adaptation_luminance_cd_m2 < night_below_cd_m2) return false;
    return was_day.value_or(false);
}

}  // namespace seaglare::lightdb
