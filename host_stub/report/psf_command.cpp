#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>

#include "glare/colour/spectrum.h"
#include "host_stub/report/commands.h"
#include "host_stub/report/pattern_image.h"
#include "host_stub/report/psf_sweeps.h"
#include "host_stub/report/thesis_pattern.h"
#include "plugin_api/settings.h"

namespace seaglare::report {

namespace {

constexpr double starlight_cd_m2 = 0.001;
constexpr double ten_thousand_cd_at_1_km_lx = 1e-2;

// The eye file read by the product's own reader, through a quality file that names it and nothing else.
glare::EyeModel load_eye(const std::filesystem::path& path) {
    const std::filesystem::path quality =
        std::filesystem::temp_directory_path() / ("seaglare-report-" + std::to_string(getpid()) + ".json");
    struct Remover {
        const std::filesystem::path& path;
        ~Remover() {
            std::error_code ignored;
            std::filesystem::remove(path, ignored);
        }
    } const remover{quality};
    std::string name;
    for (const char c : std::filesystem::absolute(path).string()) {
        if (c == '"' || c == '\\') name += '\\';
        name += c;
    }
    std::ofstream(quality) << "{\"eye\": \"" << name << "\"}\n";
    return plugin::load_settings(quality.string()).eye;
}

Subject subject_of(const PsfOptions& options) {
    Subject subject;
    const plugin::Settings settings = options.quality.empty()
                                          ? plugin::default_settings()
                                          : plugin::load_settings(options.quality.string());
    subject.settings = settings.pattern;
    subject.eye = options.eye.empty() ? settings.eye : load_eye(options.eye);
    const double own = subject.eye.fixed_pupil_mm > 0 ? subject.eye.fixed_pupil_mm
                                                      : glare::mean_pupil_diameter_mm(starlight_cd_m2);
    subject.pupil_mm = options.pupil_mm > 0 ? options.pupil_mm : own;
    subject.time_s = options.time_s;
    subject.pitch = 2 * std::tan(options.vfov_deg * std::numbers::pi / 360) / options.lines;
    subject.radius = std::max(
        8, static_cast<int>(std::ceil(std::sin(options.field_deg * std::numbers::pi / 180) / subject.pitch)));
    subject.step_nm = options.step_nm;
    return subject;
}

void write_pictures(Page& page, const std::string& name, const std::string& what, const PatternImage& image) {
    const int zoom = std::max(1, 520 / image.side());
    const std::filesystem::path& out = page.folder();
    write_night_png(image, out / (name + "_night.png"), zoom, ten_thousand_cd_at_1_km_lx);
    write_linear_png(image, out / (name + "_linear.png"), zoom, 100);
    write_log_png(image, out / (name + "_log.png"), zoom);
    write_false_colour_png(image, out / (name + "_false.png"), zoom);
    write_image_exr(image, out / (name + ".exr"));
    page.pictures({name + "_night.png", name + "_linear.png", name + "_log.png", name + "_false.png"},
                  {what + ": 10 000 cd at 1 km by starlight, photographic operator",
                   what + ": linear, white at 100 per steradian",
                   what + ": logarithmic, 0.03 to 10 000 per steradian, colours strengthened",
                   what + ": false colour of the photopic value"});
}

void write_profiles(Page& page, const Subject& subject, const PatternImage& made, const PatternImage& truth) {
    const std::vector<Ring> ours = rings_of(made);
    const std::vector<Ring> exact = rings_of(truth);
    const double age = subject.eye.age_years;
    const double pigment = subject.eye.pigmentation;
    Table table({"angle deg", "production 1/sr", "reference 1/sr", "CIE 135/1 1/sr", "Spencer photopic 1/sr",
                 "Spencer scotopic 1/sr", "production/CIE", "reference/CIE", "outer deg", "production inside",
                 "reference inside", "CIE inside", "Spencer photopic inside"});
    double cie_inside = 0;
    double spencer_inside = 0;
    double from_deg = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        // The curves' energy by the midpoint rule on fine steps that grow from the light.
        constexpr int steps = 400;
        for (int s = 0; s < steps; ++s) {
            const double a =
                from_deg + (ours[i].outer_deg - from_deg) * std::pow(static_cast<double>(s) / steps, 2);
            const double b = from_deg + (ours[i].outer_deg - from_deg) * std::pow((s + 1.0) / steps, 2);
            const double middle = (a + b) / 2;
            const double ring = 2 * std::numbers::pi * std::sin(middle * std::numbers::pi / 180) * (b - a) *
                                std::numbers::pi / 180;
            cie_inside += ring * reference::cie_curve_sr(middle, age, pigment);
            spencer_inside += ring * spencer_photopic_sr(middle);
        }
        from_deg = ours[i].outer_deg;
        // The middle pixel has no angle of its own on a logarithmic axis: a third of a pixel.
        const double angle = std::max(ours[i].angle_deg, subject.pitch * 60 / std::numbers::pi);
        const double cie = reference::cie_curve_sr(angle, age, pigment);
        table.add() << angle << ours[i].mean_sr << exact[i].mean_sr << cie << spencer_photopic_sr(angle)
                    << spencer_scotopic_sr(angle) << ours[i].mean_sr / cie << exact[i].mean_sr / cie
                    << ours[i].outer_deg << ours[i].energy_inside << exact[i].energy_inside << cie_inside
                    << spencer_inside;
    }
    page.heading("Radial profile and encircled energy");
    page.paragraph(
        "CIE 135/1-1999, total glare, for the eye's own age and pigmentation; Spencer et al. 1995, photopic "
        "and scotopic. "
        "Within two pixels production keeps its core as one energy and draws it as a footprint that does not "
        "flicker; here "
        "it is laid mostly on the middle pixel.");
    page.table("profile", "Per ring of pixels", table, false);
    page.plot({"profile",
               "Radial average",
               "angle from the light, degrees",
               "sr^-1",
               {{"profile.csv", 1, 2, "production", "lines lw 2", 0},
                {"profile.csv", 1, 3, "reference", "lines lw 2 dt 2", 0},
                {"profile.csv", 1, 4, "CIE 135/1", "lines lw 1.5", 0},
                {"profile.csv", 1, 5, "Spencer 1995, photopic", "lines lw 1.5", 0},
                {"profile.csv", 1, 6, "Spencer 1995, scotopic", "lines lw 1.5 dt 3", 0}},
               true,
               true,
               ""});
    page.plot({"ratio",
               "Radial average over the CIE curve",
               "angle from the light, degrees",
               "ratio",
               {{"profile.csv", 1, 7, "production", "lines lw 2", 0},
                {"profile.csv", 1, 8, "reference", "lines lw 2 dt 2", 0}},
               true,
               false,
               "set yrange [0:*]"});
    page.plot({"encircled",
               "Encircled energy",
               "angle from the light, degrees",
               "share of the light",
               {{"profile.csv", 9, 10, "production", "lines lw 2", 0},
                {"profile.csv", 9, 11, "reference", "lines lw 2 dt 2", 0},
                {"profile.csv", 9, 12, "CIE 135/1", "lines lw 1.5", 0},
                {"profile.csv", 9, 13, "Spencer 1995, photopic", "lines lw 1.5", 0}},
               true,
               false,
               "set yrange [0:1.05]\nset key inside right bottom"});
}

}  // namespace

