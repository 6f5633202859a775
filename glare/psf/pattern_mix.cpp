#include "glare/psf/pattern_mix.h"

#include <algorithm>
#include <stdexcept>

#include "glare/psf/pattern_cache.h"

namespace seaglare::glare {

namespace {

std::size_t layer_floats(const Pattern& pattern) {
    const auto side = 2 * static_cast<std::size_t>(pattern.radius_nodes) + 1;
    return side * side * 4;
}

// The slot that a lamp is drawn with: its own, or that of the lamp that stands in for it.
std::size_t slot_for(const Pattern& pattern, std::uint8_t lamp) {
    const auto own = std::find(pattern.lamps.begin(), pattern.lamps.end(), lamp);
    if (own != pattern.lamps.end()) return static_cast<std::size_t>(own - pattern.lamps.begin());
    return std::min<std::size_t>(pattern.slot_of_lamp[lamp], pattern.lamps.size() - 1);
}

// The lamps of b, and those in view that another stands in for than in a; ascending, as a pattern's are.
void assign_lamps(const Pattern& a, const Pattern& b, std::uint32_t in_view, Pattern& out) {
    out.lamps.clear();
    for (std::uint8_t lamp = 0; lamp < most_lamps; ++lamp) {
        const std::size_t in_b = slot_for(b, lamp);
        const bool goes_over = (in_view >> lamp & 1U) != 0 && a.lamps[slot_for(a, lamp)] != b.lamps[in_b];
        if (b.lamps[in_b] == lamp || goes_over) out.lamps.push_back(lamp);
    }
    for (std::uint8_t lamp = 0; lamp < most_lamps; ++lamp) {
        const auto own = std::find(out.lamps.begin(), out.lamps.end(), lamp);
        const auto drawn = own != out.lamps.end()
                               ? own
                               : std::find(out.lamps.begin(), out.lamps.end(), b.lamps[slot_for(b, lamp)]);
        out.slot_of_lamp[lamp] = static_cast<std::uint8_t>(drawn - out.lamps.begin());
    }
}

const float* layer_of(const Pattern& pattern, std::size_t slot, std::size_t layer) {
    const std::size_t layers = pattern.layer_radius_nodes.size();
    return pattern.skirt.data() + (slot * layers + std::min(layer, layers - 1)) * layer_floats(pattern);
}

bool has_fine_nodes(const Pattern& pattern) {
    return pattern.fine.size() == pattern.lamps.size() * fine_floats;
}

// They have no energy: a pattern without them is mixed as if they were zero.
void mix_fine_nodes(const Pattern& a, const Pattern& b, float weight_a, float weight_b, Pattern& out) {
    if (!has_fine_nodes(a) && !has_fine_nodes(b)) {
        out.fine.clear();
        return;
    }
    out.fine.assign(out.lamps.size() * fine_floats, 0.0F);
    const auto add = [&out](const Pattern& from, float weight) {
        if (!has_fine_nodes(from)) return;
        for (std::size_t slot = 0; slot < out.lamps.size(); ++slot) {
            const float* const of = from.fine.data() + slot_for(from, out.lamps[slot]) * fine_floats;
            float* const to = out.fine.data() + slot * fine_floats;
            for (std::size_t i = 0; i < fine_floats; ++i)
                to[i] += weight * of[i];
        }
    };
    add(a, weight_a);
    add(b, weight_b);
}

}  // namespace

bool can_mix(const Pattern& a, const Pattern& b) {
    const auto whole = [](const Pattern& p) {
        return !p.lamps.empty() && !p.layer_radius_nodes.empty() &&
               p.skirt.size() == p.lamps.size() * p.layer_radius_nodes.size() * layer_floats(p);
    };
    return a.generation != 0 && b.generation != 0 && a.pitch == b.pitch && a.radius_nodes == b.radius_nodes &&
           a.window_inner == b.window_inner && a.window_outer == b.window_outer && whole(a) && whole(b);
}

void mix_patterns(const Pattern& a, const Pattern& b, double weight_of_b, Pattern& out, double share,
                  std::uint32_t in_view) {
    if (!can_mix(a, b)) throw std::invalid_argument("glare pattern: only patterns of one grid can be mixed");
    double later = weight_of_b;
    if (!(later < 1)) later = 1;
    later = std::max(later, 0.0);
    const double of_a = (1 - later) * share;
    const double of_b = later * share;

    const std::vector<float>& radii = a.layer_radius_nodes.size() > b.layer_radius_nodes.size()
                                          ? a.layer_radius_nodes
                                          : b.layer_radius_nodes;
    out.radius_nodes = b.radius_nodes;
    out.pitch = b.pitch;
    assign_lamps(a, b, in_view, out);
    out.layer_radius_nodes = radii;
    out.window_inner = b.window_inner;
    out.window_outer = b.window_outer;
    out.tail_scale = of_a * a.tail_scale + of_b * b.tail_scale;
    out.tail_age_years = b.tail_age_years;
    out.tail_pigmentation = b.tail_pigmentation;
    out.lash_turn_rad = b.lash_turn_rad;
    out.lash_bend_per_rad = b.lash_bend_per_rad;
    out.transform_size = b.transform_size;
    out.wavelengths = b.wavelengths;
    out.pupil_mm = (1 - later) * a.pupil_mm + later * b.pupil_mm;
    out.angular_scale = b.angular_scale;
    out.structure_scale = (1 - later) * a.structure_scale + later * b.structure_scale;
    out.kernel_launches = b.kernel_launches;

    const std::size_t floats = layer_floats(b);
    const auto weight_a = static_cast<float>(of_a);
    const auto weight_b = static_cast<float>(of_b);
    out.skirt.resize(out.lamps.size() * radii.size() * floats);
    for (std::size_t slot = 0; slot < out.lamps.size(); ++slot) {
        const std::size_t slot_a = slot_for(a, out.lamps[slot]);
        const std::size_t slot_b = slot_for(b, out.lamps[slot]);
        for (std::size_t c = 0; c < 4; ++c) {
            out.core_energy[slot][c] =
                static_cast<float>(of_a * static_cast<double>(a.core_energy[slot_a][c]) +
                                   of_b * static_cast<double>(b.core_energy[slot_b][c]));
        }
        for (std::size_t layer = 0; layer < radii.size(); ++layer) {
            const float* const from_a = layer_of(a, slot_a, layer);
            const float* const from_b = layer_of(b, slot_b, layer);
            float* const to = out.skirt.data() + (slot * radii.size() + layer) * floats;
            for (std::size_t i = 0; i < floats; ++i)
                to[i] = weight_a * from_a[i] + weight_b * from_b[i];
        }
    }
    mix_fine_nodes(a, b, weight_a, weight_b, out);
    out.generation = new_generation();
}

void dim_pattern(double share, Pattern& pattern) {
    const auto factor = static_cast<float>(share);
    for (float& value : pattern.skirt)
        value *= factor;
    for (float& value : pattern.fine)
        value *= factor;
    for (Rgbv& energy : pattern.core_energy)
        for (float& channel : energy)
            channel *= factor;
    pattern.tail_scale *= share;
    pattern.generation = new_generation();
}

}  // namespace seaglare::glare
