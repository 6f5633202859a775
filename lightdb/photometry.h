// From a lamp's candela to lux at the eye, and from the nominal ranges of lists of lights to candela. Pure
// functions; distances in metres or, where the name says so, nautical miles.
#pragma once

#include "lightdb/units.h"

namespace seaglare::lightdb {

// The conventions behind a "nominal range": IALA E-200-2 (illuminance threshold of night, visibility 10 nm).
inline constexpr double nominal_visibility_nm = 10;
inline constexpr double night_threshold_lx = 2e-7;
inline constexpr double day_threshold_lx = 1e-3;

// The contrast left at the meteorological visibility: 5 % (WMO).
inline constexpr double visibility_contrast = 0.05;

// rho = -ln 0.05 / V in 1/m. V = infinity gives 0; V <= 0 or NaN gives infinity: nothing is seen.
double extinction_per_m(double meteorological_visibility_m);

// exp(-rho D): 1 at D = 0 whatever rho, exactly 0 where it underflows; never NaN for rho, D >= 0.
double transmission(double extinction_per_m, double distance_m);

// Illuminance in lux at a distance from a lamp: I T(D) / max(D, r)^2. At or inside the lamp (D <= r) it is
// that of its surface, I / r^2. Radii below a millimetre count as one. 0 for I <= 0, for infinite D and for
// NaN.
double illuminance_lx(double intensity_cd, double distance_m, double radius_m, double extinction_per_m);

// Intensity in cd that gives the threshold at that range: Allard's law, I = E_t d^2 0.05^(-d/V). 0 for a
// range <= 0 or NaN; may overflow to infinity for ranges of hundreds of miles.
double intensity_for_range_cd(double range_nm, double threshold_lx = night_threshold_lx,
                              double visibility_nm = nominal_visibility_nm);

// The inverse, by bisection (the law is monotonic), to the nearest double. 0 for an intensity <= 0 or NaN.
double range_for_intensity_nm(double intensity_cd, double threshold_lx = night_threshold_lx,
                              double visibility_nm = nominal_visibility_nm);

// Minimum intensity in cd of a ship's light for a range in nm: I = 3.43e6 T D^2 K^-D, T = 2e-7 lx, K = 0.8
// (COLREG 1972 Annex I section 8). K = 0.8 is a visibility of 13.4 nm: the nominal-range formula does not
// hold for ships.
double colreg_intensity_cd(double range_nm);

// Distance in nm at which a light dips below the horizon: 2.08 (sqrt h1 + sqrt h2), heights in m above the
// water, mean refraction (Admiralty List of Lights). Negative heights count as 0.
double geographical_range_nm(double height_m, double eye_height_m);

// Fraction, 0 ... 1, of a lamp that stands above the horizon: the part of its disc above the line that grazes
// the water. 1 where the lamp is nearer than the eye's own horizon.
double fraction_above_horizon(double distance_m, double lamp_height_m, double lamp_radius_m,
                              double eye_height_m);

// Intensity in cd that a steady light needs to be seen as far as this flash (Blondel and Rey 1911, a = 0.2
// s), for ranges only, never for the brightness of a picture. Duration in s; 0 for a duration <= 0.
double effective_intensity_cd(double intensity_cd, double duration_s);

}  // namespace seaglare::lightdb
