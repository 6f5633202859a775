// Light files in a context: loaded, read again while frames are drawn, and saved.
//
// Files are read, lights compared and a new file's blocks of the spatial index built without mutex_, so frames go on
// meanwhile. The lights of load_lights are taken in unseen, a few hundred at a time with frames in between, and shown all at
// once between two frames.
// files_mutex_ keeps what is remembered of files and the lights in step. It is taken first.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "lightdb/geodesy.h"
#include "lightdb/light_batch.h"
#include "lightdb/light_file.h"
#include "lightdb/light_reload.h"
#include "plugin_api/context.h"
#include "plugin_api/failure.h"

namespace seaglare::plugin {

namespace {

lightdb::GeographicPoint origin_of(const World& world) {
    return {world.origin_latitude_deg(), world.origin_longitude_deg(), world.origin_height_m()};
}

lightdb::Earth earth_of(const World& world) {
    return world.round_earth() ? lightdb::Earth::round : lightdb::Earth::flat;
}

// Local positions count from the file's own origin. A world whose origin was left zero has none to compare it with.
void move_to_world(lightdb::LightFile& file, const World& world) {
    const lightdb::GeographicPoint here = origin_of(world);
    if (!file.origin || *file.origin == here || here == lightdb::GeographicPoint{}) return;
    const lightdb::LocalFrame from(*file.origin);
    const lightdb::LocalFrame to(here);
    const Vec3 offset = lightdb::scene_from_geographic(*file.origin, here, earth_of(world));
    const auto moved = [&](const Vec3& position_m) {
        return world.round_earth() ? to.local_from_earth_centred(from.earth_centred_from_local(position_m))
                                   : lightdb::operator+(offset, position_m);
    };
    for (lightdb::Light& light : file.lights) {
        if (light.geographic || light.body_id != 0) continue;
        light.position_m = moved(light.position_m);
        light.true_north_deg += lightdb::true_north_in_scene_deg(*file.origin, here);
    }
    for (lightdb::Buoy& buoy : file.buoys) {
        if (!buoy.geographic) buoy.position_m = moved(buoy.position_m);
    }
}

struct ReadFile {
    lightdb::LightFile file;                  // placed in the world
    std::vector<lightdb::LoadedLight> known;  // its lights as the file has them
};

ReadFile read_into(const World& world, const std::string& path) {
    ReadFile result;
    result.file = lightdb::load_light_file(path);
    result.known = lightdb::remembered(result.file.lights);
    move_to_world(result.file, world);
    lightdb::place_lights(result.file.lights, origin_of(world), earth_of(world));
    for (lightdb::Buoy& buoy : result.file.buoys)
        lightdb::place_buoy(buoy, origin_of(world), earth_of(world));
    return result;
}

// Changes to a store that are taken back unless they are kept: running out of memory half-way changes nothing.
class Changes {
  public:
    explicit Changes(lightdb::LightStore& store) : store_(store) {}
    Changes(const Changes&) = delete;
    Changes& operator=(const Changes&) = delete;
    ~Changes() {
        if (kept_) return;
        for (const lightdb::LightId id : added_)
            store_.remove(id);
        try {
            for (auto& [id, light] : replaced_)
                store_.replace(id, std::move(light));
        } catch (...) {
            return;  // no memory even for what was there before: those lights stay as they are
        }
    }

    void reserve(std::size_t added, std::size_t replaced) {
        added_.reserve(added);
        replaced_.reserve(replaced);
    }
    lightdb::LightId add(lightdb::Light light) { return added_.emplace_back(store_.add(std::move(light))); }
    // What the host has switched and hidden stays so.
    bool replace(lightdb::LightId id, lightdb::Light light) {
        std::optional<lightdb::Light> before = store_.find(id);
        if (!before) return false;
        light.on = before->on;
        light.visibility = before->visibility;
        replaced_.emplace_back(id, *std::move(before));
        return store_.replace(id, std::move(light));
    }
    void keep() { kept_ = true; }

