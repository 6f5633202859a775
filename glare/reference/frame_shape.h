// How one light of each lamp spreads, in the form that the frame reference draws: the definition of glare/psf/pattern.h
// (core, skirt, tail) in double precision, with the skirt resolved far below a pixel where it is steep.
//
// A pixel sees the skirt averaged over a square of one pitch around its middle, as the reference pattern does for pixels
// that are centred on the light; here for every place of the light under the grid. The core is what the window of
// core_radius_px takes of the light's energy at each angle (not at each node), and is drawn as the footprint.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "glare/psf/pattern.h"
#include "glare/reference/reference_pattern.h"

namespace seaglare::reference {

// Part of the skirt on a grid of its own: samples 1/per_px pixels apart, each the mean over a pixel around it; linear in
// between. Rows from -v to +v.
struct SkirtLevel {
    int per_px = 1;
    int radius = 0;  // (2 radius + 1)^2 samples
    std::vector<Rgbv> samples;
    // Of each row, the integral of its linear interpolant from the row's first sample, in samples.
    std::vector<Rgbv> integrals;

    int side() const { return 2 * radius + 1; }
    double reach_px() const { return static_cast<double>(radius) / per_px; }
    // At an offset from the light in pixels; zero outside.
    Rgbv at(double u_px, double v_px) const;
    // Mean over a disc of a radius in pixels around an offset, by exact chords of the interpolant.
    Rgbv over_disc(double u_px, double v_px, double radius_px) const;
    void integrate();  // fills `integrals`
};

// Production's skirt of a disc of one radius.
struct DiscLayer {
    double radius_px = 0;
    std::vector<SkirtLevel> levels;
};

struct LampShape {
    Rgbv core{};                     // energy, relative to the light's own in each channel
    std::vector<SkirtLevel> levels;  // they add up
    // Ascending, the first of radius 0; empty: every disc is integrated exactly. Discs in between are mixed from two, by
    // their second moments; larger ones are integrated.
    std::vector<DiscLayer> layers;
};

struct GlareShape {
    double pitch = 0;
    std::vector<LampShape> lamps;
    std::array<std::uint8_t, glare::most_lamps> shape_of_lamp{};
    double window_inner = 0;  // sin(angle): the simulated structure fades into the tail between the two
    double window_outer = 0;
    double tail_scale = 0;  // of the CIE curve
    double tail_age_years = 24;
    double tail_pigmentation = 0.5;
    // The simulated energy had to be multiplied by this to make core + skirt + tail what the pupil passes.
    double structure_scale = 1;
};

struct ShapeRequest {
    glare::EyeModel eye;
    double pupil_mm = 6;
    double time_s = 0;
    std::uint64_t seed = 1;
    double pitch = 1 / 869.1;
    double angular_scale = 1;
    double core_radius_px = 2;
    double window_inner = 0.06;
    double window_outer = 0.08;
    // Indices of lamps and their lines, in the order of GlareShape::lamps.
    std::vector<std::uint8_t> lamps;
    std::vector<std::vector<SpectralLine>> lines;
};

// Who makes the reference patterns: make_reference, or a store of those made before.
using PatternMaker = std::function<std::vector<ReferencePattern>(
    const ReferenceRequest&, const std::vector<std::vector<SpectralLine>>&)>;

// Throws std::invalid_argument for what this reference does not know: an eye with lashes, whose pattern depends on the
// place in the picture; one calibrated to the CIE's curve; one out of focus.
GlareShape make_shape(const ShapeRequest& request, const PatternMaker& maker);

// Production's own pattern and its layers: the reference for what accumulation alone does. Bilinear
// between nodes, as it is drawn.
GlareShape shape_of(const glare::Pattern& pattern);

}  // namespace seaglare::reference
