// What the context knows of things that float: vessels' lights, the sea, and the buoys on it.
#include <utility>

#include "plugin_api/context.h"
#include "plugin_api/failure.h"

namespace seaglare::plugin {

std::vector<lightdb::LightId> Context::add_lights(std::vector<lightdb::Light> lights) {
    std::vector<lightdb::LightId> ids;
    ids.reserve(lights.size());
    const std::lock_guard lock(mutex_);
    try {
        for (lightdb::Light& light : lights)
            ids.push_back(lights_.add(std::move(light)));
    } catch (...) {
        for (const lightdb::LightId id : ids)
            lights_.remove(id);
        throw;
    }
    return ids;
}

void Context::remove_lights(const seaglare_light_id* ids, std::uint32_t count) {
    const std::lock_guard lock(mutex_);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (lights_.id_of(static_cast<lightdb::LightIndex>((ids[i] & 0xFFFFFFFFU) - 1)) != ids[i] ||
            ids[i] == 0)
            throw Failure(SEAGLARE_ERROR_STALE_ID,
                          "ids[" + std::to_string(i) + "] names no light, or one that was removed");
    }
    for (std::uint32_t i = 0; i < count; ++i)
        lights_.remove(ids[i]);
}

void Context::set_waves(std::vector<lightdb::WaveComponent> waves) {
    const std::lock_guard lock(mutex_);
    buoys_.set_waves(std::move(waves));
}

void Context::set_buoy(const lightdb::Buoy& buoy) {
    const std::lock_guard lock(mutex_);
    buoys_.add(buoy);
}

void Context::remove_buoy(std::uint32_t body_id) {
    const std::lock_guard lock(mutex_);
    if (!buoys_.remove(body_id))
        throw Failure(SEAGLARE_ERROR_STALE_ID, "body_id names no buoy, or one that was removed");
}

lightdb::BodyPose Context::buoy_pose(std::uint32_t body_id, double time_s) const {
    const std::lock_guard lock(mutex_);
    const lightdb::Buoy* const buoy = buoys_.find(body_id);
    if (buoy == nullptr)
        throw Failure(SEAGLARE_ERROR_STALE_ID, "body_id names no buoy, or one that was removed");
    return lightdb::buoy_pose(*buoy, buoys_.waves(), time_s);
}

}  // namespace seaglare::plugin
