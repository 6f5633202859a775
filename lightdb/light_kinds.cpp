#include "lightdb/light_kinds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include "lightdb/emission.h"
#include "lightdb/rhythm.h"

namespace seaglare::lightdb {

namespace {

// The largest of some numbers and `least`; infinity where one is none.
double largest(double least, std::span<const double> values) {
    for (const double value : values) {
        if (std::isnan(value)) return std::numeric_limits<double>::infinity();
        least = std::max(least, value);
    }
    return least;
}

double table_peak(const AngleTable& table) {
    return table.factor.empty() ? 1 : largest(0, table.factor);
}

double intensities_peak_cd(const Light& light, const std::array<double, colour_count>& intensity_cd) {
    // Sectors may show several colours at once where they grade or overlap; a rhythm shows one after the other.
    double sum = 0;
    double most = 0;
    for (const double value : intensity_cd) {
        if (!(value > 0)) continue;
        sum += value;
        most = std::max(most, value);
    }
    return light.sectors.empty() ? most : sum;
}

// FNV-1a over words instead of bytes: quick, and only ever compared within the process.
class Hash {
  public:
    void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x9E3779B97F4A7C15U, value_ ^= value_ >> 29; }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number + 0.0)); }
    void add(std::string_view text) { add(fnv1a(text)); }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = fnv_start;
};

// Of what usually tells kinds apart: equal kinds have equal hashes.
std::uint64_t hash_of(const Light& light) {
    Hash hash;
    for (const double value : light.intensity_cd)
        hash.add(value);
    hash.add(light.character);
    hash.add(light.true_north_deg);
    hash.add(light.rhythm.sync_group);
    hash.add(light.rhythm.delay_s);
    for (const Phase& phase : light.rhythm.phases)
        hash.add(phase.duration_s);
    for (const Sector& sector : light.sectors) {
        hash.add(sector.from_deg);
        hash.add(sector.to_deg);
    }
    hash.add(static_cast<std::uint64_t>(light.vertical.factor.size() + 64 * light.horizontal.factor.size()));
    return hash.value();
}

// Leaves what a kind has.
void forget_own(Light& light) {
    const Light plain;
    light.name.clear();
    light.source.clear();
    light.position_m = plain.position_m;
    light.geographic = plain.geographic;
    light.latitude_deg = plain.latitude_deg;
    light.longitude_deg = plain.longitude_deg;
    light.height_m = plain.height_m;
    light.radius_m = plain.radius_m;
    light.body_id = plain.body_id;
    light.orientation = plain.orientation;
    light.day_off = plain.day_off;
    light.stable_key = plain.stable_key;
    light.on = plain.on;
    light.visibility = plain.visibility;
    if (!has_direction(light)) light.true_north_deg = 0;  // nothing then hangs on it
}

std::size_t heap_bytes(const Light& light) {
    const auto table = [](const AngleTable& t) {
        return (t.angle_deg.capacity() + t.factor.capacity()) * sizeof(double);
    };
    const auto text = [](const std::string& t) { return t.capacity() > 15 ? t.capacity() + 1 : 0; };
    // A measured solid is shared and belongs to the file it came from.
    return light.rhythm.phases.capacity() * sizeof(Phase) + light.sectors.capacity() * sizeof(Sector) +
           table(light.horizontal) + table(light.vertical) + table(light.rotation.beam) +
           text(light.character) + text(light.rhythm.sync_group) + text(light.spectrum);
}

}  // namespace

float peak_cd(const Light& light) {
    double peak = std::max(intensities_peak_cd(light, light.intensity_cd),
                           intensities_peak_cd(light, light.day_intensity_cd));
    if (!(peak > 0)) return 0;
    double level = 1;
    for (const Phase& phase : light.rhythm.phases)
        level = largest(level, {&phase.level, 1});
    double sector = 1;
    for (const Sector& s : light.sectors)
        sector = largest(sector, {&s.intensity_factor, 1});
    double solid = 1;
    if (light.photometry && light.photometry->reference_cd > 0)
        solid = largest(0, light.photometry->candela) / light.photometry->reference_cd;
    peak *= level * sector * solid * table_peak(light.horizontal) * table_peak(light.vertical) *
            table_peak(light.rotation.beam);
    if (std::isnan(peak)) return std::numeric_limits<float>::infinity();  // infinity times zero
    // A hair more, for the rounding of mixtures; then up to the next float.
    peak *= 1 + 1e-6;
    if (peak > static_cast<double>(std::numeric_limits<float>::max()))
        return std::numeric_limits<float>::infinity();
    return std::max(static_cast<float>(peak), std::numeric_limits<float>::denorm_min());
}

LightKinds::Index LightKinds::take(Kind kind) {
    if (!free_.empty()) {
        const Index index = free_.back();
        kinds_[index] = std::move(kind);
        free_.pop_back();
        return index;
    }
    kinds_.push_back(std::move(kind));
    return static_cast<Index>(kinds_.size() - 1);
}

LightKinds::Index LightKinds::intern(Light light) {
    forget_own(light);
    const std::uint64_t hash = hash_of(light);
    const auto [first, last] = by_hash_.equal_range(hash);
    for (auto found = first; found != last; ++found) {
        Kind& kind = kinds_[found->second];
        if (kind.light == light) {
            ++kind.lights;
            return found->second;
        }
    }
    Kind kind;
    kind.peak_cd = lightdb::peak_cd(light);
    kind.has_direction = lightdb::has_direction(light);
    for (std::size_t c = 0; c < light.intensity_cd.size(); ++c) {
        if (light.intensity_cd[c] > 0) kind.colours = static_cast<std::uint8_t>(kind.colours | 1U << c);
    }
    kind.shared = true;
    kind.lights = 1;
    kind.hash = hash;
    kind.light = std::move(light);
    const Index index = take(std::move(kind));
    by_hash_.emplace(hash, index);
    return index;
}

void LightKinds::release(Index index) {
    Kind& kind = kinds_[index];
    if (--kind.lights > 0) return;
    if (kind.shared) {
        const auto [first, last] = by_hash_.equal_range(kind.hash);
        by_hash_.erase(std::find_if(first, last, [index](const auto& e) { return e.second == index; }));
    }
    kind = {};
    free_.push_back(index);
}

LightKinds::Index LightKinds::with_intensity(Index index, double intensity_cd) {
    if (kinds_[index].shared) {
        Kind own = kinds_[index];
        own.shared = false;
        own.lights = 1;
        const Index copy = take(std::move(own));
        release(index);
        index = copy;
    }
    Kind& kind = kinds_[index];
    for (std::size_t c = 0; c < kind.light.intensity_cd.size(); ++c) {
        if ((kind.colours >> c & 1U) != 0) kind.light.intensity_cd[c] = intensity_cd;
    }
    kind.peak_cd = lightdb::peak_cd(kind.light);
    return index;
}

std::size_t LightKinds::memory_bytes() const {
    const std::size_t texts =
        std::accumulate(kinds_.begin(), kinds_.end(), std::size_t{0},
                        [](std::size_t sum, const Kind& kind) { return sum + heap_bytes(kind.light); });
    constexpr std::size_t per_entry = 2 * sizeof(void*) + sizeof(std::uint64_t) + sizeof(Index);
    return kinds_.size() * sizeof(Kind) + free_.capacity() * sizeof(Index) + texts +
           by_hash_.size() * per_entry + by_hash_.bucket_count() * sizeof(void*);
}

}  // namespace seaglare::lightdb
