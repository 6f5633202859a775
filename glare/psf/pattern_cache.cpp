#include "glare/psf/pattern_cache.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace seaglare::glare {

PatternCache::Entry& PatternCache::find(const PatternSettings& settings, double pitch) {
    ++clock_;
    for (const auto& entry : entries_) {
        if (entry->grid.pitch == pitch) {
            entry->used = clock_;
            return *entry;
        }
    }
    auto entry = std::make_unique<Entry>();
    entry->grid = plan_grid(settings, pitch);
    entry->used = clock_;
    if (entries_.size() < capacity) {
        entries_.push_back(std::move(entry));
        return *entries_.back();
    }
    const auto oldest = std::min_element(entries_.begin(), entries_.end(),
                                         [](const auto& a, const auto& b) { return a->used < b->used; });
    // The memory of the table is kept for its successor.
    entry->pattern.skirt.swap((*oldest)->pattern.skirt);
    *oldest = std::move(entry);
    return **oldest;
}

namespace {

// Which lamps have a pattern, and which of them each lamp is drawn with.
void assign_slots(const PatternSettings& settings, const PatternRequest& request, Pattern& pattern) {
    const std::uint32_t own = settings.spectra == SpectraMode::filter
                                  ? 1U
                                  : lamps_with_own_pattern(request.lamps, settings.max_lamps_in_view);
    pattern.lamps.clear();
    pattern.slot_of_lamp.fill(0);
    for (std::uint8_t lamp = 0; lamp < most_lamps; ++lamp) {
        if ((own >> lamp & 1U) == 0) continue;
        pattern.slot_of_lamp[lamp] = static_cast<std::uint8_t>(pattern.lamps.size());
        pattern.lamps.push_back(lamp);
    }
    // Lamps that nobody asked for, too: one that comes into view is drawn like its nearest until it has a pattern.
    const LampList& list = lamp_list_of(request);
    for (std::uint8_t lamp = 0; lamp < most_lamps; ++lamp) {
        const bool exists = lamp < lamp_count || list.spectra[lamp] != nullptr;
        if (!exists || (own & 1U << lamp) != 0) continue;
        const int nearest = nearest_lamp(list, own, lamp);
        pattern.slot_of_lamp[lamp] = pattern.slot_of_lamp[static_cast<std::size_t>(nearest)];
    }
}

}  // namespace

double describe_pattern(const EyeModel& eye, const PatternSettings& settings, const PatternGrid& grid,
                        const PatternRequest& request, Pattern& pattern) {
    const EnergyPlan energy = plan_energy(eye, settings, grid, request.pupil_mm);
    pattern.radius_nodes = grid.radius;
    pattern.pitch = grid.pitch;
    assign_slots(settings, request, pattern);
    const LayerPlan layers = layer_plan(settings, grid, request.largest_disc_nodes);
    pattern.layer_radius_nodes.assign(layers.radii_nodes.begin(),
                                      layers.radii_nodes.begin() + static_cast<std::ptrdiff_t>(layers.count));
    pattern.window_inner = grid.window_inner;
    pattern.window_outer = grid.window_outer;
    pattern.tail_scale = energy.tail_scale;
    pattern.tail_age_years = eye.age_years;
    pattern.tail_pigmentation = eye.pigmentation;
    pattern.transform_size = field_transform_size(settings);
    pattern.wavelengths = settings.wavelengths;
    pattern.pupil_mm = request.pupil_mm;
    pattern.angular_scale = settings.angular_scale;
    return energy.structure;
}

std::uint64_t new_generation() {
    static std::atomic<std::uint64_t> last{0};
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

double drawable_pupil_mm(double pupil_mm, double plane_width_mm) {
    constexpr double smallest_mm = 0.1;
    if (!std::isfinite(pupil_mm)) pupil_mm = smallest_mm;
    return std::clamp(pupil_mm, smallest_mm, std::max(smallest_mm, 0.99 * plane_width_mm));
}

void validate(const PatternSettings& settings) {
    const int n = settings.transform_size;
    if (n < 256 || n > 4096 || !std::has_single_bit(static_cast<unsigned>(n)))
        throw std::invalid_argument("glare pattern: transform_size must be 256, 512, 1024, 2048 or 4096");
    const int wide = settings.wide_field_size;
    if (wide != 0 && (wide <= n || wide > 4096 || !std::has_single_bit(static_cast<unsigned>(wide))))
        throw std::invalid_argument(
            "glare pattern: the wide field must be larger than transform_size, a power of two up to 4096");
    if (!(settings.wide_field_interval_s > 0) || !std::isfinite(settings.wide_field_interval_s))
        throw std::invalid_argument("glare pattern: the wide field's interval must be positive");
    if (!(settings.plane_width_mm > 0) || !std::isfinite(settings.plane_width_mm))
        throw std::invalid_argument("glare pattern: plane_width_mm must be positive");
    if (!(settings.angular_scale > 0) || !std::isfinite(settings.angular_scale))
        throw std::invalid_argument("glare pattern: angular_scale must be positive");
    if (!(settings.core_radius_nodes > 0))
        throw std::invalid_argument("glare pattern: core_radius_nodes must be positive");
    if (settings.wavelengths < 1)
        throw std::invalid_argument("glare pattern: at least one wavelength is needed");
    if (!(settings.wavelength_step_px >= 0) || !std::isfinite(settings.wavelength_step_px))
        throw std::invalid_argument("glare pattern: wavelength_step_px must not be negative");
    if (settings.max_lamps_in_view < 1 || settings.max_lamps_in_view > most_lamps)
        throw std::invalid_argument("glare pattern: max_lamps_in_view must be 1 to 32");
    if (settings.layer_radii_px.size() > most_layers)
        throw std::invalid_argument("glare pattern: too many layers");
}

}  // namespace seaglare::glare
