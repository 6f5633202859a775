// Every eye that ships against its own reference: with what it ships with, and with each knob turned from there. And the
// young eye's pattern for each lamp's colour.
#include <algorithm>
#include <cmath>

#include "glare/colour/navigation_colours.h"
#include "host_stub/report/psf_sweeps.h"

namespace seaglare::report {

namespace {

constexpr double starlight_cd_m2 = 0.001;
constexpr int frames = 48;

struct Preset {
    const char* name;  // of its file in config/eye
    Subject subject;
};

std::vector<Preset> presets(const Subject& subject) {
    std::vector<Preset> all;
    const auto add = [&](const char* name, glare::EyeModel eye, const glare::PatternSettings& settings) {
        Subject s = subject;
        s.pupil_mm = glare::resting_pupil_diameter_mm(eye, starlight_cd_m2);
        s.eye = std::move(eye);
        s.settings = settings;
        s.time_s = instant_s;
        all.push_back({name, limited(s)});
    };
    add("young", glare::young_eye(), subject.settings);
    add("young_lashes", glare::young_eye_with_lashes(), subject.settings);
    add("no_lash", glare::no_lash_eye(), subject.settings);
    add("sixty", glare::sixty_year_eye(), subject.settings);
    add("thesis", glare::thesis_eye(), glare::thesis_settings());
    add("circular_pupil", glare::circular_pupil_eye(), subject.settings);
    return all;
}

std::string as_shipped(const glare::PatternSettings& settings) {
    std::string text = "as shipped: " + std::to_string(settings.transform_size);
    if (settings.wide_field_size > 0) text += " + " + std::to_string(settings.wide_field_size);
    return text + ", " + std::to_string(settings.wavelengths) + " wavelengths, 32 bits";
}

// What a frame's pattern costs: of two scales with what the frame adds to the wide field of the next interval.
Cost cost_in_a_frame(glare::PatternSource& source, const Subject& s) {
    const glare::PatternRequest request = request_of(s);
    return s.settings.wide_field_size > 0 ? cost_of_frames(source, request, s.time_s, frames)
                                          : cost_of(source, request);
}

class PresetTable {
  public:
    PresetTable(const reference::ReferencePattern& truth, const char* preset, Table& table, double unit_ms)
        : truth_(truth), preset_(preset), table_(table), unit_ms_(unit_ms) {}

    // Every knob, from what the preset ships with.
    void turn(const Subject& shipped, Table& as_it_is) {
        const auto source = source_of(shipped);
        const Cost cost = cost_in_a_frame(*source, shipped);
        glare::Pattern pattern = source->make(request_of(shipped));
        row(as_shipped(shipped.settings), shipped, pattern, cost);
        add_error(as_it_is.add() << preset_ << shipped.pupil_mm,
                  reference::compare(truth_, shipped.eye, pattern, shipped.settings.core_radius_nodes), cost,
                  unit_ms_);
        for (const int n : {256, 512, 1024, 2048, 4096}) {
            Subject s = shipped;
            s.settings.transform_size = n;
            s.settings.wide_field_size = 0;
            row("one transform of " + std::to_string(n), s);
        }
        for (const int count : {8, 15, 60, 120}) {
            Subject s = shipped;
            s.settings.wavelengths = count;
            row(std::to_string(count) + " wavelengths", s);
        }
        const Cost unknown{std::nan(""), std::nan("")};
        const std::vector<float> exact = pattern.skirt;
        for (float& value : pattern.skirt)
            value = to_half(value);
        row("16 bits", shipped, pattern, unknown);
        const float scale = 1024 / std::max(*std::max_element(exact.begin(), exact.end()), 1e-6F);
        for (std::size_t i = 0; i < exact.size(); ++i)
            pattern.skirt[i] = to_half(exact[i] * scale) / scale;
        row("16 bits, scaled", shipped, pattern, unknown);
    }

  private:
    void row(const std::string& knob, const Subject& s) {
        const auto source = source_of(s);
        const Cost cost = cost_in_a_frame(*source, s);
        row(knob, s, source->make(request_of(s)), cost);
    }
    void row(const std::string& knob, const Subject& s, const glare::Pattern& pattern, const Cost& cost) {
        const auto error = reference::compare(truth_, s.eye, pattern, s.settings.core_radius_nodes);
        add_error(table_.add() << preset_ << knob, error, cost, unit_ms_);
    }

