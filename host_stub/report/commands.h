// seaglare-report's commands, one file each. Each returns the exit status.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host_stub/report/frame_subject.h"

namespace seaglare::report {

struct PsfOptions {
    std::filesystem::path out;
    std::filesystem::path eye;      // empty: the quality's
    std::filesystem::path quality;  // empty: the default
    double pupil_mm = 0;            // 0: the eye's own by starlight, 0.001 cd/m2
    double time_s = 0;
    int lines = 720;
    double vfov_deg = 45;
    double field_deg = 4.2;       // half the width of what is compared
    int step_nm = 5;              // of the reference
    bool quick = false;           // leave out the sweeps
    std::filesystem::path cache;  // of reference patterns made before; empty: OUT/cache
};
int psf_command(const PsfOptions& options);

// Frames of these scenes beside the frame reference.
int accuracy_command(const FrameOptions& options, const std::vector<std::filesystem::path>& scenes);
// What they take; and the crowd's scene with so many lights.
int speed_command(const FrameOptions& options, const std::vector<std::filesystem::path>& scenes,
                  const std::filesystem::path& crowd, const std::vector<std::uint32_t>& counts);

// 1 when something does not hold.
int stability_command(const std::filesystem::path& out);

}  // namespace seaglare::report
