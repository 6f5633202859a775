// Which layers of the skirt a disc is mixed from.
#pragma once

namespace seaglare::glare {

// A disc between two layers is mixed from them so that its second moment is right, times four: that of a disc is the square
// of its radius, and a layer, whose disc is drawn with whole cells, has a cell's more.
inline float layer_moment(float radius_nodes) {
    return radius_nodes > 0 ? radius_nodes * radius_nodes + 1.0F / 3 : 0.0F;
}

}  // namespace seaglare::glare
