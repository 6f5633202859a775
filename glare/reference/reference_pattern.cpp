#include "glare/reference/reference_pattern.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "glare/colour/cie_tables.h"

namespace seaglare::reference {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix inverse(const Matrix& m) {
    Matrix out{};
    const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t r0 = (j + 1) % 3;
            const std::size_t r1 = (j + 2) % 3;
            const std::size_t c0 = (i + 1) % 3;
            const std::size_t c1 = (i + 2) % 3;
            out[i][j] = (m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0]) / det;
        }
    }
    return out;
}

// From the primaries and the white of IEC 61966-2-1.
Matrix linear_srgb_from_xyz() {
    constexpr std::array<std::array<double, 2>, 3> primaries = {{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}};
    constexpr std::array<double, 3> white = {0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
    Matrix m{};
    for (std::size_t p = 0; p < 3; ++p) {
        m[0][p] = primaries[p][0] / primaries[p][1];
        m[1][p] = 1;
        m[2][p] = (1 - primaries[p][0] - primaries[p][1]) / primaries[p][1];
    }
    const Matrix weights = inverse(m);
    for (std::size_t p = 0; p < 3; ++p) {
        const double share = weights[p][0] * white[0] + weights[p][1] * white[1] + weights[p][2] * white[2];
        for (auto& row : m)
            row[p] *= share;
    }
    return inverse(m);
}

// The share of sRGB's primaries in the luminance, IEC 61966-2-1.
double luminance_of(const Rgbv& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

// Area of the disc above the x axis between x0 and x1, below the height y >= 0.
double area_below(double radius, double x0, double x1, double y) {
    x0 = std::clamp(x0, -radius, radius);
    x1 = std::clamp(x1, -radius, radius);
    if (!(x1 > x0) || !(y > 0)) return 0;
    const auto primitive = [radius](double x) {
        return 0.5 * (x * std::sqrt(std::max(radius * radius - x * x, 0.0)) +
                      radius * radius * std::asin(std::clamp(x / radius, -1.0, 1.0)));
    };
    if (y >= radius) return primitive(x1) - primitive(x0);
    // Where the circle is higher than y the height counts.
    const double flat = std::sqrt(radius * radius - y * y);
    const double left = std::clamp(-flat, x0, x1);
    const double right = std::clamp(flat, x0, x1);
    return primitive(left) - primitive(x0) + (right - left) * y + primitive(x1) - primitive(right);
}

}  // namespace

std::vector<SpectralLine> lines_of(const std::function<double(double)>& spectrum, int step_nm) {
    if (step_nm < glare::cie_step_wavelength_nm || step_nm % glare::cie_step_wavelength_nm != 0)
        throw std::invalid_argument("reference: the step is a multiple of 5 nm");
    const Matrix to_rgb = linear_srgb_from_xyz();
    std::vector<SpectralLine> lines;
    double luminance = 0;
    for (int i = 0; i < glare::cie_samples; i += step_nm / glare::cie_step_wavelength_nm) {
        const glare::CieSample& cie = glare::cie_table[static_cast<std::size_t>(i)];
        SpectralLine line;
        line.wavelength_nm = glare::cie_first_wavelength_nm + i * glare::cie_step_wavelength_nm;
        const double power = spectrum(line.wavelength_nm);
        luminance += power * cie.y_bar;
        for (std::size_t c = 0; c < 3; ++c)
            line.rgbv[c] =
                power * (to_rgb[c][0] * cie.x_bar + to_rgb[c][1] * cie.y_bar + to_rgb[c][2] * cie.z_bar);
        line.rgbv[3] = power * cie.v_prime * 1700 / 683;  // K'm and Km, lm/W
        lines.push_back(line);
    }
    if (!(luminance > 0)) throw std::invalid_argument("reference: the lamp has no luminance");
    for (SpectralLine& line : lines)
        for (double& value : line.rgbv)
            value /= luminance;
    return lines;
}

Rgbv ReferencePattern::relative(int a, int b) const {
    const Rgbv& value = at(a, b);
    Rgbv result{};
    for (std::size_t c = 0; c < 4; ++c)
        result[c] = follows_luminance[c] ? luminance_of(value) / luminance_of(lamp) : value[c] / lamp[c];
    return result;
}

std::vector<ReferencePattern> make_reference(const ReferenceRequest& request,
                                             const std::vector<std::vector<SpectralLine>>& lamps,
                                             const std::function<void(double)>& progress) {
    if (!(request.pitch > 0) || !(request.angular_scale > 0) || request.radius < 1)
        throw std::invalid_argument("reference: pitch, angular scale and radius must be positive");
    double shortest_nm = 1e9;
    std::vector<double> wavelengths_nm;
    for (const auto& lamp : lamps) {
        for (const SpectralLine& line : lamp) {
            const bool dark =
                std::all_of(line.rgbv.begin(), line.rgbv.end(), [](double v) { return std::abs(v) < 1e-7; });
            if (dark) continue;
            shortest_nm = std::min(shortest_nm, line.wavelength_nm);
            wavelengths_nm.push_back(line.wavelength_nm);
        }
    }
    if (wavelengths_nm.empty()) throw std::invalid_argument("reference: no light");
    std::sort(wavelengths_nm.begin(), wavelengths_nm.end());
    wavelengths_nm.erase(std::unique(wavelengths_nm.begin(), wavelengths_nm.end()), wavelengths_nm.end());

    const double physical_pitch = request.pitch / request.angular_scale;
    const Aperture aperture = aperture_of(request.eye, request.pupil_mm, request.time_s, request.seed);
    const Diffraction diffraction(aperture, (request.radius + 0.5) * physical_pitch / (shortest_nm * 1e-6));
    std::vector<ReferencePattern> patterns(lamps.size());
    for (std::size_t l = 0; l < lamps.size(); ++l) {
        ReferencePattern& pattern = patterns[l];
        pattern.radius = request.radius;
        pattern.pitch = request.pitch;
        pattern.transmitted = transmitted(aperture, diffraction.spacing_mm());
        pattern.pixels.assign(
            static_cast<std::size_t>(pattern.side()) * static_cast<std::size_t>(pattern.side()), Rgbv{});
        Rgbv magnitude{};
        for (const SpectralLine& line : lamps[l]) {
            for (std::size_t c = 0; c < 4; ++c) {
                pattern.lamp[c] += line.rgbv[c];
                magnitude[c] += std::abs(line.rgbv[c]);
            }
        }
        for (std::size_t c = 0; c < 4; ++c)
            pattern.follows_luminance[c] = !(std::abs(pattern.lamp[c]) > 0.5 * magnitude[c]) ||
                                           std::abs(pattern.lamp[c]) < 0.02 * luminance_of(pattern.lamp);
    }
    const double per_steradian = 1 / (request.pitch * request.pitch);
    for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
        const Plane plane = diffraction.pattern(wavelengths_nm[w], physical_pitch, request.radius);
        for (std::size_t l = 0; l < lamps.size(); ++l) {
            for (const SpectralLine& line : lamps[l]) {
                if (line.wavelength_nm != wavelengths_nm[w]) continue;
                for (std::size_t i = 0; i < plane.size(); ++i)
                    for (std::size_t c = 0; c < 4; ++c)
                        patterns[l].pixels[i][c] += line.rgbv[c] * plane[i] * per_steradian;
            }
        }
        if (progress) progress(static_cast<double>(w + 1) / static_cast<double>(wavelengths_nm.size()));
    }
    return patterns;
}

