// How the skirt is interpolated between its nodes. Near the light it falls with the second to third power of the distance:
// a straight line between two nodes would be 25 to 50 % too bright there. What is interpolated is therefore the value times
// a weight, the squared distance and a little more, which is much flatter; the result is divided by the weight again.
//
//   skirt(u) = sum of b_k(u) skirt_k w(k) / w(u),   w(u) = |u|^2 + softening, u in nodes, b bilinear
//
// A disc's layer is flat inside its radius, so its softening grows with that. Between nodes 4 minutes of arc apart, Airy's
// rings (6 mm pupil) are then right to 6 % where straight lines were off by 26 %.
#pragma once

#include <cstddef>
#include <span>

namespace seaglare::glare {

inline constexpr float point_softening_nodes2 = 0.5F;

// shaders/skirt.frag.glsl has the same.
inline float skirt_softening(float layer_radius_nodes) {
    return point_softening_nodes2 + layer_radius_nodes * layer_radius_nodes;
}

// A disc between two layers is mixed from them so that its second moment is right, times four: that of a disc is the square
// of its radius, and a layer, whose disc is drawn with whole cells, has a cell's more. With radii from 0 to 1.5 nodes the
// skirt is then off by 4 % at most, where it was 6 %, and more layers in between help no more: they all are a cell wider.
inline float layer_moment(float radius_nodes) {
    return radius_nodes > 0 ? radius_nodes * radius_nodes + 1.0F / 3 : 0.0F;
}

// One layer's nodes, (2 radius + 1)^2 of four channels, times their weights. `to` is as long as `from`.
inline void weigh_skirt(std::span<const float> from, int radius_nodes, float softening, std::span<float> to) {
    std::size_t i = 0;
    for (int b = -radius_nodes; b <= radius_nodes; ++b)
        for (int a = -radius_nodes; a <= radius_nodes; ++a) {
            const float weight = static_cast<float>(a * a + b * b) + softening;
            for (std::size_t end = i + 4; i < end; ++i)
                to[i] = from[i] * weight;
        }
}

}  // namespace seaglare::glare
