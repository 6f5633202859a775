// The pictures and the profile of one pattern beside the reference: what seaglare-report psf shows first.
#pragma once

#include <string>

#include "host_stub/report/pattern_image.h"
#include "host_stub/report/psf_errors.h"
#include "host_stub/report/report_page.h"

namespace seaglare::report {

// NAME_night, _linear, _log, _false.png and NAME.exr; NAME_map.svg is the false-colour picture with its axes and scale.
void write_pictures(Page& page, const std::string& name, const std::string& what, const PatternImage& image);
// Production less the reference, pixel by pixel, in per cent of the reference's mean over the ring.
void write_difference(Page& page, const PatternImage& made, const PatternImage& truth);
// Radial averages and encircled energy, with the curves of CIE 135/1-1999 and of Spencer et al. 1995.
void write_profiles(Page& page, const Subject& subject, const PatternImage& made, const PatternImage& truth);

}  // namespace seaglare::report
