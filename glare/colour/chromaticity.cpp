#include "glare/colour/chromaticity.h"

#include <algorithm>

namespace seaglare::glare {

namespace {

// IEC 61966-2-1:1999 amendment 1 gives the two to seven digits; they are each other's inverse to 1e-6.
constexpr std::array<std::array<double, 3>, 3> srgb_from_xyz_matrix = {{
    {3.2409699419, -1.5373831776, -0.4986107603},
    {-0.9692436363, 1.8759675015, 0.0415550574},
    {0.0556300797, -0.2039769589, 1.0569715142},
}};
constexpr std::array<std::array<double, 3>, 3> xyz_from_srgb_matrix = {{
    {0.4123907993, 0.3575843394, 0.1804807884},
    {0.2126390059, 0.7151686788, 0.0721923154},
    {0.0193308187, 0.1191947798, 0.9505321522},
}};

std::array<double, 3> product(const std::array<std::array<double, 3>, 3>& matrix,
                              const std::array<double, 3>& vector) {
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = matrix[i][0] * vector[0] + matrix[i][1] * vector[1] + matrix[i][2] * vector[2];
    return result;
}

}  // namespace

double luminance(const std::array<double, 3>& linear_rgb) {
    return product(xyz_from_srgb_matrix, linear_rgb)[1];
}

std::array<double, 3> srgb_from_xyz(const Xyz& xyz) {
    return product(srgb_from_xyz_matrix, {xyz.x, xyz.y, xyz.z});
}

Xyz xyz_from_srgb(const std::array<double, 3>& linear_rgb) {
    const auto xyz = product(xyz_from_srgb_matrix, linear_rgb);
    return {xyz[0], xyz[1], xyz[2]};
}

Chromaticity chromaticity_of(const Xyz& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    if (!(sum > 0)) return srgb_white;
    return {xyz.x / sum, xyz.y / sum};
}

Xyz xyz_from_chromaticity(const Chromaticity& xy, double luminance_y) {
    if (!(xy.y > 0)) return {};
    const double scale = luminance_y / xy.y;
    return {xy.x * scale, luminance_y, (1 - xy.x - xy.y) * scale};
}

std::array<double, 3> unit_luminance_in_gamut(const std::array<double, 3>& linear_rgb) {
    const double y = luminance(linear_rgb);
    if (!(y > 0)) return {1, 1, 1};
    std::array<double, 3> unit = {linear_rgb[0] / y, linear_rgb[1] / y, linear_rgb[2] / y};
    // Mixing with white of the same luminance keeps the luminance: c' = 1 + t (c - 1) >= 0 for t <= 1 / (1 - c).
    double kept = 1;
    for (double c : unit)
        if (c < 0) kept = std::min(kept, 1 / (1 - c));
    for (double& c : unit)
        c = std::max(0.0, 1 + kept * (c - 1));
    return unit;
}

}  // namespace seaglare::glare
