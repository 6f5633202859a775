// A glare pattern as one image of sr^-1, whoever made it, and what is measured and drawn of it.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "glare/psf/pattern.h"
#include "glare/reference/reference_pattern.h"

namespace seaglare::report {

// (2 radius + 1)^2 pixels of linear sRGB (signed) and scotopic, sr^-1; rows from -v to +v.
struct PatternImage {
    int radius = 0;
    double pitch = 0;
    std::vector<reference::Rgbv> pixels;

    int side() const { return 2 * radius + 1; }
    const reference::Rgbv& at(int a, int b) const {
        return pixels[static_cast<std::size_t>(b + radius) * static_cast<std::size_t>(side()) +
                      static_cast<std::size_t>(a + radius)];
    }
};

// Core + skirt + tail of a white point light. The core is laid on the pixels as its window shares it out, which is what
// the reference would have there; the product spreads it over a footprint that does not flicker.
PatternImage image_of(const glare::Pattern& pattern, double core_radius_nodes, int radius);
PatternImage image_of(const reference::ReferencePattern& pattern);

double photopic(const reference::Rgbv& value);

// Mean over rings, and the energy inside: rings a pixel wide near the light, then growing by 3 %.
struct Ring {
    double angle_deg = 0;  // mean of its pixels
    double outer_deg = 0;
    double mean_sr = 0;        // photopic
    double energy_inside = 0;  // up to outer_deg
};
std::vector<Ring> rings_of(const PatternImage& image);

// Spencer et al. 1995, "Physically-based glare effects for digital images": sr^-1 at an angle in degrees.
double spencer_photopic_sr(double angle_deg);
double spencer_scotopic_sr(double angle_deg);

// PNGs, `zoom` pixels for one. `illuminance_lx` of the light at the eye by starlight.
void write_linear_png(const PatternImage& image, const std::filesystem::path& path, int zoom,
                      double white_sr);
void write_log_png(const PatternImage& image, const std::filesystem::path& path, int zoom);
void write_false_colour_png(const PatternImage& image, const std::filesystem::path& path, int zoom);
void write_night_png(const PatternImage& image, const std::filesystem::path& path, int zoom,
                     double illuminance_lx);
// Photopic difference in parts of the truth's mean over the ring, -20 to 20 per cent: blue where there is too little, orange
// where there is too much, white where they agree.
void write_difference_png(const PatternImage& made, const PatternImage& truth,
                          const std::filesystem::path& path, int zoom);
// gnuplot commands for the colours' scale.
std::string false_colour_scale();
std::string difference_scale();
void write_image_exr(const PatternImage& image, const std::filesystem::path& path);

}  // namespace seaglare::report
