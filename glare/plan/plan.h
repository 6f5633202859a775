// The least work that keeps a frame's error under its budget: which passes, what is left out, why, and what each omission can
// change at most. make_plan is a pure function: the same lights, settings and costs give the same plan on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "glare/apply/screen_geometry.h"
#include "glare/plan/accumulation.h"
#include "glare/plan/budget.h"
#include "glare/plan/device_costs.h"
#include "glare/plan/light_summary.h"
#include "glare/plan/quality.h"
#include "glare/psf/pattern.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

// Lights that are left out before the plan is made, by reason (stats extension).
struct LightsLeftOut {
    std::uint32_t dark = 0;       // off, eclipsed, out of sector or profile
    std::uint32_t horizon = 0;    // below the geographical horizon
    std::uint32_t outside = 0;    // behind the eye, or their glare does not reach into the picture
    std::uint32_t too_far = 0;    // not evaluated: too faint at their brightest
    std::uint32_t too_faint = 0;  // evaluated, and below the threshold
    std::uint32_t hidden = 0;     // the host's visibility callback says 0
};

struct PlanInput {
    ScreenGeometry geometry;
    ToneSettings tone;
    double adaptation_cd_m2 = 0.001;
    std::uint32_t lights_total = 0;  // of the database
    LightsLeftOut left_out;
    const LightSummary* lights = nullptr;  // those that are left
    // The pattern: its settings, the eye whose tail it has, and what is there already.
    const PatternSettings* pattern = nullptr;
    double window_outer = 0;  // direction cosine where its skirt ends
    double window_inner = 0;
    int radius_nodes = 0;
    bool has_tail = true;
    double tail_age_years = 24;
    double tail_pigmentation = 0.5;
    bool eye_focused = true;          // false: its aperture has phases, and the transform both its halves
    bool pattern_usable = false;      // one is there that has the lamps and the layers for these lights
    bool same_instant = false;        // and the eye has not moved at all since
    double pattern_motion_codes = 0;  // what keeping it changes at most, in codes
    std::uint32_t spectra_without_pattern = 0;  // of the database, beyond those that can have a pattern
    bool has_depth = false;
    bool asks_visibility = false;
    bool has_opencl = false;
    bool can_gather = false;  // the renderer has cl_tiles
    Accumulation last_method =
        Accumulation::gl_billboards;  // of the frame before: only a clear gain changes it
    QualityLoss given_up;             // for want of time: quality_control.h
    double frame_interval_s = 1.0 / 60;
};

// What is done with the pattern.
enum class PatternAction : std::uint8_t {
    none,   // no light is drawn
    reuse,  // the one there is good enough
    make,
};

enum class PassKind : std::uint8_t {
    evaluate,
    visibility,
    pattern,
    upload,
    occlusion,
    accumulate,
    composite
};
inline constexpr std::size_t pass_kinds = 7;
struct PlannedPass {
    PassKind kind = PassKind::evaluate;
    std::string_view reason;  // a literal
    double predicted_ms = 0;
};

enum class Omitted : std::uint8_t {
    frame,
    dark_lights,
    lights_below_horizon,
    lights_outside,
    lights_too_far,
    lights_too_faint,
    hidden_lights,
    new_pattern,
    complex_half,
    disc_layers,  // those that no light in view needs
    discs,        // of lights so small that the point's pattern serves
    rod_hue,
    own_patterns,  // lamps that are drawn with another's pattern
    spectra,       // named spectra beyond those that can have a pattern
    skirts,        // outskirts, left to the smooth tail
    tails,         // where they end
    fine_tails,    // the tails' full resolution
    depth_test,
    visibility_callback,
    quality,  // what a time budget gives up: own patterns, discs and motion in part
};
inline constexpr std::size_t omission_kinds = 20;
struct Omission {
    Omitted what = Omitted::frame;
    std::string_view reason;  // a literal
    double count = 0;
    double bound_codes = 0;
};

// A list of fixed room: a plan is made in every frame and allocates nothing.
template <class T, std::size_t Room>
class FewOf {
  public:
    void push_back(const T& value) { values_[count_++] = value; }
    std::span<const T> all() const { return std::span(values_).first(count_); }
    void clear() { count_ = 0; }

  private:
    std::array<T, Room> values_{};
    std::size_t count_ = 0;
};

struct Plan {
    bool draw = false;  // false: no GL call is made
    AccumulationPlan accumulation;
    PatternAction pattern = PatternAction::none;
    std::uint32_t lamps_with_pattern = 1;  // bit l: lamp l is asked for; others are drawn with one of these
    double filter_blend = 0;               // 0 ... 1: every lamp's own pattern ... the white one, tinted
    double largest_disc_nodes = 0;         // that the pattern has layers for
    double pattern_step_s = 0;             // it is that of the last instant of so many: quality.h
    bool rod_hue = true;
    double max_error_codes = 0;    // the budget that this plan keeps
    double error_bound_codes = 0;  // the sum over the omissions
    double predicted_ms = 0;       // the sum over the passes
    // Of the uploads: of the lights, and of the pattern in a frame to which a new one comes.
    double upload_lights_ms = 0;
    double pattern_taken_ms = 0;
    QualityLoss given_up;
    FewOf<PlannedPass, pass_kinds> passes;
    FewOf<Omission, 28> left_out;
};

Plan make_plan(const PlanInput& input, const Budget& budget, const DeviceCosts& costs);

// The error that is allowed once so much of Quality::error is given up: max_error_codes at 0, most_error_codes at 1.
double error_allowed_codes(const Budget& budget, double given_up);

// Within which whole lights are left out: ToneSettings::threshold_codes of evaluation and of each culling, which are so many.
// They need it before there is a plan.
double light_threshold_codes(const Budget& budget, double given_up, int cullings);

std::string_view name_of(PassKind kind);
std::string_view name_of(Omitted what);
std::string_view name_of(Accumulation method);
std::string_view name_of(PatternAction action);

}  // namespace seaglare::glare
