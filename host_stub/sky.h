// The sky's luminance in cd/m2 as a table over azimuth and elevation: twilight, moonlight, airglow and the
// glow of towns. Computed on the CPU when sun or moon have moved, so the picture and the eye's adaptation
// read the same numbers.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host_stub/geodesy.h"

namespace seaglare::host {

// Illuminance of the ground by the sun and its scattered light, lux, for any elevation; 0 below -18 degrees.
// Source: Janiczek and DeYoung, U.S. Naval Observatory Circular 171 (1987), table 1.
double sun_illuminance_lx(double elevation_deg);

// The same for the moon; phase angle 0 is full, 180 new. 0 below -0.8 degrees. Source: as above, table 2.
double moon_illuminance_lx(double elevation_deg, double phase_angle_deg);

// The dome of light above a town beyond the horizon.
struct TownGlow {
    double azimuth_deg = 0;
    double luminance_cd_m2 = 0;  // at the horizon, in its middle
    double width_deg = 15;       // azimuth at which it has fallen to 1/e
    double height_deg = 5;       // elevation at which it has fallen to 1/e
};

struct SkyConditions {
    SkyDirection sun{-40, 0};
    std::optional<SkyDirection> moon;
    double moon_phase_angle_deg = 0;
    double night_luminance_cd_m2 = 3e-4;  // zenith without sun and moon: 1.7e-4 far from towns, 1e-3 near one
    std::vector<TownGlow> towns;
};

// A disc in the sky that the sea glitters with.
struct Luminary {
    SkyDirection direction;
    double normal_illuminance_lx = 0;  // on a plane facing it
    double disc_luminance_cd_m2 = 0;
};

class SkyTable {
  public:
    static constexpr int azimuths = 512;  // column i is at 360 i / azimuths degrees, periodic
    static constexpr int elevations =
        96;  // row j is at 90 (j / (elevations - 1))^2 degrees: fine near the horizon

    explicit SkyTable(const SkyConditions& conditions);

    // Linear sRGB whose luminance is in cd/m2.
    std::array<double, 3> radiance(SkyDirection direction) const;
    double luminance(SkyDirection direction) const;
    // Of the horizontal ground, by the dome without sun and moon themselves.
    double illuminance_lx() const { return illuminance_lx_; }
    // What a mariner's eye rests on: the mean of the sky up to 20 degrees and of a sea that reflects a third
    // of it.
    double adaptation_luminance_cd_m2() const { return adaptation_cd_m2_; }
    const Luminary& sun() const { return sun_; }
    const Luminary& moon() const { return moon_; }
    // Row major, rgb, azimuths x elevations.
    const std::vector<float>& texels() const { return texels_; }

  private:
    std::vector<float> texels_;
    double illuminance_lx_ = 0;
    double adaptation_cd_m2_ = 0;
    Luminary sun_, moon_;
};

}  // namespace seaglare::host
