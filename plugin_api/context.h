// What every channel shares: lights, eye, pattern, the world's convention. Every member may be called from any thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "glare/eye/eye_state.h"
#include "lightdb/buoy.h"
#include "lightdb/evaluate.h"
#include "lightdb/light_file.h"
#include "lightdb/light_reload.h"
#include "lightdb/light_store.h"
#include "plugin_api/frame_mutex.h"
#include "plugin_api/last_error.h"
#include "plugin_api/named_lamps.h"
#include "plugin_api/pattern_store.h"
#include "plugin_api/seaglare.h"
#include "plugin_api/settings.h"
#include "plugin_api/world.h"

namespace seaglare::plugin {

// What one frame takes from the context, in one consistent moment.
struct FrameState {
    glare::ToneSettings tone;  // threshold_codes: within which whole lights may be left out
    std::shared_ptr<const PlanSettings> plan;
    std::shared_ptr<PatternStore> patterns;
    double angular_scale = 1;                      // of the pattern
    std::shared_ptr<const glare::LampList> lamps;  // null: the navigation colours alone
    std::uint32_t spectra_without_pattern = 0;     // more than the list has room for
    double adaptation_luminance_cd_m2 = 0;         // as far as the eye has come
    double pupil_mm = 0;
    double resting_pupil_mm = 0;  // what hippus swings about
    glare::LidPose lids;
    double vitreous_roll_rad = 0;
    glare::OcclusionSettings occlusion;
};

class Context {
  public:
    explicit Context(const seaglare_create_info& info);

    void load_config(const std::string& path);
    // Light files: context_lights.cpp.
    void load_lights(const std::string& path);
    seaglare_reload_counts reload_lights(const std::string& path);
    void save_lights(const std::string& path) const;
    void clear_lights();
    seaglare_light_id add_light(const seaglare_light& light);
    void update_lights(const seaglare_light_update* updates, std::uint32_t count, std::uint32_t stride);
    void remove_light(seaglare_light_id id);
    void set_body_pose(std::uint32_t body_id, const double position_m[3], const double orientation[4]);
    std::uint32_t list_lights(seaglare_light_id* ids, std::uint32_t capacity) const;

    // Things that float: context_bodies.cpp.
    std::vector<lightdb::LightId> add_lights(std::vector<lightdb::Light> lights);  // all or none
    void remove_lights(const seaglare_light_id* ids, std::uint32_t count);         // all or none
    void set_waves(std::vector<lightdb::WaveComponent> waves);
    void set_buoy(const lightdb::Buoy& buoy);
    void remove_buoy(std::uint32_t body_id);
    lightdb::BodyPose buoy_pose(std::uint32_t body_id, double time_s) const;
    const World& world() const { return world_; }

    seaglare_eye_state eye_state() const;
    void set_eye_state(const seaglare_eye_state& state);

    // Evaluates every light for this frame into `out` and, where the frame has a visibility callback, their ids and
    // world positions stay known through visibility_queries().
    // `picture` is the same frame as the renderer takes it; `error_given_up` what a time budget gives up (glare/plan).
    FrameState evaluate(const seaglare_frame& frame, const glare::Frame& picture, double error_given_up,
                        lightdb::Evaluated& out);
    // Id and world position of evaluated lights, visibility 1. A light removed since is reported with id 0.
    void visibility_queries(const std::vector<lightdb::LightIndex>& lights,
                            std::vector<seaglare_visibility_query>& out) const;

    void add_view() { views_.fetch_add(1); }
    void remove_view() { views_.fetch_sub(1); }
    bool has_views() const { return views_.load() != 0; }

    std::shared_ptr<PatternStore> patterns() const;
    std::shared_ptr<const PlanSettings> settings_of_plans() const;
    // The eye before the first frame: at the adaptation that it has been given, nothing in view.
    glare::EyeMoment eye_at_rest(double pitch) const;
    // Empty, or why this context works with less than it was asked for.
    std::string degraded_reason() const;

    LastError& last_error() { return last_error_; }
    // Keeps the text for copy_last_error and logs it, unless it is the text logged last: an error that repeats in
    // every frame is told once. Call without a lock held: the host's function runs.
    void report(std::int32_t level, std::string_view text) noexcept;
    void log(std::int32_t level, const std::string& message) const;

  private:
    // What is remembered of a file, to know its lights and buoys again when it is read anew.
    struct LoadedFile {
        std::vector<lightdb::LoadedLight> lights;
        std::vector<lightdb::Buoy> buoys;
    };

    lightdb::Light make_light(const seaglare_light& light);
    lightdb::LightFile lights_to_save() const;
    void take_in(lightdb::LightBatch& batch);
    double adaptation_luminance(const seaglare_frame& frame) const;
    std::shared_ptr<PatternStore> make_patterns(const Settings& settings) const;
    void announce_lamps() const;

    const World world_;
    const std::uint64_t seed_;
    const bool use_opencl_;
    const seaglare_log_fn log_;
    void* const log_user_;

    mutable std::mutex files_mutex_;  // held while light files are read and written; taken before mutex_
    std::map<std::string, LoadedFile> files_;  // by file_identity()

    mutable FrameMutex mutex_;  // of the members up to the next blank line
    lightdb::LightStore lights_;
    lightdb::BuoyField buoys_;
    Settings settings_;
    std::shared_ptr<const PlanSettings> plan_settings_;  // of settings_
    std::shared_ptr<PatternStore> patterns_;
    std::optional<double> given_adaptation_cd_m2_;  // by set_eye_state
    std::optional<bool> is_day_;  // for photometers; nothing: no frame yet, and set_eye_state has not said
    double last_adaptation_cd_m2_ = 0;
    glare::EyeState eye_state_;

    NamedLamps named_lamps_;  // has its own lock
    std::atomic<std::uint32_t> views_{0};
    LastError last_error_;
    std::mutex log_mutex_;
    std::string last_logged_;
};

}  // namespace seaglare::plugin

// The handle of the C interface.
struct seaglare_context {
    explicit seaglare_context(const seaglare_create_info& info) : context(info) {}
    seaglare::plugin::Context context;
};
