// The two sources with a spectrum of the caller's own: for tests against closed forms, and for lamps that are not white.
#pragma once

#include <memory>
#include <vector>

#include "glare/colour/navigation_colours.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// As make_cl_pattern_source and make_cpu_pattern_source; `samples` take the place of the settings' wavelengths. A
// channel to which no sample contributes stays black.
std::unique_ptr<PatternSource> make_cl_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                      std::uint64_t seed, LampSamples samples);
std::unique_ptr<PatternSource> make_cpu_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                       std::uint64_t seed, LampSamples samples);

}  // namespace seaglare::glare
