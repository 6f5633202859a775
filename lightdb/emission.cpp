#include "lightdb/emission.h"

#include <algorithm>

#include "lightdb/profile.h"
#include "lightdb/sector.h"

namespace seaglare::lightdb {

namespace {

// The colour of a light whose rhythm names none: the first it has an intensity for.
std::size_t main_colour(const Intensities& intensity_cd) {
    const auto* const found =
        std::find_if(intensity_cd.begin(), intensity_cd.end(), [](double i) { return i > 0; });
    return found != intensity_cd.end() ? static_cast<std::size_t>(found - intensity_cd.begin()) : 0;
}

// Candela of each colour in the light's rhythm, before sectors. All zero: dark.
Intensities shown_cd(const Light& light, const LitFractions& lit, const SectorFactors& sectors, bool is_day) {
    const Intensities& intensity_cd = intensities_cd(light, is_day);
    Intensities shown{};
    if (light.sectors.empty()) {
        if (!has_colours(light.rhythm)) {
            const std::size_t colour = main_colour(intensity_cd);
            shown[colour] = intensity_cd[colour];
            return shown;
        }
        for (std::size_t c = 0; c < shown.size(); ++c) {
            if (lit[c] == 0) continue;
            // A phase in a colour that the light has no intensity for shows the colour that it has.
            const std::size_t colour = intensity_cd[c] > 0 ? c : main_colour(intensity_cd);
            shown[colour] += lit[c] * intensity_cd[colour];
        }
        return shown;
    }
    double lit_in_all = 0;
    for (const double fraction : lit)
        lit_in_all += fraction;
    for (std::size_t c = 0; c < shown.size(); ++c)
        shown[c] = sectors[c] * lit_in_all * intensity_cd[c];
    return shown;
}

SectorFactors sectors_towards(const Light& light, const Sightline& sightline) {
    if (light.sectors.empty()) return {};
    if (light.sector_reference == SectorReference::outward_from_ahead)
        return sector_factors(light.sectors, bearing_from_ahead_deg(sightline.to_eye_in_light_m));
    const Vec3& to_eye_m = sightline.to_eye_m;
    const Vec3 to_light_m = {-to_eye_m[0], -to_eye_m[1], -to_eye_m[2]};
    return sector_factors(light.sectors, bearing_from_seaward_deg(to_light_m, light.true_north_deg));
}

}  // namespace

const Intensities& intensities_cd(const Light& light, bool is_day) {
    const auto lights = [](double intensity_cd) { return intensity_cd > 0; };
    const bool has_day =
        is_day && std::any_of(light.day_intensity_cd.begin(), light.day_intensity_cd.end(), lights);
    return has_day ? light.day_intensity_cd : light.intensity_cd;
}

bool has_direction(const Light& light) {
    return !light.sectors.empty() || !light.vertical.angle_deg.empty();
}

LitFractions lit_during(const Light& light, const Exposure& exposure) {
    if (!(light.rhythm.period_s > 0)) return mean_lit(light.rhythm, 0, 0);
    const double offset_s = phase_offset_s(light.rhythm, key_of(light, exposure), exposure.seed);
    return exposed_lit(light.rhythm, exposure.end_s + offset_s, exposure.duration_s);
}

bool is_dark(const LitFractions& lit) {
    return std::all_of(lit.begin(), lit.end(), [](double fraction) { return fraction == 0; });
}

Intensities emitted_cd(const Light& light, const LitFractions& lit, const Exposure& exposure,
                       const Sightline& sightline) {
    Intensities result = shown_cd(light, lit, sectors_towards(light, sightline), exposure.is_day);
    if (light.vertical.angle_deg.empty()) return result;
    const double profile = clamped_factor(light.vertical, sightline.elevation_deg);
    for (double& intensity_cd : result)
        intensity_cd *= profile;
    return result;
}

}  // namespace seaglare::lightdb
