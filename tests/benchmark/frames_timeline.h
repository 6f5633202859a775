// What the library has OpenCL do, command by command, and the host's frames, on one clock: the library's calls are met here
// before they go on. Nothing is watched until begin_timeline().
#pragma once

#include <string>

namespace seaglare::benchmark {

// Before the plug-in is loaded: queues that are there already do not tell the times of their commands.
void begin_timeline();
// Something that happened to a frame, now.
void note_frame(int frame, const char* what);
// CSV in the order of the calls: queue, command, items, and when it was called, queued, submitted, started and ended, in ms.
// Frames have `frame` as their queue. Throws std::runtime_error.
void write_timeline(const std::string& file);

}  // namespace seaglare::benchmark
