#include "tests/benchmark/pattern_cases.h"

namespace seaglare::benchmark_pattern {

namespace {

using namespace glare;

constexpr double resting_pupil_mm = 6.4;
constexpr double pitch_720 = 1 / 869.1;    // 45 degrees over 720 lines
constexpr double pitch_2160 = 1 / 4030.6;  // 30 degrees over 2160 lines

Case thesis_case(const std::string& name, int wavelengths, const std::vector<float>& layers) {
    Case c;
    c.name = name;
    c.settings = thesis_settings();
    c.settings.wavelengths = wavelengths;
    c.settings.layer_radii_px = layers;
    c.exact = c.settings;
    c.exact.wavelengths = 480;
    c.eye = thesis_eye();
    c.largest_disc = static_cast<double>(layers.back());
    c.stages = true;
    return c;
}

Case physical_case() {
    Case c;
    c.name = "512 at physical angles; 30 wavelengths; 3 layers";
    c.settings.transform_size = 512;
    c.settings.layer_radii_px = {0, 1, 2};
    c.exact = c.settings;
    c.exact.wavelengths = 480;
    c.eye = young_eye();
    c.largest_disc = 2;
    c.stages = true;
    return c;
}

Case two_scale_case(int core, bool moving, double pitch, double wavelength_step_px) {
    Case c;
    c.name = "two scales " + std::to_string(core) + " + 4096; " +
             (wavelength_step_px > 0 ? "wavelengths follow the pixel" : "30 wavelengths");
    c.settings.transform_size = core;
    c.settings.wide_field_size = 4096;
    c.settings.wavelength_step_px = wavelength_step_px;
    c.exact.wavelengths = 480;
    c.eye = young_eye();
    c.pitch = pitch;
    c.moving = moving;
    c.stages = moving && core == 512;
    if (moving)
        for (ParticleFamily& family : c.eye.particles)
            family.drift_um = 60;
    return c;
}

}  // namespace

std::vector<Case> pattern_cases() {
    std::vector<Case> cases;
    cases.push_back(thesis_case("512; 30 wavelengths; 3 layers", 30, {0, 1, 2}));
    cases.push_back(thesis_case("512; 60 wavelengths; layers to 10 px", 60, {0, 1.7F, 3.05F, 6.35F, 10}));
    cases.push_back(physical_case());
    for (const bool moving : {false, true}) {
        for (const int core : {512, 1024})
            cases.push_back(two_scale_case(core, moving, pitch_720, 1));
        for (const double step_px : {0.0, 1.0})
            cases.push_back(two_scale_case(512, moving, pitch_2160, step_px));
        cases.push_back(two_scale_case(1024, moving, pitch_2160, 1));
    }
    return cases;
}

PatternRequest request_at(const Case& c, int frame) {
    PatternRequest request;
    request.time_s = frame / 60.0;
    request.resting_pupil_mm = resting_pupil_mm;
    EyeModel eye = c.eye;
    eye.fixed_pupil_mm = resting_pupil_mm;
    request.pupil_mm = pupil_diameter_mm(eye, 0, request.time_s, 7);
    request.pitch = c.pitch;
    request.largest_disc_nodes = static_cast<float>(c.largest_disc);
    return request;
}

}  // namespace seaglare::benchmark_pattern