    const reference::ReferencePattern& truth_;
    const char* preset_;
    Table& table_;
    double unit_ms_;
};

void turn_layers(const Preset& preset, const reference::ReferencePattern& truth, Table& table) {
    const std::vector<std::vector<float>> sets = {{0, 10},
                                                  {0, 3, 10},
                                                  preset.subject.settings.layer_radii_px,
                                                  {0, 1.7F, 3.05F, 6.35F, 10},
                                                  {0, 0.8F, 1.6F, 2.6F, 4, 5.7F, 7.7F, 10}};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        Subject s = preset.subject;
        s.settings.layer_radii_px = sets[i];
        s = limited(s);
        const auto source = source_of(s);
        const glare::Pattern& pattern = source->make(request_of(s));
        Table::Row& row = table.add();
        std::string radii;
        for (const float radius : sets[i])
            radii += (radii.empty() ? "" : " ") + std::to_string(radius).substr(0, 4);
        row << preset.name << static_cast<int>(sets[i].size()) << (radii + (i == 2 ? " (as shipped)" : ""));
        for (const double radius : {1.0, 2.5, 5.0, 8.0, 10.0})
            row << reference::disc_error(truth, s.eye, pattern, s.settings.core_radius_nodes, radius);
    }
}

void compare_lamps(const Study& study, Subject s, const std::vector<reference::ReferencePattern>& truths) {
    s = limited(s);
    Table table = error_table({"lamp", "spectra"});
    study.page.keep("lamps", table);
    for (const auto mode : {glare::SpectraMode::per_lamp, glare::SpectraMode::filter}) {
        s.settings.spectra = mode;
        const auto source = source_of(s);
        for (std::size_t lamp = 0; lamp < truths.size(); ++lamp) {
            glare::PatternRequest request = request_of(s);
            request.lamps = 1U << lamp;
            const Cost cost = cost_of(*source, request);
            const glare::Pattern& pattern = source->make(request);
            const auto error = reference::compare(truths[lamp], s.eye, pattern, s.settings.core_radius_nodes,
                                                  pattern.slot_of_lamp[lamp]);
            static constexpr const char* names[] = {"white", "red", "green", "yellow", "blue", "orange"};
            Table::Row& row = table.add();
            row << names[lamp] << (mode == glare::SpectraMode::filter ? "white filtered" : "its own");
            add_error(row, error, cost, study.unit_ms);
        }
    }
    study.page.table(
        "lamps",
        "The young eye's pattern of each lamp. A filtered white pattern is cheaper: the same pattern for all",
        table);
}

}  // namespace

void compare_presets(const Study& study, const Subject& subject) {
    Table table = error_table({"eye", "knob"});
    Table layers({"eye", "layers", "radii px", "1 px", "2.5 px", "5 px", "8 px", "10 px"});
    Table shipped = error_table({"eye", "pupil mm"});
    study.page.keep("presets", table);
    study.page.keep("preset_layers", layers);
    study.page.keep("presets_shipped", shipped);
    const std::vector<Preset> all = presets(subject);
    std::vector<reference::ReferencePattern> lamps;
    Subject young;
    for (const Preset& preset : all) {
        const double done = static_cast<double>(&preset - all.data()) / static_cast<double>(all.size());
        study.show(preset.name, done);
        std::vector<std::vector<reference::SpectralLine>> spectra;
        const bool every_lamp = preset.name == std::string("young");
        spectra.reserve(6);
        for (int lamp = 0; lamp < (every_lamp ? 6 : 1); ++lamp)
            spectra.push_back(reference::lines_of(glare::navigation_spectrum(lamp), preset.subject.step_nm));
        auto truths = study.reference(reference_request(preset.subject), spectra);
        study.show(std::string(preset.name) + ", knobs", done);
        PresetTable(truths.front(), preset.name, table, study.unit_ms).turn(preset.subject, shipped);
        study.show(std::string(preset.name) + ", layers", done);
        turn_layers(preset, truths.front(), layers);
        if (!every_lamp) continue;
        lamps = std::move(truths);
        young = preset.subject;
    }
    study.page.heading("Every eye");
    study.page.paragraph("Each eye of config/eye at its own pupil by starlight, those that move at " +
                         std::to_string(instant_s).substr(0, 3) +
                         " s, against its own reference. Columns as above. The thesis eye has the thesis's "
                         "settings: 512 samples over "
                         "9 mm, magnified 18 times, coarser than Nyquist's limit for its pupil's power "
                         "spectrum (two pupils wide): a "
                         "tenth of its light is misplaced, and that is the look of 2012. Times are a "
                         "frame's: of two scales the mean "
                         "of " +
                         std::to_string(frames) + " frames, wide field and all.");
    study.page.table("presets_shipped", "As shipped, point layer", shipped);
    study.page.table("presets", "The same with one knob turned at a time", table);
    study.page.table(
        "preset_layers",
        "Relative L1 of the skirt of discs, by their radius: mixed from the layers as the product draws them",
        layers);
    compare_lamps(study, young, lamps);
}

}  // namespace seaglare::report
