// One scene at one instant as the frame reports see it: the host's picture, the lights that reach the eye, the reference's
// glare, and frames of the product under any settings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "glare/psf/pattern.h"
#include "glare/reference/frame.h"
#include "glare/reference/frame_tone.h"
#include "host_stub/plugin.h"
#include "host_stub/report/progress.h"
#include "host_stub/report/quality_file.h"
#include "host_stub/simulation.h"
#include "plugin_api/settings.h"

namespace seaglare::report {

struct FrameOptions {
    std::filesystem::path out;
    std::filesystem::path plugin;  // empty: host::plugin_candidates()
    std::filesystem::path cache;   // of reference patterns; empty: out/cache
    std::string size;              // "WxH", or empty: the channel's
    int step_nm = 10;              // of the reference's wavelengths
    bool quick = false;
    bool full = false;  // every knob, every way and number of lights
};

// What the product drew and what it took.
struct FrameRun {
    std::vector<float> hdr;           // as seaglare.hdr/1 gives it
    std::vector<std::uint8_t> after;  // RGBA, upper row first
    std::vector<double> wall_ms;      // of each frame counted: the call and the GL work it left
    std::vector<double> cpu_ms;       // of the process, meanwhile
    std::vector<seaglare_stats> stats;
};

// Compared with one of the references.
struct FrameError {
    double relative_l2 = 0;   // HDR, three channels
    double energy_ratio = 0;  // photopic luminance times solid angle, over the reference's
    double max_codes = 0;     // of what the glare becomes on the display, not rounded
    double mean_codes = 0;    // over the pixels that either changes by a tenth of a code
    double p99_codes = 0;     // over the same pixels
};

struct PictureError {  // of the bytes in the target against the rounded reference
    int max_codes = 0;
    double mean_codes = 0;
};

class FrameSubject {
  public:
    // The scene's first channel and observer at its start. Needs a GL context. `crowd_count`: lights of the scene's crowd
    // instead of its own number; 0: as it is. Throws as host::Simulation and host::Glare.
    FrameSubject(const host::Plugin& plugin, const std::filesystem::path& scene, const FrameOptions& options,
                 std::uint32_t crowd_count = 0);
    ~FrameSubject();
    FrameSubject(const FrameSubject&) = delete;
    FrameSubject& operator=(const FrameSubject&) = delete;

    const std::string& name() const;
    int width_px() const;
    int height_px() const;
    const plugin::Settings& settings() const;
    std::uint64_t seed() const;
    const std::vector<glare::PointSource>& lights() const;
    const std::vector<std::uint8_t>& before() const;  // RGBA, upper row first
    const reference::FrameScreen& screen() const;
    reference::DisplayState display() const;

    // A frame of the product under changed settings: `frames` of them are timed after `warm_up` that are not, a sixtieth of
    // a second apart, the last at the scene's start. Lights are not hidden by the land: no depth is given.
    // `wait`: each frame waits for the pattern of its own instant; else it takes the newest that is finished,
    // but for the first of the warm-up.
    FrameRun run(const Changes& changes, int warm_up, int frames, bool wait, std::uint32_t create_flags = 0);

    // What the eye would have: made once. Throws std::invalid_argument for an eye that the reference does not know.
    const std::vector<reference::Rgbv>& truth(Progress& progress);
    double structure_scale() const;
    // What production's own pattern, made for this instant under these settings, would give without any omission.
    // With a row step: reference::draw_frame.
    std::vector<reference::Rgbv> same_sum(const Changes& changes, Progress& progress, int row_step = 1);
    reference::GlareShape same_shape(const Changes& changes);

    // The reference as RGBA bytes, upper row first.
    std::vector<std::uint8_t> picture_of(const std::vector<reference::Rgbv>& glare) const;
    // Lights' glare in 8-bit codes, not rounded: three a pixel, lowest row first.
    std::vector<double> codes_of(const std::vector<reference::Rgbv>& glare) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

std::vector<reference::Rgbv> to_double(const std::vector<float>& hdr);

// `made_codes` and `codes` are codes_of() of the two. Only the rows that a row step names are looked at.
FrameError compare_frames(const FrameSubject& subject, const std::vector<reference::Rgbv>& made,
                          const std::vector<double>& made_codes, const std::vector<reference::Rgbv>& expected,
                          const std::vector<double>& codes, int row_step = 1);
PictureError compare_pictures(const std::vector<std::uint8_t>& made,
                              const std::vector<std::uint8_t>& expected);

// Process CPU time, all threads.
double process_cpu_ms();

}  // namespace seaglare::report
