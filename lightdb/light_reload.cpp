#include "lightdb/light_reload.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <map>
#include <string_view>
#include <utility>

#include "lightdb/rhythm.h"

namespace seaglare::lightdb {

namespace {

// FNV-1a over values. Every struct is taken apart by a structured binding: a member that is added does not compile until
// it is looked at here.
class Hash {
  public:
    explicit Hash(std::map<const PhotometricSolid*, std::uint64_t>& solids) : solids_(solids) {}

    std::uint64_t value() const { return hash_ != 0 ? hash_ : 1; }

    void add(std::integral auto number) { add_bytes(static_cast<std::uint64_t>(number)); }
    // + 0.0 makes one zero of the two.
    void add(double number) { add_bytes(std::bit_cast<std::uint64_t>(number + 0.0)); }
    void add(std::string_view text) {
        add(text.size());
        hash_ = fnv1a(text, hash_);
    }
    void add(Colour colour) { add(static_cast<int>(colour)); }
    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }
    template <std::size_t N>
    void add(const std::array<double, N>& numbers) {
        for (const double number : numbers)
            add(number);
    }
    template <class T>
    void add(const std::vector<T>& list) {
        add(list.size());
        for (const T& value : list)
            add(value);
    }
    void add(const Phase& phase) {
        const auto& [duration_s, lit, colour, level] = phase;
        add_all(duration_s, lit, colour, level);
    }
    void add(const Rhythm& rhythm) {
        const auto& [phases, period_s, sync_group, delay_s, rise_s, fall_s] = rhythm;
        add_all(phases, period_s, std::string_view(sync_group), delay_s, rise_s, fall_s);
    }
    void add(const Sector& sector) {
        const auto& [colour, from_deg, to_deg, factor, transition_deg, from_elevation_deg, to_elevation_deg] =
            sector;
        add_all(colour, from_deg, to_deg, factor, transition_deg, from_elevation_deg, to_elevation_deg);
    }
    void add(const AngleTable& table) {
        const auto& [angle_deg, factor] = table;
        add_all(angle_deg, factor);
    }
    void add(const RotatingBeam& rotation) {
        const auto& [period_s, beam] = rotation;
        add_all(period_s, beam);
    }
    void add(const SharedSolid& shared) {
        add(static_cast<bool>(shared));
        if (!shared) return;
        const auto [at, is_new] = solids_.try_emplace(shared.get(), 0);
        if (is_new) {
            Hash hash(solids_);
            const auto& [axis, azimuth_deg, latitude_deg, candela, whole_turn, reference_cd, radius_m, file] =
                *shared;
            hash.add_all(static_cast<int>(axis), azimuth_deg, latitude_deg, candela, whole_turn, reference_cd,
                         radius_m, std::string_view(file));
            at->second = hash.value();
        }
        add(at->second);
    }
    void add(const SharedLightSpectrum& shared) {
        add(static_cast<bool>(shared));
        if (!shared) return;
        for (const SharedLamp& lamp : shared->lamp) {
            add(lamp != nullptr);
            if (lamp) add(lamp->powers());
        }
    }
    template <class... Values>
    void add_all(const Values&... values) {
        (add(values), ...);
    }

  private:
    void add_bytes(std::uint64_t bits) {
        const auto bytes = std::bit_cast<std::array<char, sizeof bits>>(bits);
        hash_ = fnv1a(std::string_view(bytes.data(), bytes.size()), hash_);
    }

