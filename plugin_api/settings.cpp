#include "plugin_api/settings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "lightdb/json/reader.h"
#include "plugin_api/budget_settings.h"
#include "plugin_api/eye_settings.h"

namespace seaglare::plugin {

namespace {

using json::ObjectReader;

void read_display(const json::Value& value, glare::ToneSettings& tone) {
    static constexpr json::Choice<glare::CompositeMode> modes[] = {
        {"difference", glare::CompositeMode::difference}, {"plain", glare::CompositeMode::plain}};
    ObjectReader reader(value, "display");
    reader.optional_string("name");
    tone.white = reader.number("white", 0.1, 1000, tone.white);
    tone.mode = reader.choice("composite", modes, tone.mode);
    tone.dither = reader.boolean("dither", tone.dither);
    reader.finish();
}

// A child that is either an object or the name of a file beside `base`.
template <class Read>
void read_inline_or_file(ObjectReader& reader, std::string_view key, const std::filesystem::path& base,
                         Read&& read) {
    const json::Value* value = reader.find(key);
    if (value == nullptr) return;
    if (value->kind() != json::Kind::string) {
        read(*value);
        return;
    }
    const json::Document document =
        json::parse_file((base / std::filesystem::path(value->string())).string());
    read(document.root());
}

// A file that names a transform and no wide field means one transform for all.
void read_wide_field(ObjectReader& reader, glare::PatternSettings& pattern) {
    if (auto child = reader.optional_object("wide_field")) {
        pattern.wide_field_size = static_cast<int>(child->integer("transform_size", 512, 4096, 4096));
        if ((pattern.wide_field_size & (pattern.wide_field_size - 1)) != 0)
            throw child->error("transform_size is not a power of two");
        if (pattern.wide_field_size <= pattern.transform_size)
            throw child->error("the wide field's transform_size must be larger than the pattern's");
        pattern.wide_field_interval_s = child->number("interval_s", 0.1, 60, pattern.wide_field_interval_s);
        child->finish();
    } else if (reader.has("transform_size")) {
        pattern.wide_field_size = 0;
    }
}

void read_motion(ObjectReader& reader, glare::PatternMotion& motion) {
    using glare::MotionMode;
    static constexpr json::Choice<MotionMode> modes[] = {{"every_frame", MotionMode::every_frame},
                                                         {"interpolated", MotionMode::interpolated},
                                                         {"flip_book", MotionMode::flip_book}};
    motion.mode = reader.choice("mode", modes, motion.mode);
    motion.rate_hz = reader.number("rate_hz", 0.1, 240, motion.rate_hz);
    motion.frames =
        static_cast<int>(reader.integer("frames", 2, glare::most_flip_book_frames, motion.frames));
    motion.loop_s = reader.number("seconds", 0.1, 600, motion.loop_s);
    motion.wait = reader.boolean("wait", motion.wait);
}

void read_pattern(ObjectReader& reader, glare::PatternSettings& pattern) {
    pattern.transform_size =
        static_cast<int>(reader.integer("transform_size", 256, 4096, pattern.transform_size));
    if ((pattern.transform_size & (pattern.transform_size - 1)) != 0)
        throw reader.require("transform_size").error("transform_size is not a power of two");
    read_wide_field(reader, pattern);
    pattern.plane_width_mm = reader.number("plane_width_mm", 1, 64, pattern.plane_width_mm);
    pattern.wavelengths = static_cast<int>(reader.integer("wavelengths", 3, 401, pattern.wavelengths));
    pattern.wavelength_step_px = reader.number("wavelength_step_px", 0, 16, pattern.wavelength_step_px);
    pattern.angular_scale = reader.number("angular_scale", 0.1, 100, pattern.angular_scale);
    pattern.max_radius_nodes =
        static_cast<int>(reader.integer("max_radius_nodes", 8, 2048, pattern.max_radius_nodes));
    static constexpr json::Choice<glare::SpectraMode> modes[] = {{"per_lamp", glare::SpectraMode::per_lamp},
                                                                 {"filter", glare::SpectraMode::filter}};
    pattern.spectra = reader.choice("spectra", modes, pattern.spectra);
    pattern.max_lamps_in_view = static_cast<int>(
        reader.integer("max_lamps_in_view", 1, glare::most_lamps, pattern.max_lamps_in_view));
    pattern.core_radius_nodes = reader.number("core_radius_nodes", 0.5, 16, pattern.core_radius_nodes);
    if (auto child = reader.optional_object("motion")) {
        read_motion(*child, pattern.motion);
        child->finish();
    }
    if (!reader.has("layer_radii_px")) return;
    const std::vector<double> radii = reader.number_list("layer_radii_px", 0, 256);
    const json::Value& where = reader.require("layer_radii_px");
    if (radii.empty() || radii.front() != 0)
        throw where.error("layer_radii_px must begin with 0, the point layer");
    if (radii.size() > glare::most_layers)
        throw where.error("layer_radii_px has more than " + std::to_string(glare::most_layers) + " layers");
    pattern.layer_radii_px.clear();
    for (const double radius : radii) {
        const auto narrow = static_cast<float>(radius);
        if (!pattern.layer_radii_px.empty() && narrow <= pattern.layer_radii_px.back())
            throw where.error("layer_radii_px must ascend");
        pattern.layer_radii_px.push_back(narrow);
    }
}

TimeOfDayTable read_time_of_day(std::span<const json::Value> rows, const json::Value& where) {
    TimeOfDayTable table;
    for (const json::Value& row : rows) {
        ObjectReader reader(row, "entry of by_time_of_day");
        TimeOfDayTable::Entry entry;
        entry.hour = reader.number("hour", 0, 24);
        entry.luminance_cd_m2 = reader.number("luminance_cd_m2", 1e-6, 1e6);
        reader.finish();
        if (!table.entries.empty() && entry.hour <= table.entries.back().hour)
            throw row.error("the hours of by_time_of_day must ascend");
        table.entries.push_back(entry);
    }
    if (table.entries.empty()) throw where.error("by_time_of_day needs an entry");
    return table;
}

}  // namespace

double TimeOfDayTable::luminance_cd_m2(double hour) const {
    if (entries.empty()) return 0.001;
    const double wrapped = hour - 24 * std::floor(hour / 24);
    const auto above =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.hour > wrapped; });
    const Entry& low = above == entries.begin() ? entries.back() : *(above - 1);
    const Entry& high = above == entries.end() ? entries.front() : *above;
    const double span = high.hour - low.hour + (high.hour > low.hour ? 0 : 24);
    const double since = wrapped - low.hour + (wrapped >= low.hour ? 0 : 24);
    const double t = span > 0 ? std::clamp(since / span, 0.0, 1.0) : 0;
    return std::exp((1 - t) * std::log(low.luminance_cd_m2) + t * std::log(high.luminance_cd_m2));
}

