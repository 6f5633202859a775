#include "host_stub/report/pattern_image.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "host_stub/image_files.h"

namespace seaglare::report {

namespace {

using reference::Rgbv;
constexpr double degrees = 180 / std::numbers::pi;
constexpr double false_colour_low = -1;  // log10 of sr^-1
constexpr double false_colour_high = 6;

std::uint8_t srgb_byte(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

using Colour = std::array<double, 3>;

// Towards the grey of its luminance until no channel is negative.
Colour in_gamut(Colour c) {
    const double y = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    const double lowest = std::min({c[0], c[1], c[2]});
    if (y <= 0) return {0, 0, 0};
    if (lowest >= 0) return c;
    const double keep = y / (y - lowest);
    for (double& v : c)
        v = y + keep * (v - y);
    return c;
}

// Dark violet over red and yellow to white: luminance rises all the way, so it reads in grey, too.
Colour false_colour(double log_value) {
    static constexpr std::array<Colour, 6> stops = {{{0.0, 0.0, 0.02},
                                                     {0.07, 0.01, 0.20},
                                                     {0.32, 0.01, 0.16},
                                                     {0.80, 0.12, 0.02},
                                                     {0.95, 0.58, 0.02},
                                                     {1.0, 1.0, 0.85}}};
    const double t =
        std::clamp((log_value - false_colour_low) / (false_colour_high - false_colour_low), 0.0, 1.0) *
        (stops.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(t), stops.size() - 2);
    Colour c{};
    for (std::size_t k = 0; k < 3; ++k)
        c[k] = std::lerp(stops[i][k], stops[i + 1][k], t - static_cast<double>(i));
    return c;
}

constexpr double difference_limit = 0.2;

// Blue, white, orange: told apart by those who confuse red and green, too.
Colour difference_colour(double share) {
    static constexpr Colour little = {0.0, 0.17, 0.45};
    static constexpr Colour much = {0.65, 0.11, 0.0};
    const double t = std::clamp(std::abs(share) / difference_limit, 0.0, 1.0);
    const Colour& end = share < 0 ? little : much;
    Colour c{};
    for (std::size_t k = 0; k < 3; ++k)
        c[k] = std::lerp(1.0, end[k], std::sqrt(t));
    return c;
}

std::string html(const Colour& linear) {
    std::array<char, 12> text{};
    std::snprintf(text.data(), text.size(), "'#%02x%02x%02x'", srgb_byte(linear[0]), srgb_byte(linear[1]),
                  srgb_byte(linear[2]));
    return text.data();
}

void write_pixels(const PatternImage& image, const std::filesystem::path& path, int zoom,
                  const std::function<Colour(const Rgbv&)>& shade) {
    const int size = image.side() * zoom;
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4);
    std::size_t i = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Colour c = shade(image.at(x / zoom - image.radius, image.radius - y / zoom));
            for (const double v : c)
                rgba[i++] = srgb_byte(v);
            rgba[i++] = 255;
        }
    }
    host::write_png(path, size, size, rgba);
}

}  // namespace

double photopic(const Rgbv& value) {
    return 0.2126 * value[0] + 0.7152 * value[1] + 0.0722 * value[2];
}

PatternImage image_of(const reference::ReferencePattern& pattern) {
    PatternImage image{pattern.radius, pattern.pitch, {}};
    image.pixels.reserve(pattern.pixels.size());
    for (int b = -pattern.radius; b <= pattern.radius; ++b)
        for (int a = -pattern.radius; a <= pattern.radius; ++a)
            image.pixels.push_back(pattern.relative(a, b));
    return image;
}

