#include "host_stub/report/psf_sweeps.h"

#include <algorithm>
#include <cmath>

namespace seaglare::report {

namespace {

void sweep_resolution(const Study& study, const Subject& subject, const reference::ReferencePattern& truth) {
    Table table = error_table({"N"});
    study.page.keep("resolution", table);
    for (const int n : {256, 512, 1024, 2048, 4096}) {
        Subject s = limited(subject);
        s.settings.transform_size = n;
        s.settings.wide_field_size = 0;
        const auto source = source_of(s);
        const glare::PatternRequest request = request_of(s);
        const Cost cost = cost_of(*source, request);
        const glare::Pattern& pattern = source->make(request);
        add_error(table.add() << pattern.transform_size,
                  reference::compare(truth, s.eye, pattern, s.settings.core_radius_nodes), cost,
                  study.unit_ms);
    }
    study.page.table(
        "resolution",
        "Transform size. L1: over the field that the size reaches; total L1: over the whole field, "
        "the tail where "
        "the structure ends",
        table);
    study.page.plot({"resolution",
                     "Transform size",
                     "processor time of one pattern, ms",
                     "relative L1 on screen pixels",
                     {{"resolution.csv", 11, 2, "in its own field", "linespoints lt 1", 1},
                      {"resolution.csv", 11, 4, "over the whole field", "linespoints lt 2", 1}},
                     true,
                     true,
                     ""});
}

void sweep_wavelengths(const Study& study, const Subject& subject, const reference::ReferencePattern& truth) {
    Table table = error_table({"wavelengths"});
    study.page.keep("wavelengths", table);
    for (const int count : {5, 8, 15, 30, 60, 120}) {
        Subject s = limited(subject);
        s.settings.wavelengths = count;
        const auto source = source_of(s);
        const glare::PatternRequest request = request_of(s);
        const Cost cost = cost_of(*source, request);
        add_error(table.add() << count,
                  reference::compare(truth, s.eye, source->make(request), s.settings.core_radius_nodes), cost,
                  study.unit_ms);
    }
    study.page.table("wavelengths", "Samples of the spectrum", table);
    study.page.plot({"wavelengths",
                     "Samples of the spectrum",
                     "wavelengths",
                     "relative L1 on screen pixels",
                     {{"wavelengths.csv", 1, 2, "core + skirt", "linespoints lt 1", 0},
                      {"wavelengths.csv", 1, 3, "skirt", "linespoints lt 2", 0}},
                     true,
                     true,
                     ""});
}

void sweep_layers(const Study& study, const Subject& subject, const reference::ReferencePattern& truth) {
    const std::vector<std::vector<float>> sets = {{0, 10},
                                                  {0, 3, 10},
                                                  {0, 1.5F, 4, 10},
                                                  {0, 1.7F, 3.05F, 6.35F, 10},
                                                  {0, 1, 2, 4, 7, 10},
                                                  {0, 0.8F, 1.6F, 2.6F, 4, 5.7F, 7.7F, 10}};
    Table table({"layers", "mean L1", "worst L1", "worst at px", "ms", "x FFTW 512"});
    study.page.keep("layers", table);
    Table curves({"disc radius px", "2 layers", "3", "4", "5", "6", "8"});
    std::vector<std::vector<double>> errors(sets.size());
    const std::vector<double> radii = {0.5, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9, 10};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        Subject s = subject;
        s.settings.layer_radii_px = sets[i];
        s = limited(s);
        const auto source = source_of(s);
        const glare::PatternRequest request = request_of(s);
        const Cost cost = cost_of(*source, request);
        const glare::Pattern& pattern = source->make(request);
        double worst = 0;
        double worst_at = 0;
        double sum = 0;
        for (const double radius : radii) {
            study.show("disc layers",
                       (static_cast<double>(i) + radius / 10) / static_cast<double>(sets.size()));
            const double error =
                reference::disc_error(truth, s.eye, pattern, s.settings.core_radius_nodes, radius);
            errors[i].push_back(error);
            sum += error;
            if (error > worst) {
                worst = error;
                worst_at = radius;
            }
        }
        table.add() << static_cast<int>(sets[i].size()) << sum / static_cast<double>(radii.size()) << worst
                    << worst_at << cost.work_ms << cost.work_ms / study.unit_ms;
    }
    for (std::size_t r = 0; r < radii.size(); ++r) {
        Table::Row& row = curves.add() << radii[r];
        for (const auto& error : errors)
            row << error[r];
    }
    study.page.table(
        "layers",
        "Disc layers: the skirt of a disc whose radius is on no layer, mixed linearly in the square "
        "of the radius as "
        "the product draws it, against the exact disc",
        table);
    study.page.table("layers_by_radius", "The same by radius", curves, false);
    Plot plot{"layers", "Disc layers", "disc radius, px", "relative L1 of the skirt", {}, false, true, ""};
    for (int i = 0; i < static_cast<int>(sets.size()); ++i)
        plot.curves.push_back({"layers_by_radius.csv", 1, i + 2,
                               std::to_string(sets[static_cast<std::size_t>(i)].size()) + " layers",
                               "linespoints lt " + std::to_string(i + 1), 0});
    study.page.plot(plot);
}

void compare_precision(const Study& study, const Subject& subject, const reference::ReferencePattern& truth) {
    const Subject s = limited(subject);
    const auto source = source_of(s);
    glare::Pattern pattern = source->make(request_of(s));
    Table table({"skirt kept as", "L1", "skirt L1", "worst/peak", "worst/pixel", "largest value, 1/sr"});
    const float largest = *std::max_element(pattern.skirt.begin(), pattern.skirt.end());
    const auto add = [&](const char* name) {
        const auto e = reference::compare(truth, s.eye, pattern, s.settings.core_radius_nodes);
        table.add() << name << e.relative_l1 << e.skirt_l1 << e.worst_of_peak << e.worst_relative
                    << static_cast<double>(largest);
    };
    add("32-bit floats");
    const std::vector<float> exact = pattern.skirt;
    for (float& value : pattern.skirt)
        value = to_half(value);
    add("16-bit floats");
    // Scaled so that the largest value is 1024.
    const float scale = 1024 / std::max(largest, 1e-6F);
    for (std::size_t i = 0; i < exact.size(); ++i)
        pattern.skirt[i] = to_half(exact[i] * scale) / scale;
    add("16-bit floats, scaled");
    study.page.table("precision",
                     "What a texture of half floats would cost (values beyond 65504 are clamped)", table);
}

}  // namespace

void sweep_knobs(const Study& study, const Subject& subject, const reference::ReferencePattern& truth) {
    study.page.heading("Production against the reference");
    study.page.paragraph(
        "L1 is the sum of absolute differences over the sum of the reference, on screen pixels, four "
        "channels, core "
        "included; skirt L1 leaves the core out; total L1 compares core, skirt and CIE tail with the "
        "reference as it is, "
        "no energy adjusted. Worst/peak is the largest difference over the largest value, worst/pixel over "
        "the pixel's own "
        "(and a tenth of its ring's mean). Colour differences are CIELAB 1976 of a zone's summed light: core "
        "within 0.15 "
        "degrees, ring from 2.2 to 3.9. Structure scale: what the simulated energy is multiplied by to leave "
        "room for the "
        "tail.");
    study.show("transform sizes");
    sweep_resolution(study, subject, truth);
    study.show("wavelengths");
    sweep_wavelengths(study, subject, truth);
    sweep_layers(study, subject, truth);
    study.show("precision");
    compare_precision(study, subject, truth);
}

}  // namespace seaglare::report