Settings default_settings() {
    Settings settings;
    settings.eye = glare::young_eye();
    settings.pattern.transform_size = 512;
    settings.pattern.wide_field_size = 4096;
    settings.pattern.wavelength_step_px = 1;
    // Half the work of a pattern for every frame; what it changes, no display shows: glare/psf/README.md.
    settings.pattern.motion.mode = glare::MotionMode::interpolated;
    // Orders of magnitude of the horizon sky, moonless, at the equinox in 55 degrees of latitude, where the sun stands at
    // 0, -6, -12 and -18 degrees about 0, 0.7, 1.4 and 2.1 hours after 18 h.
    settings.adaptation.entries = {{3.9, 0.001}, {4.6, 0.01},  {5.3, 1},     {6, 300},
                                   {8, 3000},    {12, 8000},   {16, 3000},   {18, 300},
                                   {18.7, 1},    {19.4, 0.01}, {20.1, 0.001}};
    return settings;
}

std::shared_ptr<const PlanSettings> plan_settings(const Settings& settings) {
    return std::make_shared<const PlanSettings>(
        PlanSettings{settings.budget, settings.pinned_costs, settings.pattern, settings.eye});
}

Settings load_settings(const std::string& path) {
    std::filesystem::path file(path);
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) file = file / "quality" / "default.json";
    const json::Document document = json::parse_file(file.string());
    const std::filesystem::path base = file.parent_path();

    Settings settings = default_settings();
    ObjectReader reader(document.root(), "quality");
    reader.optional_string("name");
    read_inline_or_file(reader, "eye", base, [&](const json::Value& value) {
        settings.eye = read_eye(value, glare::young_eye());
    });
    read_inline_or_file(reader, "display", base,
                        [&](const json::Value& value) { read_display(value, settings.tone); });
    if (auto child = reader.optional_object("pattern")) {
        read_pattern(*child, settings.pattern);
        child->finish();
    }
    bool had_threshold = false;
    if (auto child = reader.optional_object("tone")) {
        settings.tone.blue_shift = child->boolean("blue_shift", settings.tone.blue_shift);
        had_threshold = child->has("threshold_codes");
        settings.budget.max_error_codes =
            child->number("threshold_codes", 0, 16, settings.budget.max_error_codes);
        child->finish();
    }
    read_budget(reader, had_threshold, settings);
    if (auto child = reader.optional_object("adaptation")) {
        settings.default_time_of_day_h =
            child->number("default_time_of_day_h", 0, 24, settings.default_time_of_day_h);
        if (child->has("by_time_of_day")) {
            settings.adaptation =
                read_time_of_day(child->array("by_time_of_day"), child->require("by_time_of_day"));
        }
        child->finish();
    }
    settings.geographic_horizon = reader.boolean("geographic_horizon", settings.geographic_horizon);
    if (auto child = reader.optional_object("occlusion")) {
        settings.occlusion.smoothing_s = child->number("smoothing_s", 0, 10, settings.occlusion.smoothing_s);
        settings.occlusion.body_m = child->number("body_m", 0, 10, settings.occlusion.body_m);
        child->finish();
    }
    reader.finish();
    return settings;
}

}  // namespace seaglare::plugin
