// "seaglare.waves/1": the host's sea, and what swings on it.
#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lightdb/buoy.h"
#include "plugin_api/border.h"
#include "plugin_api/validate.h"
#include "plugin_api/vessels.h"

namespace seaglare::plugin {

namespace {

constexpr std::uint32_t most_waves = 4096;
constexpr double farthest_m = 1e8;

Context& required(seaglare_context* context) {
    if (context == nullptr) invalid_argument("context is NULL");
    return context->context;
}

Context* inside(seaglare_context* context) {
    return context == nullptr ? nullptr : &context->context;
}

// "waves[3]: wavelength_m is …": check_range() names the field, this the entry.
lightdb::WaveComponent wave_from(const seaglare_wave& wave) {
    check_flags(wave.flags, 0, "flags");
    check_range(wave.amplitude_m, 0, 50, "amplitude_m");
    check_range(wave.direction_deg, -360, 360, "direction_deg");
    check_range(wave.wavelength_m, 0, 1e5, "wavelength_m");
    check_range(wave.angular_frequency_rad_s, 0, 100, "angular_frequency_rad_s");
    check_range(wave.phase_rad, -1e6, 1e6, "phase_rad");
    check_range(wave.depth_m, 0, 2e4, "depth_m");
    if ((wave.wavelength_m > 0) == (wave.angular_frequency_rad_s > 0))
        invalid_argument("give either wavelength_m or angular_frequency_rad_s; the other follows");
    const double depth_m = wave.depth_m > 0 ? wave.depth_m : std::numeric_limits<double>::infinity();
    if (wave.wavelength_m > 0) {
        check_range(wave.wavelength_m, 0.01, 1e5, "wavelength_m");
        return lightdb::wave_of_length(wave.amplitude_m, wave.direction_deg, wave.wavelength_m,
                                       wave.phase_rad, depth_m);
    }
    check_range(wave.angular_frequency_rad_s, 0.01, 100, "angular_frequency_rad_s");
    return lightdb::wave_of_frequency(wave.amplitude_m, wave.direction_deg, wave.angular_frequency_rad_s,
                                      wave.phase_rad, depth_m);
}

std::vector<lightdb::WaveComponent> waves_from(const seaglare_wave* waves, std::uint32_t count,
                                               std::uint32_t stride) {
    if (count > most_waves)
        invalid_argument("count is " + std::to_string(count) + ": at most " + std::to_string(most_waves));
    if (count > 0 && waves == nullptr) invalid_argument("waves is NULL");
    std::vector<lightdb::WaveComponent> result;
    result.reserve(count);
    const auto* bytes = reinterpret_cast<const unsigned char*>(waves);
    std::size_t step = stride;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string entry = "waves[" + std::to_string(i) + "]";
        const seaglare_wave wave =
            copy_struct(reinterpret_cast<const seaglare_wave*>(bytes + i * step), entry.c_str());
        if (step == 0) step = wave.struct_size;
        if (wave.struct_size > step && count > 1)
            invalid_argument("stride is " + std::to_string(step) + ", less than " + entry + ".struct_size");
        try {
            result.push_back(wave_from(wave));
        } catch (const Failure& failure) {
            throw Failure(failure.code(), entry + ": " + failure.what());
        }
    }
    return result;
}

// 0, for the default, or within the limits.
void check_optional(double value, double low, double high, const char* name) {
    check_finite(value, name);
    if (value != 0) check_range(value, low, high, name);
}

lightdb::Buoy buoy_from(const seaglare_buoy& given, const World& world) {
    check_flags(given.flags, 0, "buoy.flags");
    if (given.body_id == 0) invalid_argument("buoy.body_id is 0, which stands for the world");
    if (given.reserved != 0) invalid_argument("buoy.reserved is not 0");
    for (int i = 0; i < 3; ++i)
        check_range(given.position_m[i], -farthest_m, farthest_m, Field("buoy.position_m", i));
    using namespace lightdb;
    check_optional(given.focal_height_m, lowest_focal_height_m, highest_focal_height_m,
                   "buoy.focal_height_m");
    check_optional(given.heave_period_s, shortest_buoy_period_s, longest_buoy_period_s,
                   "buoy.heave_period_s");
    check_optional(given.heave_damping, least_buoy_damping, most_buoy_damping, "buoy.heave_damping");
    check_optional(given.roll_period_s, shortest_buoy_period_s, longest_buoy_period_s, "buoy.roll_period_s");
    check_optional(given.roll_damping, least_buoy_damping, most_buoy_damping, "buoy.roll_damping");
    check_optional(given.max_tilt_deg, 0, steepest_tilt_deg, "buoy.max_tilt_deg");
    Buoy buoy;
    buoy.body_id = given.body_id;
    buoy.position_m = world.scene_from_host(given.position_m);
    if (given.focal_height_m > 0) buoy.focal_height_m = given.focal_height_m;
    buoy.heave = {given.heave_period_s, given.heave_damping};
    buoy.roll = {given.roll_period_s, given.roll_damping};
    if (given.max_tilt_deg > 0) buoy.max_tilt_deg = given.max_tilt_deg;
    if (world.round_earth())
        buoy.upright = upright_at(buoy.position_m, {world.origin_latitude_deg(), world.origin_longitude_deg(),
                                                    world.origin_height_m()});
    return buoy;
}

seaglare_result SEAGLARE_CALL set_waves(seaglare_context* context, const seaglare_wave* waves, uint32_t count,
                                        uint32_t stride) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context);
        owner.set_waves(waves_from(waves, count, stride));
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL set_buoy(seaglare_context* context, const seaglare_buoy* buoy) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context);
        owner.set_buoy(buoy_from(copy_struct(buoy, "buoy"), owner.world()));
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL remove_buoy(seaglare_context* context, uint32_t body_id) {
    return at_border(inside(context), [&]() -> seaglare_result {
        required(context).remove_buoy(body_id);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL get_buoy_pose(seaglare_context* context, uint32_t body_id, double time_s,
                                            double position_m[3], double orientation[4]) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context);
        check_finite(time_s, "time_s");
        if (position_m == nullptr) invalid_argument("position_m is NULL");
        if (orientation == nullptr) invalid_argument("orientation is NULL");
        const lightdb::BodyPose pose = owner.buoy_pose(body_id, time_s);
        const Vec3 position = owner.world().host_from_scene(pose.position_m);
        const Quaternion turn = owner.world().host_from_body(pose.orientation);
        std::copy(position.begin(), position.end(), position_m);
        std::copy(turn.begin(), turn.end(), orientation);
        return SEAGLARE_OK;
    });
}

}  // namespace

constexpr seaglare_waves_api waves_api = {
    sizeof(seaglare_waves_api), 0, set_waves, set_buoy, remove_buoy, get_buoy_pose};

}  // namespace seaglare::plugin
