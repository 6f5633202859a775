// Between a pattern for each lamp and one for all: what a time budget fades through.
#pragma once

#include "glare/psf/pattern.h"

namespace seaglare::glare {

// out: the pattern with every lamp's core and skirt mixed with those of the first lamp, of which `blend` (0 ... 1) is taken.
// Energies of all are alike, so none is lost. Its memory is used again; its generation is new.
void blend_towards_first_lamp(const Pattern& pattern, double blend, Pattern& out);

}  // namespace seaglare::glare
