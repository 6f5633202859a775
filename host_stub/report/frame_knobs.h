// The settings that the frame reports turn one at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host_stub/report/frame_subject.h"
#include "host_stub/report/quality_file.h"

namespace seaglare::report {

struct Knob {
    std::string name;   // "transform"
    std::string value;  // "1024, no wide field"
    Changes changes;    // on top of the scene's own quality
    bool opencl = true;
    bool same_pattern = false;  // the pattern is that of the scene's own quality
};

// How many of them: a few in a second each; every knob at a setting or two; every setting.
enum class KnobRange : std::uint8_t { few, usual, all };

// The first is the scene's own quality, unchanged.
std::vector<Knob> frame_knobs(KnobRange range);

inline KnobRange range_of(const FrameOptions& options) {
    if (options.quick) return KnobRange::few;
    return options.full ? KnobRange::all : KnobRange::usual;
}

// Ways to add lights up: device costs pinned so that the plan has no other choice.
std::vector<Knob> accumulation_knobs();

}  // namespace seaglare::report