    std::map<const PhotometricSolid*, std::uint64_t>& solids_;
    std::uint64_t hash_ = fnv_start;
};

void add_place(Hash& hash, const Light& light) {
    hash.add(light.geographic);
    if (light.geographic) {
        hash.add_all(light.latitude_deg, light.longitude_deg);
    } else {
        hash.add(light.position_m);
    }
}

void add_data(Hash& hash, const Light& light) {
    const auto& [name, position_m, geographic, latitude_deg, longitude_deg, height_m, radius_m, intensity_cd,
                 day_intensity_cd, character, rhythm, sectors, sector_reference, true_north_deg, horizontal,
                 vertical, photometry, rotation, leading_bearing_deg, body_id, orientation, day_off, spectrum,
                 source, stable_key, on, visibility] = light;
    static_cast<void>(position_m);  // in the place, with the next three
    static_cast<void>(geographic);
    static_cast<void>(latitude_deg);
    static_cast<void>(longitude_deg);
    static_cast<void>(on);  // the host's
    static_cast<void>(visibility);
    add_place(hash, light);
    hash.add_all(std::string_view(name), height_m, radius_m, intensity_cd, day_intensity_cd,
                 std::string_view(character), rhythm, sectors, static_cast<int>(sector_reference),
                 true_north_deg, horizontal, vertical, photometry, rotation, leading_bearing_deg, body_id,
                 orientation, day_off, spectrum, std::string_view(source), stable_key);
}

// The lights that are not matched yet, by one of their hashes, alike ones in the order of the file.
std::vector<std::pair<std::uint64_t, std::size_t>> sorted_by(std::uint64_t LoadedLight::*hash,
                                                             std::span<const LoadedLight> lights,
                                                             const std::vector<bool>& matched) {
    std::vector<std::pair<std::uint64_t, std::size_t>> result;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!matched[i] && lights[i].*hash != 0) result.emplace_back(lights[i].*hash, i);
    }
    std::sort(result.begin(), result.end());
    return result;
}

class Matcher {
  public:
    Matcher(std::span<const LoadedLight> before, std::span<const LoadedLight> after)
        : before_(before), after_(after), before_matched_(before.size()), after_matched_(after.size()) {
        result_.fates.resize(after.size());
    }

    void match(std::uint64_t LoadedLight::*hash, bool only_alone) {
        const auto old_lights = sorted_by(hash, before_, before_matched_);
        const auto new_lights = sorted_by(hash, after_, after_matched_);
        auto old_light = old_lights.begin();
        auto new_light = new_lights.begin();
        while (old_light != old_lights.end() && new_light != new_lights.end()) {
            if (old_light->first != new_light->first) {
                ++(old_light->first < new_light->first ? old_light : new_light);
                continue;
            }
            const std::uint64_t key = old_light->first;
            const auto ends = [key](const auto& entry) { return entry.first != key; };
            const auto old_end = std::find_if(old_light, old_lights.end(), ends);
            const auto new_end = std::find_if(new_light, new_lights.end(), ends);
            if (!only_alone || (old_end - old_light == 1 && new_end - new_light == 1)) {
                for (auto o = old_light, n = new_light; o != old_end && n != new_end; ++o, ++n)
                    pair(o->second, n->second);
            }
            old_light = old_end;
            new_light = new_end;
        }
    }

    Reload finished() {
        for (std::size_t i = 0; i < before_.size(); ++i) {
            if (!before_matched_[i]) result_.vanished.push_back(i);
        }
        return std::move(result_);
    }

  private:
    void pair(std::size_t before, std::size_t after) {
        before_matched_[before] = true;
        after_matched_[after] = true;
        result_.fates[after] = {before, before_[before].data != after_[after].data};
    }

    std::span<const LoadedLight> before_;
    std::span<const LoadedLight> after_;
    std::vector<bool> before_matched_;
    std::vector<bool> after_matched_;
    Reload result_;
};

}  // namespace

std::vector<LoadedLight> remembered(std::span<const Light> lights) {
    std::map<const PhotometricSolid*, std::uint64_t> solids;
    std::vector<LoadedLight> result;
    result.reserve(lights.size());
    for (const Light& light : lights) {
        LoadedLight& entry = result.emplace_back();
        Hash data(solids);
        add_data(data, light);
        entry.data = data.value();
        Hash place(solids);
        place.add_all(std::string_view(light.name), light.body_id);
        if (!light.name.empty()) entry.name = place.value();
        add_place(place, light);
        entry.place = place.value();
    }
    return result;
}

Reload match_reload(std::span<const LoadedLight> before, std::span<const LoadedLight> after) {
    Matcher matcher(before, after);
    matcher.match(&LoadedLight::data, false);
    matcher.match(&LoadedLight::place, false);
    matcher.match(&LoadedLight::name, true);
    return matcher.finished();
}

}  // namespace seaglare::lightdb