PatternImage image_of(const glare::Pattern& pattern, double core_radius_nodes, int radius) {
    PatternImage image{radius, pattern.pitch, {}};
    image.pixels.reserve(static_cast<std::size_t>(image.side()) * static_cast<std::size_t>(image.side()));
    const auto share = [&](int a, int b) {
        const double t = std::min(std::hypot(a, b) / core_radius_nodes, 1.0);
        return 0.5 + 0.5 * std::cos(std::numbers::pi * t);
    };
    // The core's energy over its window as Airy's peak would share it: nearly all in the middle pixel.
    double shares = 0;
    const int reach = static_cast<int>(std::ceil(core_radius_nodes));
    const auto weight = [&](int a, int b) { return share(a, b) * std::exp(-3.0 * (a * a + b * b)); };
    for (int b = -reach; b <= reach; ++b)
        for (int a = -reach; a <= reach; ++a)
            shares += weight(a, b);
    const int nodes = 2 * pattern.radius_nodes + 1;
    for (int b = -radius; b <= radius; ++b) {
        for (int a = -radius; a <= radius; ++a) {
            Rgbv value{};
            const double sine = std::hypot(a, b) * pattern.pitch;
            const double theta_deg = std::asin(std::min(sine, 1.0)) * degrees;
            const double t = std::clamp(
                (sine - pattern.window_inner) / (pattern.window_outer - pattern.window_inner), 0.0, 1.0);
            const double tail = pattern.tail_scale > 0
                                    ? pattern.tail_scale * (0.5 - 0.5 * std::cos(std::numbers::pi * t)) *
                                          reference::cie_curve_sr(theta_deg, pattern.tail_age_years,
                                                                  pattern.tail_pigmentation)
                                    : 0;
            const bool inside = std::abs(a) <= pattern.radius_nodes && std::abs(b) <= pattern.radius_nodes;
            for (std::size_t c = 0; c < 4; ++c) {
                value[c] = tail;
                if (inside)
                    value[c] += static_cast<double>(
                        pattern.skirt[4 * static_cast<std::size_t>((b + pattern.radius_nodes) * nodes + a +
                                                                   pattern.radius_nodes) +
                                      c]);
                if (std::abs(a) <= reach && std::abs(b) <= reach)
                    value[c] += static_cast<double>(pattern.core_energy[0][c]) * weight(a, b) / shares /
                                (pattern.pitch * pattern.pitch);
            }
            image.pixels.push_back(value);
        }
    }
    return image;
}

std::vector<Ring> rings_of(const PatternImage& image) {
    std::vector<double> edges = {0.5};
    while (edges.back() < image.radius)
        edges.push_back(std::max(edges.back() + 1, 1.03 * edges.back()));
    std::vector<Ring> rings(edges.size());
    std::vector<double> count(edges.size());
    std::vector<double> energy(edges.size());
    for (int b = -image.radius; b <= image.radius; ++b) {
        for (int a = -image.radius; a <= image.radius; ++a) {
            const double distance = std::hypot(a, b);
            if (distance > image.radius) continue;
            const auto i = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), distance) -
                                                    edges.begin());
            const double value = photopic(image.at(a, b));
            count[i] += 1;
            rings[i].mean_sr += value;
            rings[i].angle_deg += std::asin(std::min(distance * image.pitch, 1.0)) * degrees;
            energy[i] += value * image.pitch * image.pitch;
        }
    }
    double inside = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        rings[i].mean_sr /= count[i];
        rings[i].angle_deg /= count[i];
        rings[i].outer_deg =
            std::asin(std::min(std::min(edges[i], double(image.radius)) * image.pitch, 1.0)) * degrees;
        rings[i].energy_inside = inside += energy[i];
    }
    return rings;
}

double spencer_photopic_sr(double angle_deg) {
    const double f0 = 2.61e6 * std::exp(-std::pow(angle_deg / 0.02, 2));
    const double f1 = 20.91 / std::pow(angle_deg + 0.02, 3);
    const double f2 = 72.37 / std::pow(angle_deg + 0.02, 2);
    return 0.384 * f0 + 0.478 * f1 + 0.138 * f2;
}

double spencer_scotopic_sr(double angle_deg) {
    const double f0 = 2.61e6 * std::exp(-std::pow(angle_deg / 0.02, 2));
    const double f1 = 20.91 / std::pow(angle_deg + 0.02, 3);
    const double f2 = 72.37 / std::pow(angle_deg + 0.02, 2);
    const double f3 = 436.9 * std::exp(-19.75 * std::pow(angle_deg - 3, 2));  // at 568 nm
    return 0.282 * f0 + 0.478 * f1 + 0.207 * f2 + 0.033 * f3;
}

void write_linear_png(const PatternImage& image, const std::filesystem::path& path, int zoom,
                      double white_sr) {
    write_pixels(image, path, zoom, [&](const Rgbv& v) {
        return in_gamut({v[0] / white_sr, v[1] / white_sr, v[2] / white_sr});
    });
}

