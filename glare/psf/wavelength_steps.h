// How finely a pattern's wavelengths lie beside one another: so that its needles do not break into beads, and so that what is
// done for each of them in every channel is done for few. Pure functions.
#pragma once

#include <vector>

#include "glare/colour/spectrum.h"

namespace seaglare::glare {

// Into how many parts each sample of the spectrum is divided for a pattern that ends `radius_nodes` from its middle: as many
// as bring neighbours to within `step_nodes` of each other half way to the rim, at 555 nm, at most 16. Scaling by the
// wavelength moves what stands at r by r times the relative step. 1 where step_nodes is 0 or there is one sample.
int wavelength_parts(const std::vector<SpectralSample>& samples, double radius_nodes, double step_nodes);

// Each sample as `parts` with equal shares of its weight, spread over its band. The step is that between neighbours.
std::vector<SpectralSample> divided(const std::vector<SpectralSample>& samples, int parts);

// Neighbours within a thirtieth of the spectrum get the mean of their weights, so that they are added up before they are
// coloured. Every channel's sum stays, and the mean wavelength of each band's luminance, for which its samples move by up to
// half their step. Fewer than sixty samples are left alone.
std::vector<SpectralSample> shared_colours(std::vector<SpectralSample> samples);

}  // namespace seaglare::glare
