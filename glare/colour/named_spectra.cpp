#include "glare/colour/named_spectra.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "glare/colour/navigation_colours.h"

namespace seaglare::glare {

namespace {

constexpr double tungsten_k = 2856;

struct Named {
    std::string_view name;
    double (*power)(double wavelength_nm);
};

double equal_energy(double /*wavelength_nm*/) {
    return 1;
}
double tungsten(double wavelength_nm) {
    return planck(wavelength_nm, tungsten_k);
}

constexpr Named lamps[] = {{"d65", d65},
                           {"a", illuminant_a},
                           {"e", equal_energy},
                           {"tungsten", tungsten},
                           {"led_white", thesis_white_led},
                           {"led_white_poor", poor_white_led}};

// In the order of navigation_colours.h, from red on.
constexpr std::string_view leds[] = {"led_red", "led_green", "led_yellow", "led_blue", "led_orange"};

constexpr std::string_view all_names[] = {
    "d65",     "a",         "e",          "tungsten", "led_white", "led_white_poor",
    "led_red", "led_green", "led_yellow", "led_blue", "led_orange"};

// From 0 to 1 about `wavelength_nm`; 10 % to 90 % over 2.2 times the width, as sharp as coloured glasses are.
double cut_on(double wavelength_nm, double at_nm, double width_nm) {
    return 1 / (1 + std::exp(-(wavelength_nm - at_nm) / width_nm));
}

double red_glass(double l) {
    return cut_on(l, 612, 7);
}
double green_glass(double l) {
    return cut_on(l, 475, 7) * (1 - cut_on(l, 535, 9));
}
double yellow_glass(double l) {
    return cut_on(l, 562, 6);
}
double blue_glass(double l) {
    return 1 - cut_on(l, 478, 8);
}
double orange_glass(double l) {
    return cut_on(l, 585, 6);
}

constexpr Named glasses[] = {{"red", red_glass},
                             {"green", green_glass},
                             {"yellow", yellow_glass},
                             {"blue", blue_glass},
                             {"orange", orange_glass}};
constexpr std::string_view glass_names[] = {"red", "green", "yellow", "blue", "orange"};

template <std::size_t N>
std::optional<Spectrum> found(const Named (&list)[N], std::string_view name) {
    for (const Named& named : list) {
        if (named.name == name) return named.power;
    }
    return std::nullopt;
}

using Vector = std::array<double, 3>;

Vector colour_of_lobe(double peak_nm) {
    Vector sum{};
    for (int l = 380; l <= 780; ++l) {
        const Xyz cmf = colour_matching(l);
        const double power = gaussian(l, peak_nm, 10);
        sum = {sum[0] + power * cmf.x, sum[1] + power * cmf.y, sum[2] + power * cmf.z};
    }
    return sum;
}

double determinant(const Vector& a, const Vector& b, const Vector& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

constexpr Vector lobes_nm = {446, 555, 599};

// The heights that mix the lobes to D65, by Cramer's rule; the largest is 1.
Vector heights_of_lobes() {
    const Xyz d65_xyz = unit_luminance_xyz(d65);
    const Vector white = {d65_xyz.x, d65_xyz.y, d65_xyz.z};
    const Vector a = colour_of_lobe(lobes_nm[0]);
    const Vector b = colour_of_lobe(lobes_nm[1]);
    const Vector c = colour_of_lobe(lobes_nm[2]);
    Vector heights = {determinant(white, b, c), determinant(a, white, c), determinant(a, b, white)};
    const double largest = *std::max_element(heights.begin(), heights.end());
    for (double& height : heights)
        height /= largest;
    return heights;
}

}  // namespace

double poor_white_led(double wavelength_nm) {
    static const Vector heights = heights_of_lobes();
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += heights[i] * gaussian(wavelength_nm, lobes_nm[i], 10);
    return sum;
}

std::span<const std::string_view> spectrum_names() {
    return all_names;
}

std::optional<Spectrum> named_spectrum(std::string_view name) {
    if (auto lamp = found(lamps, name)) return lamp;
    const auto* const led = std::find(std::begin(leds), std::end(leds), name);
    if (led != std::end(leds)) return navigation_spectrum(static_cast<int>(led - std::begin(leds)) + 1);
    if (!name.starts_with(planck_prefix)) return std::nullopt;
    const std::string_view digits = name.substr(planck_prefix.size());
    double kelvin = 0;
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), kelvin);
    if (failed != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    if (!(kelvin >= coldest_planck_k && kelvin <= hottest_planck_k)) return std::nullopt;
    return [kelvin](double l) { return planck(l, kelvin); };
}

std::string planck_name(double temperature_k) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), temperature_k).ptr;
    return std::string(planck_prefix) + std::string(digits.data(), end);
}

std::span<const std::string_view> filter_names() {
    return glass_names;
}

std::optional<Spectrum> named_filter(std::string_view name) {
    return found(glasses, name);
}

std::optional<std::string_view> filter_of_colour(int colour) {
    if (colour < 1 || colour > static_cast<int>(std::size(glass_names))) return std::nullopt;
    // Order as navigation_colours.h: red, green, yellow, blue, orange.
    return glass_names[static_cast<std::size_t>(colour - 1)];
}

}  // namespace seaglare::glare
