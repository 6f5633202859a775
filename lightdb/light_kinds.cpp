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
    for (std::size_t c = 0; light.spectrum && c < colour_count; ++c) {
        if (const SharedLamp& lamp = light.spectrum->lamp[c])
            hash.add(static_cast<double>(lamp->colour().rgb[0]));
    }
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

bool sends_nothing(const std::array<double, colour_count>& intensity_cd) {
    return std::all_of(intensity_cd.begin(), intensity_cd.end(), [](double value) { return value == 0; });
}

// What all intensities of a light may be divided by so that multiplying gives them back to the last bit, and lights that
// differ in it only have one kind; 1 where there is no such number.
double common_scale(const Light& light) {
    const auto found = std::find_if(light.intensity_cd.begin(), light.intensity_cd.end(),
                                    [](double value) { return value > 0; });
    if (found == light.intensity_cd.end()) return 1;
    const double scale = *found;
    // Far within what a float holds, so that nothing overflows on the way.
    if (!(scale > 1e-20 && scale < 1e20)) return 1;
    const auto comes_back = [scale](double value) { return value / scale * scale == value; };
    const bool all_come_back =
        std::all_of(light.intensity_cd.begin(), light.intensity_cd.end(), comes_back) &&
        std::all_of(light.day_intensity_cd.begin(), light.day_intensity_cd.end(), comes_back);
    return all_come_back ? scale : 1;
}

void scale_down(Light& light, double scale) {
    for (double& value : light.intensity_cd)
        value /= scale;
    for (double& value : light.day_intensity_cd)
        value /= scale;
}

void give_back_spare_memory(Light& light) {
    light.rhythm.phases.shrink_to_fit();
    light.sectors.shrink_to_fit();
    for (AngleTable* const table : {&light.horizontal, &light.vertical, &light.rotation.beam}) {
        table->angle_deg.shrink_to_fit();
        table->factor.shrink_to_fit();
    }
    light.character.shrink_to_fit();
}

std::size_t heap_bytes(const Light& light) {
    const auto table = [](const AngleTable& t) {
        return (t.angle_deg.capacity() + t.factor.capacity()) * sizeof(double);
    };
    const auto text = [](const std::string& t) { return t.capacity() > 15 ? t.capacity() + 1 : 0; };
    // A measured solid and a spectrum are shared and belong to the file they came from.
    return light.rhythm.phases.capacity() * sizeof(Phase) + light.sectors.capacity() * sizeof(Sector) +
           table(light.horizontal) + table(light.vertical) + table(light.rotation.beam) +
           text(light.character) + text(light.rhythm.sync_group);
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

void LightKinds::enter_lamps(Kind& kind) {
    for (std::size_t c = 0; c < colour_count; ++c) {
        const bool named = kind.light.spectrum && kind.light.spectrum->lamp[c];
        kind.lamp[c] =
            named ? lamps_.intern(kind.light.spectrum->lamp[c]) : static_cast<LampRegistry::Index>(c);
    }
}

void LightKinds::leave_lamps(const Kind& kind) {
    for (const LampRegistry::Index lamp : kind.lamp)
        lamps_.release(lamp);
}

LightKinds::Index LightKinds::take(Kind kind) {
    enter_lamps(kind);
    if (!free_.empty()) {
        const Index index = free_.back();
        kinds_[index] = std::move(kind);
        free_.pop_back();
        return index;
    }
    kinds_.resize(kinds_.size() + 1);
    kinds_[kinds_.size() - 1] = std::move(kind);
    return static_cast<Index>(kinds_.size() - 1);
}

void LightKinds::scale_up(Light& light, double scale) {
    if (scale == 1) return;
    for (double& value : light.intensity_cd)
        value *= scale;
    for (double& value : light.day_intensity_cd)
        value *= scale;
}

LightKinds::Member LightKinds::intern(Light light) {
    forget_own(light);
    const double scale = common_scale(light);
    if (scale != 1) scale_down(light, scale);
    return {intern_as_it_is(std::move(light)), scale};
}

LightKinds::Index LightKinds::intern_as_it_is(Light light) {
    const std::uint64_t hash = hash_of(light);
    Table& table = table_of(hash);
    const auto [first, last] = table.equal_range(hash);
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
    give_back_spare_memory(kind.light);
    const Index index = take(std::move(kind));
    table.emplace(hash, index);
    return index;
}

void LightKinds::release(Index index) {
    Kind& kind = kinds_[index];
    if (--kind.lights > 0) return;
    if (kind.shared) {
        Table& table = table_of(kind.hash);
        const auto [first, last] = table.equal_range(kind.hash);
        table.erase(std::find_if(first, last, [index](const auto& e) { return e.second == index; }));
    }
    leave_lamps(kind);
    kind = {};
    free_.push_back(index);
}

LightKinds::Member LightKinds::with_intensity(const Member& before, double intensity_cd) {
    const std::uint8_t colours = kinds_[before.kind].colours;
    const auto has = [colours](std::size_t colour) { return (colours >> colour & 1U) != 0; };
    const auto set_all = [&](Light& light, double value) {
        for (std::size_t c = 0; c < light.intensity_cd.size(); ++c) {
            if (has(c)) light.intensity_cd[c] = value;
        }
    };
    if (sends_nothing(kinds_[before.kind].light.day_intensity_cd)) {
        // All its colours alike: only the scale says how bright.
        Light alike = kinds_[before.kind].light;
        set_all(alike, 1);
        if (kinds_[before.kind].shared && alike == kinds_[before.kind].light)
            return {before.kind, intensity_cd};
        const Index kind = intern_as_it_is(std::move(alike));
        release(before.kind);
        return {kind, intensity_cd};
    }
    // What it has by day stays as it was, so it becomes a kind of its own.
    Index index = before.kind;
    if (kinds_[index].shared) {
        Kind own = kinds_[index];
        scale_up(own.light, before.scale);
        own.shared = false;
        own.lights = 1;
        index = take(std::move(own));
        release(before.kind);
    }
    Kind& kind = kinds_[index];
    set_all(kind.light, intensity_cd);
    kind.peak_cd = lightdb::peak_cd(kind.light);
    return {index, 1};
}

std::size_t LightKinds::memory_bytes() const {
    std::size_t texts = lamps_.memory_bytes();
    for (std::size_t i = 0; i < kinds_.size(); ++i)
        texts += heap_bytes(kinds_[i].light);
    static constexpr std::size_t per_entry = 2 * sizeof(void*) + sizeof(std::uint64_t) + sizeof(Index);
    const std::size_t tables = std::accumulate(
        by_hash_.begin(), by_hash_.end(), std::size_t{0}, [](std::size_t sum, const Table& table) {
            return sum + table.size() * per_entry + table.bucket_count() * sizeof(void*);
        });
    return kinds_.capacity() * sizeof(Kind) + free_.capacity() * sizeof(Index) + texts + tables;
}

}  // namespace seaglare::lightdb
