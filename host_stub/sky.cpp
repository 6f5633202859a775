#include "host_stub/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace seaglare::host {
namespace {

using Rgb = std::array<double, 3>;
constexpr double deg = std::numbers::pi / 180;

double luminance_of(const Rgb& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

Rgb unit_luminance(Rgb c) {
    const double y = luminance_of(c);
    return {c[0] / y, c[1] / y, c[2] / y};
}

Rgb mix(const Rgb& a, const Rgb& b, double t) {
    t = std::clamp(t, 0.0, 1.0);
    return {a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t};
}

void add(Rgb& sum, const Rgb& colour, double luminance) {
    for (int i = 0; i < 3; ++i)
        sum[i] += colour[i] * luminance;
}

// log10 of the illuminance is a cubic in elevation / 90 degrees, piece by piece.
struct Piece {
    double above_deg;
    std::array<double, 4> c;
};
constexpr std::array<Piece, 6> sun_pieces{{{20, {3.74, 3.97, -4.07, 1.47}},
                                           {5, {3.05, 13.28, -45.98, 64.33}},
                                           {-0.8, {2.88, 22.26, -207.64, 1034.30}},
                                           {-5, {2.88, 21.81, -258.11, -858.36}},
                                           {-12, {2.70, 12.17, -431.69, -1899.83}},
                                           {-18, {13.84, 262.72, 1447.42, 2797.93}}}};
constexpr std::array<Piece, 3> moon_pieces{{{20, {-1.95, 4.06, -4.24, 1.56}},
                                            {5, {-2.58, 12.58, -42.58, 59.06}},
                                            {-0.8, {-2.79, 24.27, -252.95, 1321.29}}}};

template <std::size_t N>
double piecewise_log10(const std::array<Piece, N>& pieces, double elevation_deg) {
    const double x = elevation_deg / 90;
    for (const Piece& p : pieces)
        if (elevation_deg >= p.above_deg) return p.c[0] + x * (p.c[1] + x * (p.c[2] + x * p.c[3]));
    return -std::numeric_limits<double>::infinity();
}

double azimuth_difference_deg(double a, double b) {
    return std::remainder(a - b, 360.0);
}

double smoothstep(double lo, double hi, double x) {
    const double t = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// The dome the sun lights, before it is scaled to the illuminance: brighter towards the horizon, with the
// twilight arch over the sun's azimuth, reddest at its foot, and the Earth's shadow opposite. Shapes after
// the descriptions in Minnaert, The Nature of Light and Colour in the Open Air, sections 188 to 191; the
// widths are chosen by eye.
Rgb sunlit_shape(SkyDirection d, SkyDirection sun) {
    static const Rgb zenith_blue = unit_luminance({0.42, 0.80, 1.75});
    static const Rgb day_horizon = unit_luminance({0.86, 1.0, 1.22});
    static const Rgb arch_red = unit_luminance({2.3, 0.78, 0.16});
    static const Rgb arch_gold = unit_luminance({1.65, 0.98, 0.42});
    static const Rgb arch_pale = unit_luminance({0.95, 1.02, 0.95});

    const double el = d.elevation_deg;
    const double twilight = 1 - smoothstep(-2, 8, sun.elevation_deg);
    const double depression = std::clamp(-sun.elevation_deg, 0.0, 18.0);
    const double from_sun_deg = std::abs(azimuth_difference_deg(d.azimuth_deg, sun.azimuth_deg));

    Rgb c{};
    add(c, mix(zenith_blue, day_horizon, std::exp(-el / 14)), 1 + 1.2 * std::exp(-el / 16));
    // By day the sky is brightest about the sun.
    const double gamma = std::acos(std::clamp(glm::dot(unit_vector(d), unit_vector(sun)), -1.0, 1.0)) / deg;
    add(c, unit_luminance({1, 1, 0.95}),
        (1 - twilight) * (4 * std::exp(-gamma / 12) + 0.6 * std::exp(-gamma / 40)));

    // The arch sinks and narrows as the sun goes deeper.
    const double spread_deg = 75 - 2.2 * depression;
    const double across = std::exp(-from_sun_deg * from_sun_deg / (spread_deg * spread_deg));
    const double height_deg = std::max(3.5, 13 - 0.55 * depression);
    const double arch = twilight * (6 + 0.9 * depression) * across * std::exp(-el / height_deg);
    const double up = el / height_deg;
    const Rgb arch_colour =
        up < 0.35 ? mix(arch_red, arch_gold, up / 0.35)
                  : mix(arch_gold, mix(arch_pale, zenith_blue, (up - 1.1) / 1.2), (up - 0.35) / 0.75);
    add(c, mix(arch_pale, arch_colour, 0.45 + 0.55 * across), arch);
    // Opposite: the shadow's dusky band.
    const double shadow = twilight * (1 - across) * smoothstep(0, 3, depression) * 0.45 * std::exp(-el / 7);
    for (double& v : c)
        v *= 1 - shadow;
    return c;
}

// Moonlight scattered by the air: Rayleigh's phase function and an aureole.
Rgb moonlit_shape(SkyDirection d, SkyDirection moon) {
    static const Rgb blue = unit_luminance({0.70, 0.95, 1.45});
    static const Rgb pale = unit_luminance({0.95, 1.0, 1.08});
    const double cos_gamma = std::clamp(glm::dot(unit_vector(d), unit_vector(moon)), -1.0, 1.0);
    const double gamma_deg = std::acos(cos_gamma) / deg;
    Rgb c{};
    add(c, mix(blue, pale, std::exp(-d.elevation_deg / 12)),
        (0.75 + 0.75 * cos_gamma * cos_gamma) * (1 + 1.3 * std::exp(-d.elevation_deg / 14)));
    add(c, pale, 3.0 * std::exp(-gamma_deg / 9) + 12 * std::exp(-gamma_deg / 1.6));
    return c;
}

double elevation_of_row_deg(int row) {
    const double v = static_cast<double>(row) / (SkyTable::elevations - 1);
    return 90 * v * v;
}

// Solid angle that row `row` stands for in one column.
double row_solid_angle_sr(int row) {
    const double low = row == 0 ? 0 : 0.5 * (elevation_of_row_deg(row - 1) + elevation_of_row_deg(row));
    const double high = row == SkyTable::elevations - 1
                            ? 90
                            : 0.5 * (elevation_of_row_deg(row) + elevation_of_row_deg(row + 1));
    return (std::sin(high * deg) - std::sin(low * deg)) * 2 * std::numbers::pi / SkyTable::azimuths;
}

template <class Shape>
std::vector<Rgb> dome(const Shape& shape) {
    std::vector<Rgb> texels(static_cast<std::size_t>(SkyTable::azimuths) * SkyTable::elevations);
    for (int j = 0; j < SkyTable::elevations; ++j)
        for (int i = 0; i < SkyTable::azimuths; ++i)
            texels[static_cast<std::size_t>(j) * SkyTable::azimuths + i] =
                shape(SkyDirection{elevation_of_row_deg(j), 360.0 * i / SkyTable::azimuths});
    return texels;
}

double dome_illuminance_lx(const std::vector<Rgb>& texels) {
    double sum = 0;
    for (int j = 0; j < SkyTable::elevations; ++j) {
        const double weight = row_solid_angle_sr(j) * std::sin(elevation_of_row_deg(j) * deg);
        for (int i = 0; i < SkyTable::azimuths; ++i)
            sum += weight * luminance_of(texels[static_cast<std::size_t>(j) * SkyTable::azimuths + i]);
    }
    return sum;
}

void add_scaled_to_illuminance(std::vector<Rgb>& sum, const std::vector<Rgb>& shape, double illuminance_lx) {
    const double scale = illuminance_lx / dome_illuminance_lx(shape);
    for (std::size_t i = 0; i < sum.size(); ++i)
        for (int c = 0; c < 3; ++c)
            sum[i][c] += shape[i][c] * scale;
}

// Of the light that reaches the ground under a clear sky, the dome's share: all of it once the disc has set.
double diffuse_share(double elevation_deg) {
    return 1 - 0.82 * smoothstep(-0.8, 25, elevation_deg);
}

Luminary luminary(SkyDirection direction, double horizontal_lx) {
    // Both discs are half a degree wide: 6.0e-5 sr.
    constexpr double disc_sr = 6.0e-5;
    Luminary l{direction, 0, 0};
    const double direct = horizontal_lx * (1 - diffuse_share(direction.elevation_deg));
    const double sine = std::sin(direction.elevation_deg * deg);
    if (sine > 0.01) l.normal_illuminance_lx = direct / sine;
    l.disc_luminance_cd_m2 = l.normal_illuminance_lx / disc_sr;
    return l;
}

}  // namespace

double sun_illuminance_lx(double elevation_deg) {
    return std::pow(10, piecewise_log10(sun_pieces, elevation_deg));
}

double moon_illuminance_lx(double elevation_deg, double phase_angle_deg) {
    const double f = std::abs(phase_angle_deg);
    return std::pow(10, piecewise_log10(moon_pieces, elevation_deg) - 0.00868 * f - 2.2e-9 * f * f * f * f);
}

SkyTable::SkyTable(const SkyConditions& conditions) {
    static const Rgb airglow = unit_luminance({0.95, 1.02, 0.92});
    static const Rgb sodium = unit_luminance({1.55, 0.92, 0.45});

    // Airglow is a thin layer, so it brightens towards the horizon (van Rhijn) until the air dims it again.
    std::vector<Rgb> sum = dome([&](SkyDirection d) {
        const double s = std::sin((90 - d.elevation_deg) * deg) / (1 + 90.0 / 6371);
        const double van_rhijn = 1 / std::sqrt(1 - s * s);
        const double air_mass =
            1 / (std::sin(d.elevation_deg * deg) + 0.025 * std::exp(-11 * std::sin(d.elevation_deg * deg)));
        Rgb c{};
        add(c, airglow,
            conditions.night_luminance_cd_m2 * (0.55 + 0.45 * van_rhijn) * std::exp(-0.10 * (air_mass - 1)) +
                conditions.night_luminance_cd_m2 * 0.5 * (1 - std::exp(-0.08 * air_mass)));
        for (const TownGlow& town : conditions.towns) {
            const double across = azimuth_difference_deg(d.azimuth_deg, town.azimuth_deg) / town.width_deg;
            add(c, sodium,
                town.luminance_cd_m2 * std::exp(-across * across) *
                    (0.75 * std::exp(-d.elevation_deg / town.height_deg) +
                     0.25 * std::exp(-d.elevation_deg / (4 * town.height_deg))));
        }
        return c;
    });

    const double sun_lx = sun_illuminance_lx(conditions.sun.elevation_deg);
    if (sun_lx > 0)
        add_scaled_to_illuminance(sum, dome([&](SkyDirection d) { return sunlit_shape(d, conditions.sun); }),
                                  sun_lx * diffuse_share(conditions.sun.elevation_deg));
    sun_ = luminary(conditions.sun, sun_lx);
    if (conditions.moon) {
        const double moon_lx =
            moon_illuminance_lx(conditions.moon->elevation_deg, conditions.moon_phase_angle_deg);
        if (moon_lx > 0)
            add_scaled_to_illuminance(
                sum, dome([&](SkyDirection d) { return moonlit_shape(d, *conditions.moon); }),
                moon_lx * diffuse_share(conditions.moon->elevation_deg));
        moon_ = luminary(*conditions.moon, moon_lx);
    }

    illuminance_lx_ = dome_illuminance_lx(sum);
    double low_sum = 0, low_sr = 0;
    for (int j = 0; j < elevations && elevation_of_row_deg(j) <= 20; ++j)
        for (int i = 0; i < azimuths; ++i) {
            low_sum += row_solid_angle_sr(j) * luminance_of(sum[static_cast<std::size_t>(j) * azimuths + i]);
            low_sr += row_solid_angle_sr(j);
        }
    adaptation_cd_m2_ = low_sum / low_sr * (1 + 1.0 / 3) / 2;

    texels_.reserve(sum.size() * 3);
    for (const Rgb& c : sum)
        for (double v : c)
            texels_.push_back(static_cast<float>(v));
}

std::array<double, 3> SkyTable::radiance(SkyDirection d) const {
    const double row = std::sqrt(std::clamp(d.elevation_deg / 90, 0.0, 1.0)) * (elevations - 1);
    const double column = (d.azimuth_deg / 360 - std::floor(d.azimuth_deg / 360)) * azimuths;
    const int j = std::min(static_cast<int>(row), elevations - 2), i = static_cast<int>(column) % azimuths;
    const double v = row - j, u = column - std::floor(column);
    std::array<double, 3> c{};
    for (int k = 0; k < 3; ++k) {
        const auto at = [&](int y, int x) {
            return static_cast<double>(
                texels_[(static_cast<std::size_t>(y) * azimuths + x % azimuths) * 3 + k]);
        };
        c[k] = (1 - v) * ((1 - u) * at(j, i) + u * at(j, i + 1)) +
               v * ((1 - u) * at(j + 1, i) + u * at(j + 1, i + 1));
    }
    return c;
}

double SkyTable::luminance(SkyDirection d) const {
    return luminance_of(radiance(d));
}

}  // namespace seaglare::host
