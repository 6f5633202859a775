// The CIE total glare spread function: the curve that the pattern follows beyond its simulated field, and from which
// apply knows how far glare can matter.
#pragma once

namespace seaglare::glare {

// CIE 135/1-1999, total glare: PSF in sr^-1 at an angle in degrees from the light, for an age in years and a
// pigmentation (0 very dark, 0.5 brown, 1 green, 1.2 light blue). The angle is clamped to 0 ... 90 degrees.
// shaders/cie_tail.glsl has the same in GLSL; tests compare what it draws with this.
double cie_total_glare_sr(double angle_deg, double age_years, double pigmentation);

// The half cosine that joins structure and curve: 1 up to `inner`, 0 from `outer` on.
double fade_window(double sine, double inner, double outer);

// The energy of the tail: the curve times (1 - fade_window), integrated over the hemisphere. As drawn: its last ten
// degrees before a quarter turn fade to zero.
double cie_tail_energy(double age_years, double pigmentation, double window_inner, double window_outer);

}  // namespace seaglare::glare
