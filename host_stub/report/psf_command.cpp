#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "glare/colour/spectrum.h"
#include "host_stub/report/commands.h"
#include "host_stub/report/pattern_archive.h"
#include "host_stub/report/psf_pictures.h"
#include "host_stub/report/psf_sweeps.h"
#include "host_stub/report/thesis_pattern.h"
#include "plugin_api/settings.h"

namespace seaglare::report {

namespace {

constexpr double starlight_cd_m2 = 0.001;

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

std::string rounded(double value, const char* format) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

}  // namespace

int psf_command(const PsfOptions& options) {
    Progress progress;
    const Subject subject = subject_of(options);
    Page page(options.out, "The glare pattern of one light");
    Study study{page, progress, {}, 0, ""};
    study.reference = archived_patterns(
        options.cache.empty() ? options.out / "cache" : options.cache,
        [&](const std::string& what, double done) { progress.show(study.part + what, done); });

    const auto truth =
        study.reference(reference_request(subject), {reference::lines_of(glare::d65, subject.step_nm)})
            .front();
    progress.show("production");
    const auto source = source_of(subject);
    const glare::Pattern& pattern = source->make(request_of(subject));
    const std::string scales = subject.settings.wide_field_size > 0
                                   ? std::to_string(subject.settings.transform_size) + " + "
                                   : std::string();
    page.paragraph("Pupil " + rounded(subject.pupil_mm, "%.2f") + " mm, pixels of " +
                   rounded(subject.pitch * 60 * 180 / std::numbers::pi, "%.2f") + " arc minutes (" +
                   std::to_string(options.lines) + " lines over " + rounded(options.vfov_deg, "%g") +
                   " degrees), transform " + scales + std::to_string(pattern.transform_size) + ", " +
                   std::to_string(pattern.wavelengths) + " wavelengths, angular scale " +
                   rounded(pattern.angular_scale, "%g") + ", on " + source->device_name() +
                   ". The reference: double precision, every " + std::to_string(subject.step_nm) +
                   " nm diffracted on its own, pixels integrated exactly.");
    const PatternImage made = image_of(pattern, subject.settings.core_radius_nodes, subject.radius);
    const PatternImage exact = image_of(truth);
    page.heading("Pictures");
    page.paragraph("Each is " + rounded(2 * options.field_deg, "%g") +
                   " degrees wide; EXR, 1/sr, linear sRGB and scotopic: production.exr, reference.exr.");
    write_pictures(page, "production", "Production", made);
    write_pictures(page, "reference", "Reference", exact);
    write_difference(page, made, exact);
    write_profiles(page, subject, made, exact);

    progress.show("FFTW's transform");
    study.unit_ms = fftw_512_ms();
    page.paragraph(
        "One complex 512 x 512 FFTW transform, single precision, one thread, in this run: " +
        rounded(study.unit_ms, "%.3f") +
        " ms of the processor's time. Times of patterns are the processor's, of all threads together, "
        "where the processor does the work, and else the clock's.");
    if (!options.quick) {
        const std::vector<std::pair<const char*, std::function<void()>>> parts = {
            {"knobs", [&] { sweep_knobs(study, subject, truth); }},
            {"eyes", [&] { compare_presets(study, subject); }},
            {"run time", [&] { sweep_frontier(study, subject); }},
            {"yardstick", [&] { sweep_yardstick(study, subject); }}};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            study.part =
                std::to_string(i + 1) + "/" + std::to_string(parts.size()) + " " + parts[i].first + ": ";
            parts[i].second();
        }
    }
    page.finish();
    std::cout << (page.folder() / "index.html").string() << "\n";
    return 0;
}

}  // namespace seaglare::report
