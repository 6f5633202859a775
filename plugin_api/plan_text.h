// The plan of the last frame, what it predicted and what came of it, as JSON text for copy_plan.
#pragma once

#include <string>

#include "glare/device/device_memory.h"
#include "glare/plan/plan.h"
#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

struct PlanFacts {
    std::string channel;
    std::string device;           // where the pattern is made
    std::string degraded_reason;  // empty: with OpenCL
    std::string sharing;          // how what is gathered comes to GL
    bool rendered = false;        // a frame has been asked for
    bool drawn = false;
    bool pattern_reused = false;  // another channel, or this one, made it already
    bool asked_visibility = false;
    std::uint32_t hidden_by_host = 0;  // lights the visibility callback set to 0
    std::uint32_t late_lights =
        0;  // of which it is not known yet how much is hidden: drawn without their skirts
    glare::DeviceMemory memory;  // held after this frame
};

// `costs` the plan was made from; `measured` is what this view knows of its device, and may be the same.
std::string plan_text(const PlanFacts& facts, const glare::Plan& plan, const glare::DeviceCosts& costs,
                      const glare::DeviceCosts& measured, const seaglare_stats& stats);

}  // namespace seaglare::plugin
