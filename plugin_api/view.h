// What belongs to one GL context: its entry points, its renderer, the last frame's statistics.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glare/apply/view_renderer.h"
#include "glare/plan/filter_blend.h"
#include "lightdb/evaluate.h"
#include "plugin_api/context.h"
#include "plugin_api/frame_planner.h"
#include "plugin_api/gl_state_guard.h"
#include "plugin_api/host_visibility.h"
#include "plugin_api/plan_text.h"
#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

class View {
  public:
    // Needs the GL context current. Throws glare::GlError, glare::GlTooOld.
    View(seaglare_context& owner, const seaglare_view_info& info);
    // Deletes the GL objects: the context must be current, unless it was declared lost.
    ~View();
    View(const View&) = delete;
    View& operator=(const View&) = delete;

    // For one thread at a time: holds the view, or throws Failure BUSY when another thread does.
    class Hold {
      public:
        explicit Hold(View& view);
        ~Hold() { view_.busy_.clear(); }
        Hold(const Hold&) = delete;
        Hold& operator=(const Hold&) = delete;

      private:
        View& view_;
    };

    // The rest needs a Hold.
    seaglare_result render(const seaglare_frame* frame);
    seaglare_stats stats() const { return stats_; }
    seaglare_memory memory() const;
    std::string plan() const;
    const std::string& degraded_reason() const { return facts_.degraded_reason; }  // of the last frame
    void read_hdr(float* rgba, std::uint64_t capacity_floats, std::int32_t out_size_px[2]);
    void declare_context_lost();
    Context& context() { return context_; }

  private:
    void warm_up_drawing(const glare::EyeMoment& moment);
    void forget_shared_context() noexcept;
    void check_context_alive();
    void ask_visibility(const seaglare_frame& frame, double smoothing_s, std::size_t visible);
    seaglare_result draw(const glare::Frame& frame, const FrameState& state, double pitch, double interval_s,
                         bool wait);

    Context& context_;
    std::string channel_name_;
    GuardMode guard_mode_;
    glare::Gl gl_;
    GlStateCaps caps_;
    bool knows_reset_status_ = false;
    bool lost_ = false;
    std::unique_ptr<glare::ViewRenderer> renderer_;
    std::atomic_flag busy_ = ATOMIC_FLAG_INIT;

    lightdb::Evaluated evaluated_;  // capacity kept between frames
    std::vector<lightdb::LightIndex> asked_;
    std::vector<seaglare_visibility_query> queries_;
    std::vector<float> answers_;
    HostVisibility host_visibility_;
    std::vector<glare::PointSource> visible_;
    seaglare_stats stats_{};
    bool as_planned_ = true;  // the last frame added all lights up as its plan says
    PlanFacts facts_;
    glare::DeviceMemory memory_;  // after the last frame that drew
    FramePlanner planner_;
    PreparedLease prepared_;       // of the last frame's pattern: its glare may yet be read
    glare::BlendedPattern faded_;  // while lamps' own patterns are given up for want of time
};

}  // namespace seaglare::plugin

// The handle of the C interface.
struct seaglare_view {
    seaglare_view(seaglare_context& owner, const seaglare_view_info& info) : view(owner, info) {}
    seaglare::plugin::View view;
};
