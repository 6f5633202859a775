// Draws point sources with a glare pattern into one GL context's target: upload, accumulate into the HDR buffer, tone
// map, add. Owns the GL objects of one view. Knows nothing of lights' names, rhythms or files.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "glare/apply/prepared_pattern.h"
#include "glare/apply/screen_geometry.h"
#include "glare/device/device_memory.h"
#include "glare/device/gl.h"
#include "glare/device/gl_pass_timer.h"
#include "glare/device/gl_sharing.h"
#include "glare/frame.h"
#include "glare/plan/accumulation.h"
#include "glare/psf/pattern.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

struct RenderStats {
    std::uint32_t lights_drawn = 0;
    std::uint32_t lights_outside = 0;
    std::uint32_t lights_below_threshold = 0;
    std::uint32_t draw_calls = 0;
    std::uint32_t kernel_launches = 0;  // to add lights up
    std::uint32_t lights_gathered = 0;  // in OpenCL, all but their cores
    std::uint32_t lights_late = 0;      // cores alone, see AccumulationPlan::most_unknown_px
    DeviceMemory memory;                // of the view
    PassTimes cpu;
    GpuTimes gpu;  // of an earlier frame
};

enum class RenderResult { drawn, nothing_to_draw };

class ViewRenderer {
  public:
    // Needs the GL context current. Throws GlError when a shader does not compile. `timed`: passes are timed on the GPU and
    // are groups in GL debuggers.
    explicit ViewRenderer(const Gl& gl, bool timed = true);
    ~ViewRenderer();  // deletes the GL objects: the context must be current, or abandon() called first
    ViewRenderer(const ViewRenderer&) = delete;
    ViewRenderer& operator=(const ViewRenderer&) = delete;

    // The context is gone: forget every GL object without a GL call.
    void abandon();

    // Of `sources`, those whose glare can reach a pixel of the frame and change a display code: compacts the list in
    // place, counts the rest in `stats`. No GL call. Pure, so that a frame with nothing visible costs nothing.
    // `angular_scale` is the pattern's: a magnified one reaches further. Throws as screen_geometry does.
    static std::size_t cull(const Frame& frame, const ToneSettings& tone, std::span<PointSource> sources,
                            RenderStats& stats, double angular_scale = 1);

    // Compiles what Accumulation::cl_tiles needs: once, before the first frame that is planned so, for it takes half a
    // second. False where there is no OpenCL device; plans that ask for it are then carried out with billboards.
    // Where GL and OpenCL can share memory, what is gathered is drawn from without a copy through the CPU.
    bool enable_gather();
    bool can_gather() const;
    // Whether what is gathered stays on the device (gl_sharing.h), or why not.
    const SharingDecision& sharing() const;

    // Of the pattern that the next render() is given, what its maker has prepared; it is read until this is called again, by
    // read_hdr(), too. Null, or of another pattern: what is needed is made when it is, by who renders.
    void set_prepared(const PreparedPattern* prepared);
    // What is needed of patterns to render as planned, for their maker to prepare.
    PatternUse use_of_patterns(const AccumulationPlan& plan) const;
    // What this gathers in; null: it cannot.
    std::shared_ptr<ClShared> gather_context() const;

    // Adds the glare of `sources` (already culled) to the target. GL state is the caller's to save (gl_state_guard).
    // Throws GlError naming the object when the target is not a complete framebuffer or a depth source cannot be used;
    // nothing has been drawn to the target then. Throws std::invalid_argument as screen_geometry does.
    // glare/device/gl_touched_state.h lists the state that this, read_hdr and the constructor change.
    RenderResult render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                        std::span<const PointSource> sources, const AccumulationPlan& plan,
                        RenderStats& stats);
    // The same with tone.threshold_codes for each light, whatever the others leave out.
    RenderResult render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                        std::span<const PointSource> sources, RenderStats& stats);

    // Reads the HDR buffer of the last render: width*height*4 floats. Waits for the GPU. Throws std::invalid_argument
    // when `rgba` is smaller.
    void read_hdr(std::span<float> rgba) const;
    int hdr_width() const;
    int hdr_height() const;
    // Zero after a frame in which nothing was drawn.
    void mark_nothing_drawn(const Frame& frame);
    // Of frames that are nobody's (cost_probe.h) no GPU times are asked for.
    void set_timed(bool timed);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seaglare::glare
