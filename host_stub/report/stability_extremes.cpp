// The ends of every quantity: what comes out is finite, bounded, monotonic where it must be, and right where a formula says
// what it is.
#include <numbers>

#include "glare/apply/depth_model.h"
#include "glare/colour/chromaticity.h"
#include "glare/eye/adaptation.h"
#include "glare/eye/exact_step.h"
#include "glare/eye/vitreous.h"
#include "glare/psf/cie_curve.h"
#include "glare/psf/pattern.h"
#include "glare/psf/pattern_grid.h"
#include "glare/tone/operators.h"
#include "host_stub/report/stability.h"
#include "lightdb/photometry.h"
#include "lightdb/profile.h"
#include "lightdb/rhythm.h"

namespace seaglare::report {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void intensity_and_distance(std::vector<Check>& checks) {
    Check finite{"illuminance", "0 to 1e8 cd, 0 to 1e7 m, clear to 5 m of visibility", "0 to 1e14 lx", 0, 0};
    Check order{"illuminance", "the same", "never more from farther away", 0, 0};
    Check faint{"illuminance", "0.01 cd at 60 km", "2.78e-12 lx, relative", 0, 1e-3};
    for (const double intensity_cd : {0.0, 0.01, 250.0, 1e8}) {
        for (const double visibility_m : {infinity, 18520.0, 100.0, 5.0}) {
            const double extinction = lightdb::extinction_per_m(visibility_m);
            double before = infinity;
            for (const double distance_m : {0.0, 1e-6, 0.05, 5.0, 1e3, 6e4, 1e7}) {
                const double lux = lightdb::illuminance_lx(intensity_cd, distance_m, 0.05, extinction);
                finite.see_within(lux, 0, 1e14);
                order.see(std::max(0.0, lux - before));
                before = lux;
            }
        }
    }
    faint.see(std::abs(lightdb::illuminance_lx(0.01, 6e4, 0.05, 0) / 2.7778e-12 - 1));
    Check fog{"fog at 60 km", "visibility 18.5 km to 185 m: exponent -9.7 to -970",
              "exp(-rho D), or exactly 0; relative", 0, 1e-12};
    for (const double visibility_m : {18520.0, 1852.0, 185.2}) {
        const double rho = lightdb::extinction_per_m(visibility_m);
        const double through = lightdb::transmission(rho, 6e4);
        const long double exact = std::exp(-static_cast<long double>(rho) * 6e4L);
        fog.see(exact > 1e-300L ? static_cast<double>(std::abs(through / exact - 1)) : through);
    }
    fog.see(std::abs(lightdb::transmission(infinity, 0) - 1));
    checks.insert(checks.end(), {finite, order, faint, fog});
}

void tone(std::vector<Check>& checks) {
    Check bounded{"tone curve", "luminance 0 to 1e16 cd/m2 and NaN, adaptation 0 to 1e6",
                  "finite, not negative", 0, 0};
    Check rises{"tone curve", "the same", "never darker for more light", 0, 0};
    Check back{"tone curve", "display values 0 to 1, every adaptation", "its inverse gives them back", 0,
               1e-9};
    Check added{"what is added to a pixel", "glare to 1e16 cd/m2 of every hue on 0 to 1", "0 to 1", 0, 0};
    const glare::ToneSettings settings;
    const std::vector<double> luminances = {0, 5e-6, 1e-3, 1, 1e4, 1e8, 1e16};
    for (const double adaptation : adaptations_cd_m2) {
        const glare::ToneCurve curve = glare::tone_curve(settings, adaptation);
        double before = 0;
        for (const double luminance : luminances) {
            const double display = glare::tone_map(curve, luminance);
            bounded.see_within(display, 0, std::numeric_limits<double>::max());
            rises.see(std::max(0.0, before - display));
            before = display;
            for (const glare::Rgb& hue :
                 {glare::Rgb{1, 1, 1}, {4.7, 0, 0}, {-0.97, 1.69, -0.07}, {0, 0, 13.85}}) {
                for (const double pixel : {0.0, 0.02, 1.0}) {
                    const glare::Rgb delta = glare::display_delta(
                        settings, adaptation, 0, {pixel, pixel, pixel},
                        {hue[0] * luminance, hue[1] * luminance, hue[2] * luminance}, luminance);
                    for (const double channel : delta)
                        added.see_within(channel, 0, 1);
                }
            }
        }
        bounded.see_within(glare::tone_map(curve, nan), 0, 0);
        for (const double display : {0.0, 1e-4, 0.5, 1.0})
            back.see(std::abs(glare::tone_map(curve, glare::inverse_tone_map(curve, display)) - display));
    }
    checks.insert(checks.end(), {bounded, rises, back, added});
}

void colour(std::vector<Check>& checks) {
    Check finite{"chromaticity", "y = 0, outside the gamut, NaN, negative sums", "a finite colour", 0, 0};
    for (const glare::Chromaticity xy : {glare::Chromaticity{0.3, 0},
                                         {0, 0},
                                         {0.73, 0.27},
                                         {0.01, 0.72},
                                         {nan, 0.3},
                                         {0.3, nan},
                                         {-1, -1}}) {
        const glare::Xyz xyz = glare::xyz_from_chromaticity(xy, 1);
        for (const double channel : glare::unit_luminance_in_gamut(glare::srgb_from_xyz(xyz)))
            finite.see_within(channel, 0, 1e3);
    }
    checks.push_back(finite);
}

void depth(std::vector<Check>& checks) {
    Check exact{"depth", "standard, reversed and infinite projections, near 0.05 m, 1 m to 99 km, floats",
                "distance within what one step of the stored value means", 0, 1};
    constexpr double near_m = 0.05;
    constexpr double far_m = 1e5;
    for (const int kind : {0, 1, 2}) {
        glare::Frame frame;
        frame.depth_convention =
            kind == 0 ? glare::DepthConvention::standard : glare::DepthConvention::zero_to_one;
        auto& p = frame.clip_from_view;
        p[0] = p[5] = 1;
        p[11] = -1;
        p[10] = kind == 0 ? -(far_m + near_m) / (far_m - near_m) : kind == 1 ? near_m / (far_m - near_m) : 0;
        p[14] = kind == 0   ? -2 * far_m * near_m / (far_m - near_m)
                : kind == 1 ? far_m * near_m / (far_m - near_m)
                            : near_m;
        const glare::DepthModel model = glare::depth_model(frame);
        for (const double distance_m : {1.0, 100.0, 1e4, 9.9e4}) {
            const double clip = p[10] * -distance_m + p[14];
            const double ndc = clip / distance_m;
            const auto stored = static_cast<float>(kind == 0 ? 0.5 * ndc + 0.5 : ndc);
            const double found_m = glare::eye_distance_m(model, static_cast<double>(stored), {0, 0, -1});
            const auto beside_m = [&](float towards) {
                return glare::eye_distance_m(model, static_cast<double>(std::nextafter(stored, towards)),
                                             {0, 0, -1});
            };
            const double step_m = std::max(std::abs(beside_m(0) - found_m), std::abs(beside_m(1) - found_m));
            exact.see(std::abs(found_m - distance_m) / std::max(step_m, 1e-9 * distance_m));
        }
    }
    checks.push_back(exact);
}

void steps_that_are_none(std::vector<Check>& checks) {
    Check still{"time step", "0, -1, NaN, for springs, adaptation, pigments, the vitreous cloud",
                "nothing moves", 0, 0};
    for (const double step_s : {0.0, -1.0, nan}) {
        still.see(std::abs(glare::approached(3, 1, step_s, 0.1) - 3));
        still.see(glare::sprung({1, 2}, 0, step_s, 3, 0.5) == glare::SpringState{1, 2} ? 0 : 1);
        still.see(std::abs(glare::light_adapted_cd_m2(2, 1e4, step_s) - 2));
        still.see(glare::bleached({0.3, 0.4}, 1e4, step_s) == glare::Pigments{0.3, 0.4} ? 0 : 1);
        const glare::VitreousState cloud = glare::turned({}, {1, 2, 3}, 2, 0.1);
        still.see(glare::turned(cloud, cloud.head_rad_s, 2, step_s).spin_rad_s == cloud.spin_rad_s ? 0 : 1);
    }
    checks.push_back(still);
}

void tables_and_rhythms(std::vector<Check>& checks) {
    using namespace lightdb;
    Check finite{"profiles and rhythms", "no sample, one, all zero, a period of 0 s, NaN angles", "0 to 1", 0,
                 0};
    for (const AngleTable& table : {AngleTable{}, AngleTable{{0}, {0.5}}, AngleTable{{-5, 5}, {0, 0}}}) {
        for (const double angle_deg : {0.0, -90.0, 360.0, 1e300, nan}) {
            finite.see_within(clamped_factor(table, angle_deg), 0, 1);
            finite.see_within(periodic_factor(table, angle_deg), 0, 1);
        }
    }
    Rhythm none;
    Rhythm dark;
    dark.phases = {{1e-3, false}};
    dark.period_s = 1e-3;
    Rhythm empty_period;
    empty_period.phases = {{0, true}};
    for (const Rhythm& rhythm : {none, dark, empty_period}) {
        for (const double time_s : {0.0, -5.0, 1e7, 1e300, nan, infinity}) {
            for (const double exposure_s : {0.0, 1.0 / 60, 10.0, nan}) {
                for (const double share : mean_lit(rhythm, time_s, exposure_s))
                    finite.see_within(share, 0, 1);
            }
        }
    }
    checks.push_back(finite);
}

void patterns(std::vector<Check>& checks) {
    Check grid{"pattern's grid", "1 to 16384 lines, 0.01 to 179.9 degrees", "0 to max_radius_nodes", 0, 0};
    const glare::PatternSettings settings;
    for (const double lines : {1.0, 720.0, 16384.0}) {
        for (const double vfov_deg : {0.01, 45.0, 179.9}) {
            const double pitch = 2 * std::tan(vfov_deg * std::numbers::pi / 360) / lines;
            grid.see_within(glare::plan_grid(settings, pitch).radius, 0, settings.max_radius_nodes);
        }
    }
    Check energy{"pattern", "pupils 1.5 to 8.5 mm, 0.9 to 60 arc minutes a node, young and sixty years",
                 "core + skirt + tail = what the eye passes", 0, 2e-3};
    Check finite{"pattern", "the same", "no value that is not finite", 0, 0};
    glare::PatternSettings small;
    small.transform_size = 256;
    small.wavelengths = 12;
    for (const glare::EyeModel& eye : {glare::young_eye(), glare::sixty_year_eye()}) {
        const auto source = glare::make_cpu_pattern_source(eye, small, 3);
        for (const double pupil_mm : {1.5, 5.0, 8.5}) {
            for (const double pitch : {2.6e-4, 1.15e-3, 1.75e-2}) {
                glare::PatternRequest request;
                request.pupil_mm = pupil_mm;
                request.pitch = pitch;
                const glare::Pattern& made = source->make(request);
                double sum = 0;
                const std::size_t nodes = made.skirt.size() / made.layer_radius_nodes.size();
                for (std::size_t i = 1; i < nodes; i += 4)
                    sum += static_cast<double>(made.skirt[i]) * pitch * pitch;
                for (const float value : made.skirt)
                    finite.see(std::isfinite(value) ? 0 : 1);
                const double tail =
                    made.tail_scale > 0
                        ? made.tail_scale * glare::cie_tail_energy(eye.age_years, eye.pigmentation,
                                                                   made.window_inner, made.window_outer)
                        : 0;
                energy.see(std::abs(static_cast<double>(made.core_energy[0][1]) + sum + tail -
                                    glare::transmitted_fraction(eye, made.pupil_mm)));
            }
        }
    }
    checks.insert(checks.end(), {grid, energy, finite});
}

}  // namespace

std::vector<Check> extremes() {
    std::vector<Check> checks;
    intensity_and_distance(checks);
    tone(checks);
    colour(checks);
    depth(checks);
    steps_that_are_none(checks);
    tables_and_rhythms(checks);
    patterns(checks);
    return checks;
}

}  // namespace seaglare::report
