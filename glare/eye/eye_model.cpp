#include "glare/eye/eye_model.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

constexpr LensGratings halo_gratings{1853, 3.0, 3.4, 0.5, 0.35};

void set_sites(EyeModel& eye) {
    eye.particles[0].site = ParticleSite::lens;
    eye.particles[1].site = ParticleSite::cornea;
    eye.particles[2].site = ParticleSite::vitreous;
}

}  // namespace

EyeModel young_eye() {
    EyeModel eye;
    eye.gratings = halo_gratings;
    eye.particles = {{9000, 4.5, 25, 2.6}, {500, 25, 100, 2.5}, {180, 100, 400, 2.5}};
    set_sites(eye);
    return eye;
}

EyeModel sixty_year_eye() {
    EyeModel eye;
    eye.age_years = 60;
    eye.fixed_pupil_mm = 5;
    eye.hippus_amplitude_mm = 0.1;
    eye.gratings = halo_gratings;
    eye.particles = {{14000, 4.5, 25, 2.7}, {600, 25, 100, 2.5}, {160, 100, 500, 2.3}};
    set_sites(eye);
    return eye;
}

EyeModel thesis_eye() {
    EyeModel eye;
    eye.gratings = {200, 2.0, 3.5, 0.5, 0.35};
    eye.particles = {{750, 20, 60, 2.5}, {50, 60, 250, 2.5, 4, 60, 12}};
    return eye;
}

EyeModel no_lash_eye() {
    EyeModel eye = young_eye();
    eye.particles[2].drift_um = 60;
    eye.particles[2].drift_period_s = 12;
    eye.lids.motion = {4, 0.3, 0.5, 3000};
    eye.accommodation.slow_dioptre = 0.2;
    eye.accommodation.quick_dioptre = 0.05;
    eye.adapts = true;
    return eye;
}

EyeModel young_eye_with_lashes() {
    EyeModel eye = no_lash_eye();
    eye.eyelashes.count = 6;
    return eye;
}

EyeModel circular_pupil_eye() {
    EyeModel eye;
    eye.hippus_amplitude_mm = 0;
    eye.cie_tail = false;
    return eye;
}

double transmitted_fraction(const EyeModel& eye, double pupil_mm) {
    const LensGratings& g = eye.gratings;
    if (g.count <= 0 || !(pupil_mm > 0)) return 1;
    const double radius = pupil_mm / 2;
    const double inner = std::clamp(g.inner_radius_mm, 0.0, radius);
    const double outer = std::clamp(g.outer_radius_mm, inner, radius);
    const double passed = (1 - g.depth) * (1 - g.depth);
    return 1 - (outer * outer - inner * inner) / (radius * radius) * g.duty * (1 - passed);
}

}  // namespace seaglare::glare
