// What `render` and `bench` write about the frames they drew.
#pragma once

#include <string>
#include <vector>

#include "host_stub/plugin.h"
#include "host_stub/simulation.h"
#include "lightdb/json/writer.h"

namespace seaglare::host {

struct FrameRecord {
    double time_s = 0;
    double scene_ms = 0;   // the host's own drawing, GPU work included
    double plugin_ms = 0;  // the call and the GPU work it left
    double call_ms = 0;    // the call alone
    seaglare_result result = SEAGLARE_OK;
    seaglare_stats stats{};
    seaglare_memory memory{};
};

// Members that say what was drawn with what: scene, channel, observer, light, GL, plug-in.
void write_setting(json::Writer& out, const Simulation& simulation, const NightScene& picture,
                   const Plugin* plugin, const Glare* glare);
void write_frame(json::Writer& out, const FrameRecord& frame, const Plugin& plugin);

}  // namespace seaglare::host
