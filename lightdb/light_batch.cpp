#include "lightdb/light_batch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "lightdb/light_kinds.h"
#include "lightdb/rhythm.h"
#include "lightdb/spatial_index.h"

namespace seaglare::lightdb {

namespace {

std::uint64_t hashed(double number, std::uint64_t hash) {
    // + 0.0 makes one zero of the two. Byte order does not matter: machines that must agree run the same
    // build.
    const auto bits = std::bit_cast<std::array<char, sizeof(double)>>(number + 0.0);
    return fnv1a(std::string_view(bits.data(), bits.size()), hash);
}

// What the spatial index needs of a light, where it may stand in a block. A hair brighter than the store will have it:
// that multiplies in another order.
bool describe(const Light& light, HotLight& hot) {
    hot = {};
    if (light.body_id != 0 || !light.on || !(light.visibility > 0)) return false;
    const Vec3& p = light.position_m;
    if (!std::isfinite(p[0] + p[1] + p[2])) return false;
    hot.position_m = p;
    hot.radius_m = static_cast<float>(std::min(light.radius_m * (1 + 1e-6), 1e38));
    hot.peak_cd =
        peak_of_kind_cd(peak_cd(light), std::max(1.0, static_cast<double>(light.visibility)) * (1 + 1e-6));
    hot.flags = static_cast<std::uint8_t>(light_flag::awake | (light.day_off ? light_flag::day_off : 0));
    return hot.peak_cd > 0;
}

}  // namespace

std::uint64_t stable_key_of(const Light& light) {
    // A separator that no text contains keeps ("ab", "c") apart from ("a", "bc").
    constexpr std::string_view end("\0", 1);
    std::uint64_t hash = fnv1a(end, fnv1a(light.name));
    hash = fnv1a(end, fnv1a(light.character, hash));
    if (light.geographic) {
        hash = hashed(light.longitude_deg, hashed(light.latitude_deg, hash));
    } else {
        for (const double coordinate_m : light.position_m)
            hash = hashed(coordinate_m, hash);
    }
    hash = hashed(static_cast<double>(light.body_id), hash);
    return hash != 0 ? hash : 1;  // 0 means "not yet known"
}

float peak_of_kind_cd(float peak_cd, double scale) {
    if (scale == 1) return peak_cd;
    const double product = static_cast<double>(peak_cd) * scale;
    if (!(product > 0)) return 0;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (product > static_cast<double>(std::numeric_limits<float>::max())) return infinity;
    return std::nextafter(static_cast<float>(product), infinity);
}

LightBatch::LightBatch(std::vector<Light> lights) : lights_(std::move(lights)) {
    ids_.resize(lights_.size());
    entry_.reserve(lights_.size());
    LightArrays hot;
    hot.resize(lights_.size());
    // By day the ones with a photometer are left out as whole blocks.
    std::array<std::vector<LightBlock::Entry>, 2> parts;
    std::vector<std::uint32_t> others;
    for (std::uint32_t i = 0; i < lights_.size(); ++i) {
        if (lights_[i].stable_key == 0) lights_[i].stable_key = stable_key_of(lights_[i]);
        if (describe(lights_[i], hot[i])) {
            parts[lights_[i].day_off ? 1 : 0].push_back(LightBlock::entry_of(hot, i));
        } else {
            others.push_back(i);
        }
    }
    for (std::vector<LightBlock::Entry>& part : parts) {
        if (part.size() >= SpatialIndex::smallest_block) {
            make_blocks(hot, part);
        } else {
            for (const LightBlock::Entry& entry : part)
                others.push_back(entry.light);
        }
    }
    // What no block takes comes as it came in the file.
    std::sort(others.begin(), others.end());
    entry_.insert(entry_.end(), others.begin(), others.end());
    slots_.reserve(LightBlock::capacity);
    numbers_.reserve(blocks_.size());
    homeless_.reserve(others.size());
}

void LightBatch::make_blocks(const LightArrays& hot, std::span<LightBlock::Entry> entries) {
    if (entries.size() > LightBlock::capacity) {
        const std::size_t middle = entries.size() / 2;
        LightBlock::halve(entries, middle);
        make_blocks(hot, entries.first(middle));
        make_blocks(hot, entries.subspan(middle));
        return;
    }
    const LightBlock& block = blocks_.emplace_back(hot, entries);
    entry_.insert(entry_.end(), block.order().begin(), block.order().end());
}

}  // namespace seaglare::lightdb