  private:
    lightdb::LightStore& store_;
    std::vector<lightdb::LightId> added_;
    std::vector<std::pair<lightdb::LightId, lightdb::Light>> replaced_;
    bool kept_ = false;
};

const lightdb::Buoy* buoy_of(const std::vector<lightdb::Buoy>& buoys, std::uint32_t body_id) {
    const auto found = std::find_if(buoys.begin(), buoys.end(),
                                    [body_id](const lightdb::Buoy& b) { return b.body_id == body_id; });
    return found != buoys.end() ? &*found : nullptr;
}

// How long a frame may find the lights taken, beside what the system does to threads: a small part of 16 ms.
constexpr std::chrono::microseconds longest_piece(250);
constexpr std::size_t lights_between_looks = 32;  // at the clock

}  // namespace

void Context::take_in(lightdb::LightBatch& batch) {
    for (bool more = true; more; mutex_.let_others_pass()) {
        const std::lock_guard lock(mutex_);
        const auto start = std::chrono::steady_clock::now();
        do {
            more = lights_.take_in(batch, lights_between_looks);
        } while (more && std::chrono::steady_clock::now() - start < longest_piece);
    }
}

void Context::load_lights(const std::string& path) {
    const std::lock_guard files_lock(files_mutex_);
    ReadFile read = read_into(world_, path);
    const std::vector<std::string> warnings = std::move(read.file.warnings);
    LoadedFile& loaded = files_[lightdb::file_identity(path)];
    loaded.lights.reserve(loaded.lights.size() + read.known.size());
    loaded.buoys.reserve(loaded.buoys.size() + read.file.buoys.size());
    lightdb::LightBatch batch(std::move(read.file.lights));
    try {
        take_in(batch);
        for (std::size_t i = 0; i < read.known.size(); ++i)
            read.known[i].id = batch.ids()[i];
        const std::lock_guard lock(mutex_);
        for (const lightdb::Buoy& buoy : read.file.buoys)
            buoys_.add(buoy);
        lights_.show(batch);
    } catch (...) {
        const std::lock_guard lock(mutex_);
        lights_.drop(batch);
        throw;
    }
    loaded.lights.insert(loaded.lights.end(), read.known.begin(), read.known.end());
    for (lightdb::Buoy& buoy : read.file.buoys) {
        if (buoy_of(loaded.buoys, buoy.body_id) == nullptr) loaded.buoys.push_back(std::move(buoy));
    }
    announce_lamps();
    for (const std::string& warning : warnings)
        log(SEAGLARE_LOG_WARNING, warning);
}

seaglare_reload_counts Context::reload_lights(const std::string& path) {
    seaglare_reload_counts counts{};
    counts.struct_size = sizeof counts;
    const std::lock_guard files_lock(files_mutex_);
    ReadFile read = read_into(world_, path);
    const std::vector<std::string> warnings = std::move(read.file.warnings);
    LoadedFile& loaded = files_[lightdb::file_identity(path)];
    std::vector<lightdb::LoadedLight> before;
    before.reserve(loaded.lights.size());
    {
        const std::lock_guard lock(mutex_);  // a light that the host has removed is none any more
        std::copy_if(loaded.lights.begin(), loaded.lights.end(), std::back_inserter(before),
                     [&](const lightdb::LoadedLight& light) { return lights_.contains(light.id); });
    }
    const lightdb::Reload reload = lightdb::match_reload(before, read.known);
    {
        const std::lock_guard lock(mutex_);
        Changes changes(lights_);
        changes.reserve(read.known.size(), before.size());
        for (std::size_t i = 0; i < read.known.size(); ++i) {
            const lightdb::Reload::Fate fate = reload.fates[i];
            lightdb::LightId& id = read.known[i].id;
            id = fate.before != lightdb::Reload::none ? before[fate.before].id : 0;
            if (id != 0 && !fate.changed && lights_.contains(id)) {
                ++counts.unchanged;
            } else if (id != 0 && fate.changed && changes.replace(id, read.file.lights[i])) {
                ++counts.changed;
            } else {
                id = changes.add(std::move(read.file.lights[i]));
                ++counts.added;
            }
        }
        for (const lightdb::Buoy& buoy : read.file.buoys) {
            // The host may have taken a buoy over (set_body_pose): that stays so while the file says the same of it.
            const lightdb::Buoy* const old = buoy_of(loaded.buoys, buoy.body_id);
            if (old == nullptr || !(*old == buoy)) buoys_.add(buoy);
        }
        changes.keep();
        for (const std::size_t gone : reload.vanished)
            counts.removed += lights_.remove(before[gone].id) ? 1 : 0;
        for (const lightdb::Buoy& old : loaded.buoys) {
            if (buoy_of(read.file.buoys, old.body_id) == nullptr) buoys_.remove(old.body_id);
        }
        loaded.lights = std::move(read.known);
        loaded.buoys = std::move(read.file.buoys);
    }
    announce_lamps();
    for (const std::string& warning : warnings)
        log(SEAGLARE_LOG_WARNING, warning);
    return counts;
}

void Context::clear_lights() {
    const std::lock_guard files_lock(files_mutex_);
    files_.clear();
    const std::lock_guard lock(mutex_);
    lights_.clear();
    buoys_.clear();
}

lightdb::LightFile Context::lights_to_save() const {
    constexpr std::size_t at_once = 4096;  // so that a frame never waits for a million
    lightdb::LightFile file;
    if (origin_of(world_) != lightdb::GeographicPoint{}) file.origin = origin_of(world_);
    std::vector<lightdb::LightId> ids;
    {
        const std::lock_guard lock(mutex_);
        ids = lights_.ids();
        for (const auto& [path, loaded] : files_) {
            for (const lightdb::Buoy& buoy : loaded.buoys) {
                if (buoys_.find(buoy.body_id) != nullptr) file.buoys.push_back(buoy);
            }
        }
    }
    file.lights.reserve(ids.size());
    std::unordered_map<std::string, std::size_t> sources;
    for (std::size_t begin = 0; begin < ids.size(); begin += at_once) {
        const std::size_t end = std::min(begin + at_once, ids.size());
        const std::lock_guard lock(mutex_);
        for (std::size_t i = begin; i < end; ++i) {
            std::optional<lightdb::Light> light = lights_.find(ids[i]);
            if (!light) continue;
            ++sources[light->source];
            file.lights.push_back(*std::move(light));
        }
    }
    // Said once what most of them have in common.
    for (const auto& [source, count] : sources) {
        if (2 * count > file.lights.size()) file.source = source;
    }
    return file;
}

void Context::save_lights(const std::string& path) const {
    const std::lock_guard files_lock(files_mutex_);
    const lightdb::LightFile file = lights_to_save();
    try {
        lightdb::save_light_file(file, path);
    } catch (const json::Error& unreadable) {
        // The place in a text that nobody has seen says little: which light is it?
        for (const lightdb::Light& light : file.lights) {
            lightdb::LightFile alone;
            alone.lights.push_back(light);
            try {
                lightdb::parse_light_file(lightdb::format_light_file(alone), "light");
            } catch (const json::Error& error) {
                invalid_argument("light '" + light.name +
                                 "' holds what no light file may, so nothing is saved: " + error.what());
            }
        }
        invalid_argument(std::string("nothing is saved: ") + unreadable.what());
    }
}

}  // namespace seaglare::plugin
