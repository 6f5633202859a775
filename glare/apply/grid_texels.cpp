#include "glare/apply/grid_texels.h"

namespace seaglare::glare {

void GridTexelMaker::make(const Pattern& pattern, GridTexels& to) {
    if (pattern.generation == to.generation && to.generation != 0) return;
    to.generation = 0;
    to.profile.update(pattern);
    departures_.resize(pattern.skirt.size());
    to.profile.departures(pattern, departures_);
    to.departures_scale = to_halves(departures_, to.departures);
    to.generation = pattern.generation;
}

}  // namespace seaglare::glare