int psf_command(const PsfOptions& options) {
    Progress progress;
    const Subject subject = subject_of(options);
    Page page(options.out, "The glare pattern of one light");

    progress.show("reference", 0);
    const auto truth = reference::make_reference(reference_request(subject),
                                                 {reference::lines_of(glare::d65, subject.step_nm)},
                                                 [&](double done) { progress.show("reference", done); })
                           .front();
    progress.show("production");
    const auto source = source_of(subject);
    const glare::Pattern& pattern = source->make(request_of(subject));

    page.paragraph("Pupil " + std::to_string(subject.pupil_mm) + " mm, pixels of " +
                   std::to_string(subject.pitch * 60 * 180 / std::numbers::pi) + " arc minutes (" +
                   std::to_string(options.lines) + " lines over " + std::to_string(options.vfov_deg) +
                   " degrees), transform " + std::to_string(pattern.transform_size) + ", " +
                   std::to_string(pattern.wavelengths) + " wavelengths, angular scale " +
                   std::to_string(pattern.angular_scale) + ", on " + source->device_name() +
                   ". The reference: double precision, every " + std::to_string(subject.step_nm) +
                   " nm diffracted on its own, pixels integrated exactly.");
    const PatternImage made = image_of(pattern, subject.settings.core_radius_nodes, subject.radius);
    const PatternImage exact = image_of(truth);
    page.heading("Pictures");
    write_pictures(page, "production", "Production", made);
    write_pictures(page, "reference", "Reference", exact);
    write_false_colour_key(page.folder() / "false_colour_key.png");
    page.pictures({"false_colour_key.png"},
                  {"False colours, left to right 0.1 to 1 000 000 per steradian, a mark per decade"});
    page.paragraph("EXR, sr^-1, linear sRGB and scotopic: production.exr, reference.exr.");
    write_profiles(page, subject, made, exact);

    progress.show("yardstick");
    const double unit_ms = fftw_512_ms();
    page.paragraph(
        "One complex 512 x 512 FFTW transform, single precision, one thread, in this run: " +
        std::to_string(unit_ms) +
        " ms. Times of patterns are the processor's, of all threads together, where the processor does "
        "the work, and else the clock's.");
    if (!options.quick) {
        sweep_knobs(page, progress, subject, truth, unit_ms);
        compare_presets(page, progress, subject, unit_ms);
        sweep_frontier(page, progress, subject, unit_ms);
        sweep_yardstick(page, progress, subject, unit_ms);
    }
    page.finish();
    std::cout << (page.folder() / "index.html").string() << "\n";
    return 0;
}

}  // namespace seaglare::report
