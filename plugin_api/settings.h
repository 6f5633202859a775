// What the operator sets in config/quality, config/eye and config/display, as the values that the parts below take.
// Files: config/schema/{quality,eye,display}.schema.json describe the same.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glare/eye/eye_model.h"
#include "glare/frame.h"
#include "glare/plan/budget.h"
#include "glare/plan/device_costs.h"
#include "glare/psf/pattern.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::plugin {

// Adaptation luminance against local time of day, for frames that do not bring their own: interpolated linearly in the
// logarithm, periodic over 24 h.
struct TimeOfDayTable {
    struct Entry {
        double hour = 0;  // 0 ... 24, ascending
        double luminance_cd_m2 = 0.001;
    };
    std::vector<Entry> entries;
    double luminance_cd_m2(double hour) const;
};

struct Settings {
    glare::EyeModel eye;
    glare::PatternSettings pattern;
    glare::ToneSettings tone;
    TimeOfDayTable adaptation;
    double default_time_of_day_h = 0;
    bool geographic_horizon = true;
    glare::OcclusionSettings occlusion{.smoothing_s = 0.1, .body_m = 0.15};
    glare::Budget budget;
    std::optional<glare::DeviceCosts> pinned_costs;  // nothing: measured
};

// What a frame's plan is made from, and what does not change until the next load_config().
struct PlanSettings {
    glare::Budget budget;
    std::optional<glare::DeviceCosts> pinned_costs;
    glare::PatternSettings pattern;
    glare::EyeModel eye;
};
std::shared_ptr<const PlanSettings> plan_settings(const Settings& settings);

// What config/quality/default.json says, without a file.
Settings default_settings();

// Reads a quality file, or `path`/quality/default.json when `path` is a folder. Eye and display files are named
// relative to the file that names them. Keys that are left out keep their default; an unknown key is an error.
// Throws json::Error, std::system_error.
Settings load_settings(const std::string& path);

}  // namespace seaglare::plugin
