// The settings that the frame reports turn one at a time.
#pragma once

#include <string>
#include <vector>

#include "host_stub/report/quality_file.h"

namespace seaglare::report {

struct Knob {
    std::string name;   // "transform"
    std::string value;  // "1024, no wide field"
    Changes changes;    // on top of the scene's own quality
    bool opencl = true;
    bool same_pattern = false;  // the pattern is that of the scene's own quality
};

// The first is the scene's own quality, unchanged. `quick`: a few of them.
std::vector<Knob> frame_knobs(bool quick);

// Ways to add lights up: device costs pinned so that the plan has no other choice.
std::vector<Knob> accumulation_knobs();

}  // namespace seaglare::report
