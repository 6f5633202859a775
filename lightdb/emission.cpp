#include "lightdb/emission.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightdb/profile.h"
#include "lightdb/rotation.h"
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

// The bearing from the light's ahead, worked out when the first asks for it.
class BearingFromAhead {
  public:
    explicit BearingFromAhead(const Sightline& sightline) : sightline_(sightline) {}
    double deg() {
        if (!known_deg_) known_deg_ = bearing_from_ahead_deg(sightline_.to_eye_in_light_m);
        return *known_deg_;
    }

  private:
    const Sightline& sightline_;
    std::optional<double> known_deg_;
};

SectorFactors sectors_towards(const Light& light, const Sightline& sightline, BearingFromAhead& bearing) {
    if (light.sectors.empty()) return {};
    if (light.sector_reference == SectorReference::outward_from_ahead)
        return sector_factors(light.sectors, bearing.deg(), sightline.elevation_deg);
    const Vec3& to_eye_m = sightline.to_eye_m;
    const Vec3 to_light_m = {-to_eye_m[0], -to_eye_m[1], -to_eye_m[2]};
    return sector_factors(light.sectors, bearing_from_seaward_deg(to_light_m, light.true_north_deg),
                          sightline.elevation_deg);
}

double beam_towards(const Light& light, const Exposure& exposure, double bearing_deg) {
    const double offset_s = light.rotation.period_s != 0 && std::isfinite(exposure.end_s)
                                ? phase_offset_s(light.rhythm, key_of(light, exposure), exposure.seed)
                                : 0;
    return mean_beam_factor(light.rotation, bearing_deg, exposure.end_s + offset_s,
                            exposure_used_s(exposure.duration_s));
}

double solid_towards(const PhotometricSolid& solid, const Sightline& sightline, BearingFromAhead& bearing) {
    if (!(solid.reference_cd > 0)) return 0;
    const double candela = solid.axis == PhotometricSolid::Axis::up
                               ? candela_at(solid, bearing.deg(), sightline.elevation_deg)
                               : candela_towards(solid, sightline.to_eye_in_light_m);
    return candela / solid.reference_cd;
}

// The factor of all that shapes the light's intensity alike for each colour.
double shape_towards(const Light& light, const Exposure& exposure, const Sightline& sightline,
                     BearingFromAhead& bearing) {
    double factor = 1;
    if (!light.vertical.angle_deg.empty()) factor *= clamped_factor(light.vertical, sightline.elevation_deg);
    if (!light.horizontal.angle_deg.empty()) factor *= periodic_factor(light.horizontal, bearing.deg());
    if (light.photometry) factor *= solid_towards(*light.photometry, sightline, bearing);
    if (!light.rotation.beam.angle_deg.empty()) factor *= beam_towards(light, exposure, bearing.deg());
    return factor;
}

}  // namespace

const Intensities& intensities_cd(const Light& light, bool is_day) {
    const auto lights = [](double intensity_cd) { return intensity_cd > 0; };
    const bool has_day =
        is_day && std::any_of(light.day_intensity_cd.begin(), light.day_intensity_cd.end(), lights);
    return has_day ? light.day_intensity_cd : light.intensity_cd;
}

bool has_direction(const Light& light) {
    return !light.sectors.empty() || !light.vertical.angle_deg.empty() ||
           !light.horizontal.angle_deg.empty() || light.photometry || !light.rotation.beam.angle_deg.empty();
}

LitFractions lit_during(const Light& light, const Exposure& exposure) {
    if (!(light.rhythm.period_s > 0)) return mean_lit(light.rhythm, 0, 0);
    const double offset_s = phase_offset_s(light.rhythm, key_of(light, exposure), exposure.seed);
    return exposed_lit(light.rhythm, exposure.end_s + offset_s, exposure.duration_s);
}

bool is_dark(const LitFractions& lit) {
    return std::all_of(lit.begin(), lit.end(), [](double fraction) { return fraction < faintest_fraction; });
}

Intensities emitted_cd(const Light& light, const LitFractions& lit, const Exposure& exposure,
                       const Sightline& sightline) {
    BearingFromAhead bearing(sightline);
    Intensities result = shown_cd(light, lit, sectors_towards(light, sightline, bearing), exposure.is_day);
    const double shape = shape_towards(light, exposure, sightline, bearing);
    if (shape == 1) return result;
    for (double& intensity_cd : result)
        intensity_cd *= shape;
    return result;
}

}  // namespace seaglare::lightdb