ReferencePattern make_reference(const ReferenceRequest& request, const std::vector<SpectralLine>& lamp) {
    return make_reference(request, std::vector<std::vector<SpectralLine>>{lamp}).front();
}

double disc_area_in_rectangle(double radius, double x0, double x1, double y0, double y1) {
    // Both halves of the disc as seen from above the x axis.
    const auto upper = [&](double low, double high) {
        return area_below(radius, x0, x1, high) - area_below(radius, x0, x1, low);
    };
    return upper(std::max(y0, 0.0), std::max(y1, 0.0)) + upper(std::max(-y1, 0.0), std::max(-y0, 0.0));
}

std::vector<Rgbv> average_over_disc(const std::vector<Rgbv>& pixels, int side, double radius_px) {
    if (!(radius_px > 0)) return pixels;
    const int reach = static_cast<int>(std::ceil(radius_px + 0.5));
    const double area = 3.14159265358979323846 * radius_px * radius_px;
    std::vector<Rgbv> result(pixels.size());
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            const double weight =
                disc_area_in_rectangle(radius_px, dx - 0.5, dx + 0.5, dy - 0.5, dy + 0.5) / area;
            if (weight <= 0) continue;
            for (int y = std::max(0, -dy); y < std::min(side, side - dy); ++y) {
                for (int x = std::max(0, -dx); x < std::min(side, side - dx); ++x) {
                    const auto to = static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                                    static_cast<std::size_t>(x);
                    const auto from = static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(side) +
                                      static_cast<std::size_t>(x + dx);
                    for (std::size_t c = 0; c < 4; ++c)
                        result[to][c] += weight * pixels[from][c];
                }
            }
        }
    }
    return result;
}

double cie_curve_sr(double angle_deg, double age_years, double pigmentation) {
    const double a = std::pow(age_years / 70, 4);
    const double p = pigmentation;
    const double core = 1 + std::pow(angle_deg / 0.0046, 2);
    const double ring = 1 + std::pow(angle_deg / 0.045, 2);
    const double wide = 1 + std::pow(angle_deg / 0.1, 2);
    const double eye = (1 - 0.08 * a) * (9.2e6 * std::pow(core, -1.5) + 1.5e5 * std::pow(ring, -1.5));
    const double scatter = 400 / wide + 3e-8 * angle_deg * angle_deg +
                           p * (1300 * std::pow(wide, -1.5) + 0.8 * std::pow(wide, -0.5));
    return (eye + (1 + 1.6 * a) * scatter + 2.5e-3 * p) / (1 + p * (0.0417 + 0.055 * a));
}

}  // namespace seaglare::reference
