// The colours that COLREG 1972 Annex I section 7 allows, as regions of CIE 1931 x and y.
#pragma once

#include <span>

#include "glare/colour/chromaticity.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

// Corners around the region; none for blue, orange and violet, which the rules do not know.
std::span<const glare::Chromaticity> colreg_region(Colour colour);

// Whether a chromaticity lies in a region, convex or not, or on its edge, to within the digits of the corners.
bool inside_region(std::span<const glare::Chromaticity> corners, glare::Chromaticity xy);

}  // namespace seaglare::lightdb