void write_log_png(const PatternImage& image, const std::filesystem::path& path, int zoom) {
    // Five decades; the colour is kept and a little stronger than it is.
    write_pixels(image, path, zoom, [](const Rgbv& v) -> Colour {
        const double y = photopic(v);
        if (!(y > 0)) return {0, 0, 0};
        const double level = std::clamp((std::log10(y) + 1.5) / 5.5, 0.0, 1.0);
        Colour c{};
        for (std::size_t k = 0; k < 3; ++k)
            c[k] = 1 + 1.5 * (v[k] / y - 1);
        c = in_gamut(c);
        const double brightest = std::max({c[0], c[1], c[2], 1.0});
        for (double& value : c)
            value *= std::pow(level, 1.6) / brightest;
        return c;
    });
}

void write_false_colour_png(const PatternImage& image, const std::filesystem::path& path, int zoom) {
    write_pixels(image, path, zoom,
                 [](const Rgbv& v) { return false_colour(std::log10(std::max(photopic(v), 1e-12))); });
}

void write_night_png(const PatternImage& image, const std::filesystem::path& path, int zoom,
                     double illuminance_lx) {
    // Photographic operator (Reinhard et al. 2002) around starlight's 0.001 cd/m2.
    constexpr double background_cd_m2 = 0.001;
    constexpr double key = 0.0022;  // 1.002 - 2/(2 + log10(0.001 + 1)), as glare/tone has it
    constexpr double white = 2;
    write_pixels(image, path, zoom, [&](const Rgbv& v) {
        const double y = background_cd_m2 + illuminance_lx * photopic(v);
        const double scaled = key * y / background_cd_m2;
        const double shown = scaled * (1 + scaled / (white * white)) / (1 + scaled);
        Colour c{};
        for (std::size_t k = 0; k < 3; ++k)
            c[k] = (background_cd_m2 + illuminance_lx * v[k]) / y * std::min(shown, 1.0);
        return in_gamut(c);
    });
}

void write_difference_png(const PatternImage& made, const PatternImage& truth,
                          const std::filesystem::path& path, int zoom) {
    const int rings = truth.radius * 3 / 2 + 2;
    std::vector<double> mean(static_cast<std::size_t>(rings));
    std::vector<double> count(mean.size());
    const auto ring_of = [](int a, int b) { return static_cast<std::size_t>(std::lround(std::hypot(a, b))); };
    for (int b = -truth.radius; b <= truth.radius; ++b) {
        for (int a = -truth.radius; a <= truth.radius; ++a) {
            mean[ring_of(a, b)] += photopic(truth.at(a, b));
            count[ring_of(a, b)] += 1;
        }
    }
    PatternImage difference = made;
    for (int b = -made.radius; b <= made.radius; ++b) {
        for (int a = -made.radius; a <= made.radius; ++a) {
            const std::size_t ring = ring_of(a, b);
            difference.pixels[static_cast<std::size_t>(&made.at(a, b) - made.pixels.data())][0] =
                (photopic(made.at(a, b)) - photopic(truth.at(a, b))) * count[ring] / mean[ring];
        }
    }
    write_pixels(difference, path, zoom, [](const Rgbv& v) { return difference_colour(v[0]); });
}

std::string false_colour_scale() {
    std::string text = "set palette defined (";
    constexpr int steps = 32;
    for (int i = 0; i <= steps; ++i) {
        const double decade = false_colour_low + (false_colour_high - false_colour_low) * i / steps;
        text += (i > 0 ? ", " : "") + std::to_string(i) + " " + html(false_colour(decade));
    }
    return text +
           ")\nset cbrange [0.1:1e6]\nset logscale cb\nset format cb '10^{%L}'\nset cblabel 'luminance per "
           "illuminance, 1/sr'";
}

std::string difference_scale() {
    std::string text = "set palette defined (";
    constexpr int steps = 32;
    for (int i = 0; i <= steps; ++i)
        text += (i > 0 ? ", " : "") + std::to_string(i) + " " +
                html(difference_colour(difference_limit * (2.0 * i / steps - 1)));
    return text + ")\nset cbrange [-20:20]\nset cblabel 'per cent'";
}

void write_image_exr(const PatternImage& image, const std::filesystem::path& path) {
    std::vector<float> values;
    for (const Rgbv& pixel : image.pixels)
        for (const double v : pixel)
            values.push_back(static_cast<float>(v));
    host::write_exr(path, image.side(), image.side(), values);
}

}  // namespace seaglare::report
