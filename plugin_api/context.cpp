#include "plugin_api/context.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "glare/apply/least_light.h"
#include "glare/plan/plan.h"
#include "lightdb/character.h"
#include "lightdb/daylight.h"
#include "lightdb/photometry.h"
#include "lightdb/vector_math.h"
#include "plugin_api/failure.h"
#include "plugin_api/fp_environment.h"
#include "plugin_api/validate.h"

namespace seaglare::plugin {

namespace {

constexpr double default_radius_m = 0.05;
constexpr double default_frame_interval_s = 1.0 / 60;

}  // namespace

Context::Context(const seaglare_create_info& info)
    : world_(info),
      seed_(info.seed),
      use_opencl_((info.flags & SEAGLARE_CREATE_NO_OPENCL) == 0),
      log_(info.log),
      log_user_(info.log_user),
      settings_(info.config_path == nullptr ? default_settings() : load_settings(info.config_path)),
      plan_settings_(plan_settings(settings_)),
      patterns_(make_patterns(settings_)) {
    last_adaptation_cd_m2_ = settings_.adaptation.luminance_cd_m2(settings_.default_time_of_day_h);
}

std::shared_ptr<PatternStore> Context::make_patterns(const Settings& settings) const {
    return std::make_shared<PatternStore>(settings.eye, settings.pattern, seed_, use_opencl_);
}

void Context::load_config(const std::string& path) {
    Settings settings = load_settings(path);
    std::shared_ptr<const PlanSettings> for_plans = plan_settings(settings);
    std::shared_ptr<PatternStore> patterns = make_patterns(settings);  // compiles kernels: not under the lock
    {
        std::shared_ptr<const glare::LampList> lamps;
        std::shared_ptr<PatternStore> before;
        {
            const std::lock_guard lock(mutex_);
            before = patterns_;
            lamps = lights_.lamps().list();
        }
        patterns->warm_up_like(*before, lamps);
    }
    {
        const std::lock_guard lock(mutex_);
        settings_ = std::move(settings);
        plan_settings_ = std::move(for_plans);
        patterns_.swap(patterns);
    }
    // A frame in progress on another thread keeps the old one until its end. It should not have to end it: that takes as long
    // as the pattern that is being made. But a host that holds such a frame until this call returns is not waited for.
    constexpr int most_tries = 200;
    constexpr std::chrono::milliseconds pause(1);
    for (int i = 0; i < most_tries && patterns.use_count() > 1; ++i)
        std::this_thread::sleep_for(pause);
}

// After loading, so that no frame has to sample the spectra of new lamps.
void Context::announce_lamps() const {
    std::shared_ptr<PatternStore> store;
    std::shared_ptr<const glare::LampList> lamps;
    {
        const std::lock_guard lock(mutex_);
        store = patterns_;
        lamps = lights_.lamps().list();
    }
    if (!lamps) return;
    try {
        store->prepare(*lamps);
    } catch (...) {
        return;  // the lights are loaded; the first frame that needs the pattern tries again, and says what is wrong
    }
}

lightdb::Light Context::make_light(const seaglare_light& given) {
    lightdb::Light light;
    light.name = given.name == nullptr ? "" : given.name;
    light.body_id = given.body_id;
    light.position_m = given.body_id == 0 ? world_.scene_from_host(given.position_m)
                                          : world_.body_from_host_body(given.position_m);
    light.height_m = light.position_m[2] + (given.body_id == 0 ? world_.origin_height_m() : 0);
    light.radius_m = given.radius_m > 0 ? given.radius_m : default_radius_m;
    const double intensity_cd =
        given.intensity_cd > 0 ? given.intensity_cd : lightdb::intensity_for_range_cd(given.nominal_range_nm);
    std::vector<lightdb::Colour> colours = {static_cast<lightdb::Colour>(given.colour)};
    if (given.character != nullptr && given.character[0] != '\0') {
        try {
            const lightdb::Character character = lightdb::parse_character(given.character);
            light.character = given.character;
            light.rhythm = character.rhythm;
            // The struct has one colour. A character that names several alternates between them.
            if (character.colours.size() > 1) {
                colours = character.colours;
            } else {
                for (lightdb::Phase& phase : light.rhythm.phases)
                    phase.colour = colours.front();
            }
        } catch (const lightdb::CharacterError& error) {
            invalid_argument("light.character \"" + std::string(given.character) + "\", at character " +
                             std::to_string(error.offset + 1) + ": " + error.what());
        }
    }
    for (const lightdb::Colour colour : colours)
        light.intensity_cd[static_cast<std::size_t>(colour)] = intensity_cd;
    if (given.spectrum != nullptr && given.spectrum[0] != '\0') {
        NamedLamps::Colours shown{};
        for (const lightdb::Colour colour : colours)
            shown[static_cast<std::size_t>(colour)] = true;
        light.spectrum = named_lamps_.find(given.spectrum, shown);
    }
    return light;
}

seaglare_light_id Context::add_light(const seaglare_light& given) {
    lightdb::Light light = make_light(given);
    const bool named = static_cast<bool>(light.spectrum);
    seaglare_light_id id = 0;
    {
        const std::lock_guard lock(mutex_);
        id = lights_.add(std::move(light));
    }
    if (named) announce_lamps();
    return id;
}

void Context::update_lights(const seaglare_light_update* updates, std::uint32_t count, std::uint32_t stride) {
    if (count == 0) return;
    if (updates == nullptr) invalid_argument("updates is NULL");
    const auto* bytes = reinterpret_cast<const unsigned char*>(updates);
    std::uint32_t first_size = 0;
    std::memcpy(&first_size, bytes, sizeof first_size);
    const std::size_t step = stride == 0 ? first_size : stride;
    const auto entry = [&](std::uint32_t i) {
        const auto* at = reinterpret_cast<const seaglare_light_update*>(bytes + i * step);
        seaglare_light_update update = copy_struct(at, "update");
        if (update.struct_size > step && count > 1)
            invalid_argument("stride is " + std::to_string(step) + ", less than update.struct_size");
        return update;
    };

    const std::lock_guard lock(mutex_);
    for (std::uint32_t i = 0; i < count; ++i) {
        const seaglare_light_update update = entry(i);
        check(update, i);
        if (!lights_.contains(update.id)) {
            throw Failure(SEAGLARE_ERROR_STALE_ID,
                          "updates[" + std::to_string(i) + "].id names no light, or one that was removed");
        }
    }
    // Nothing below can fail but for want of memory.
    for (std::uint32_t i = 0; i < count; ++i) {
        const seaglare_light_update update = entry(i);
        const bool on_body = lights_.is_on_body(update.id);
        if ((update.set & SEAGLARE_SET_POSITION) != 0) {
            const Vec3 position_m = on_body ? world_.body_from_host_body(update.position_m)
                                            : world_.scene_from_host(update.position_m);
            lights_.set_position(update.id, position_m);
            lights_.set_height(update.id, position_m[2] + (on_body ? 0 : world_.origin_height_m()));
        }
        if ((update.set & SEAGLARE_SET_ORIENTATION) != 0) {
            lights_.set_orientation(update.id, on_body ? world_.body_from_light(update.orientation)
                                                       : world_.scene_from_body(update.orientation));
        }
        if ((update.set & SEAGLARE_SET_INTENSITY) != 0) lights_.set_intensity(update.id, update.intensity_cd);
        if ((update.set & SEAGLARE_SET_VISIBILITY) != 0) lights_.set_visibility(update.id, update.visibility);
        if ((update.set & SEAGLARE_SET_ON) != 0) lights_.set_on(update.id, update.on != 0);
    }
}

void Context::remove_light(seaglare_light_id id) {
    const std::lock_guard lock(mutex_);
    if (!lights_.remove(id))
        throw Failure(SEAGLARE_ERROR_STALE_ID, "id names no light, or one that was removed");
}

void Context::set_body_pose(std::uint32_t body_id, const double position_m[3], const double orientation[4]) {
    if (body_id == 0) invalid_argument("body_id is 0, which stands for the world");
    if (position_m == nullptr) invalid_argument("position_m is NULL");
    if (orientation == nullptr) invalid_argument("orientation is NULL");
    for (int i = 0; i < 3; ++i)
        check_range(position_m[i], -1e8, 1e8, Field("position_m", i));
    check_quaternion(orientation, "orientation");
    const lightdb::BodyPose pose{world_.scene_from_host(position_m), world_.scene_from_body(orientation)};
    const std::lock_guard lock(mutex_);
    buoys_.remove(body_id);  // the host's word counts
    lights_.set_body_pose(body_id, pose);
}

std::uint32_t Context::list_lights(seaglare_light_id* ids, std::uint32_t capacity) const {
    const std::lock_guard lock(mutex_);
    const std::vector<lightdb::LightId> all = lights_.ids();
    if (ids != nullptr) std::copy_n(all.begin(), std::min<std::size_t>(capacity, all.size()), ids);
    return static_cast<std::uint32_t>(all.size());
}

seaglare_eye_state Context::eye_state() const {
    const std::lock_guard lock(mutex_);
    seaglare_eye_state state{};
    state.struct_size = sizeof state;
    state.adaptation_luminance_cd_m2 = last_adaptation_cd_m2_;
    state.time_s = eye_state_.time_s.value_or(0);
    if (eye_state_.vitreous) {
        const glare::VitreousState& vitreous = *eye_state_.vitreous;
        state.flags |= SEAGLARE_EYE_HAS_VITREOUS;
        std::copy(vitreous.orientation.begin(), vitreous.orientation.end(), state.vitreous_orientation);
        std::copy(vitreous.spin_rad_s.begin(), vitreous.spin_rad_s.end(), state.vitreous_spin_rad_s);
        std::copy(vitreous.head_rad_s.begin(), vitreous.head_rad_s.end(), state.head_rate_rad_s);
    }
    if (eye_state_.adapted_cd_m2) {
        state.flags |= SEAGLARE_EYE_HAS_ADAPTED;
        state.adapted_luminance_cd_m2 = *eye_state_.adapted_cd_m2;
    }
    if (is_day_) state.flags |= SEAGLARE_EYE_HAS_DAY;
    state.is_day = is_day_.value_or(false) ? 1 : 0;
    return state;
}

void Context::set_eye_state(const seaglare_eye_state& state) {
    const std::lock_guard lock(mutex_);
    given_adaptation_cd_m2_ = state.adaptation_luminance_cd_m2;
    last_adaptation_cd_m2_ = state.adaptation_luminance_cd_m2;
    eye_state_.time_s = state.time_s;
    if ((state.flags & SEAGLARE_EYE_HAS_ADAPTED) != 0)
        eye_state_.adapted_cd_m2 = state.adapted_luminance_cd_m2;
    if ((state.flags & SEAGLARE_EYE_HAS_VITREOUS) != 0) {
        glare::VitreousState& vitreous = eye_state_.vitreous.emplace();
        std::copy_n(state.vitreous_orientation, 4, vitreous.orientation.begin());
        std::copy_n(state.vitreous_spin_rad_s, 3, vitreous.spin_rad_s.begin());
        std::copy_n(state.head_rate_rad_s, 3, vitreous.head_rad_s.begin());
    }
    if ((state.flags & SEAGLARE_EYE_HAS_DAY) != 0) is_day_ = state.is_day != 0;
}

// The frame's own word first, then the time of day it gives, then set_eye_state, then the configuration's default.
double Context::adaptation_luminance(const seaglare_frame& frame) const {
    if ((frame.flags & SEAGLARE_FRAME_HAS_ADAPTATION) != 0) return frame.adaptation_luminance_cd_m2;
    if ((frame.flags & SEAGLARE_FRAME_HAS_TIME_OF_DAY) != 0)
        return settings_.adaptation.luminance_cd_m2(frame.local_time_of_day_h);
    if (given_adaptation_cd_m2_) return *given_adaptation_cd_m2_;
    return settings_.adaptation.luminance_cd_m2(settings_.default_time_of_day_h);
}

FrameState Context::evaluate(const seaglare_frame& frame, const glare::Frame& picture, double error_given_up,
                             lightdb::Evaluated& out) {
    lightdb::Observer observer;
    observer.view_from_scene = world_.view_from_scene(frame.view_from_world);
    observer.eye_m = eye_of_view(observer.view_from_scene);
    observer.time_s = frame.time_s;
    observer.exposure_s = frame.frame_interval_s > 0 ? frame.frame_interval_s : default_frame_interval_s;
    if ((frame.flags & SEAGLARE_FRAME_HAS_FOG) != 0)
        observer.extinction_per_m = lightdb::extinction_per_m(frame.meteorological_visibility_m);
    observer.water_level_m = -world_.origin_height_m();
    observer.round_earth = world_.round_earth();
    observer.seed = seed_;

    const std::lock_guard lock(mutex_);
    FrameState state;
    state.tone = settings_.tone;
    state.occlusion = settings_.occlusion;
    state.tone.threshold_codes =
        glare::light_threshold_codes(settings_.budget, error_given_up, frame.visibility != nullptr ? 2 : 1);
    state.plan = plan_settings_;
    state.patterns = patterns_;
    state.angular_scale = settings_.pattern.angular_scale;
    state.lamps = lights_.lamps().list();
    state.spectra_without_pattern = lights_.lamps().without_slot();
    const double surroundings_cd_m2 = adaptation_luminance(frame);
    glare::EyeSurroundings surroundings;
    surroundings.luminance_cd_m2 = surroundings_cd_m2;
    surroundings.time_s = frame.time_s;
    if ((frame.flags & SEAGLARE_FRAME_HAS_HEAD_RATE) != 0)
        std::copy_n(frame.head_rate_rad_s, 3, surroundings.head_rad_s.begin());
    eye_state_ = glare::advanced(eye_state_, settings_.eye, surroundings);
    state.adaptation_luminance_cd_m2 = *eye_state_.adapted_cd_m2;
    state.resting_pupil_mm =
        glare::resting_pupil_diameter_mm(settings_.eye, state.adaptation_luminance_cd_m2);
    state.pupil_mm =
        glare::pupil_diameter_mm(settings_.eye, state.adaptation_luminance_cd_m2, frame.time_s, seed_);
    state.lids =
        glare::lid_pose(settings_.eye.lids.motion, state.adaptation_luminance_cd_m2, frame.time_s, seed_);
    state.vitreous_roll_rad = glare::roll_about_sight_rad(*eye_state_.vitreous);
    is_day_ = lightdb::is_day(surroundings_cd_m2, is_day_);
    observer.is_day = *is_day_;
    glare::Frame adapted = picture;
    adapted.adaptation_luminance_cd_m2 = state.adaptation_luminance_cd_m2;
    observer.least_illuminance_lx = glare::least_illuminance_lx(adapted, state.tone, state.angular_scale,
                                                                lights_.lamps().strongest_channel_per_lux());
    observer.most_left_out_lx = glare::least_lights_to_threshold / 4 * observer.least_illuminance_lx;
    observer.geographic_horizon = settings_.geographic_horizon;
    buoys_.pose(frame.time_s, lights_);
    lights_.settle();
    lightdb::evaluate(lights_, observer, out);
    last_adaptation_cd_m2_ = surroundings_cd_m2;
    return state;
}

void Context::visibility_queries(const std::vector<lightdb::LightIndex>& lights,
                                 std::vector<seaglare_visibility_query>& out) const {
    out.clear();
    const std::lock_guard lock(mutex_);
    for (const lightdb::LightIndex index : lights) {
        seaglare_visibility_query query{};
        query.visibility = 1;
        query.id = lights_.id_of(index);
        if (query.id != 0) {
            const Vec3 position = world_.host_from_scene(lightdb::scene_position_m(lights_, index));
            std::copy(position.begin(), position.end(), query.position_m);
        }
        out.push_back(query);
    }
}

std::shared_ptr<PatternStore> Context::patterns() const {
    const std::lock_guard lock(mutex_);
    return patterns_;
}

std::string Context::degraded_reason() const {
    return patterns()->facts()->reason;
}

std::shared_ptr<const PlanSettings> Context::settings_of_plans() const {
    const std::lock_guard lock(mutex_);
    return plan_settings_;
}

glare::EyeMoment Context::eye_at_rest(double pitch) const {
    const std::lock_guard lock(mutex_);
    glare::EyeMoment moment;
    moment.lamps = lights_.lamps().list();
    moment.adaptation_cd_m2 = eye_state_.adapted_cd_m2.value_or(last_adaptation_cd_m2_);
    moment.request.pitch = pitch;
    moment.request.time_s = eye_state_.time_s.value_or(0);
    moment.request = glare::request_at(settings_.eye, seed_, moment, moment.request.time_s);
    return moment;
}

void Context::log(std::int32_t level, const std::string& message) const {
    if (log_ == nullptr) return;
    const HostFpEnvironment host;
    log_(log_user_, level, message.c_str());
}

void Context::report(std::int32_t level, std::string_view text) noexcept {
    try {
        last_error_.set(text);
        {
            const std::lock_guard lock(log_mutex_);
            if (last_logged_ == text) return;
            last_logged_ = text;
        }
        log(level, std::string(text));
    } catch (...) {
        // Out of memory for the text itself: the result code still says what happened.
        return;
    }
}

}  // namespace seaglare::plugin
