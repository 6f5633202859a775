// What the last frame did and what it left out, each with its reason, as JSON text for copy_plan.
#pragma once

#include <string>

#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

struct PlanFacts {
    std::string channel;
    std::string device;           // where the pattern is made
    std::string degraded_reason;  // empty: with OpenCL
    bool rendered = false;        // a frame has been asked for
    bool drawn = false;
    bool pattern_reused = false;  // another channel, or this one, made it for the same instant
    bool asked_visibility = false;
    std::uint32_t hidden_by_host = 0;  // lights the visibility callback set to 0
    std::uint32_t layers_configured = 0;
    std::uint32_t too_far =
        0;  // lights too faint at the eye to be evaluated, of stats.lights_below_threshold
    // Lights drawn with the pattern of a lamp that is not theirs: by the configuration's "spectra": "filter", or because
    // more lamps are in view than max_lamps_in_view.
    std::uint32_t with_pattern_of_another = 0;
    bool filtered = false;
    std::uint32_t spectra_without_pattern = 0;  // of the database, which has more than can have one
    double threshold_codes = 0;
    double extinction_per_m = 0;
};

std::string plan_text(const PlanFacts& facts, const seaglare_stats& stats);

}  // namespace seaglare::plugin
