#include "lightdb/lamp_registry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace seaglare::lightdb {

namespace {

bool same(const SharedLamp& a, const SharedLamp& b) {
    return a == b || (a && b && *a == *b);
}

double strongest_channel(const glare::UnitColour& colour) {
    // As glare counts the rods' brightness: channel_bound_lx() of apply/light_instance.h, whose rod tint is below 1.3.
    double strongest = std::abs(static_cast<double>(colour.scotopic_per_photopic)) / 2.464 * 1.3;
    for (const float channel : colour.rgb)
        strongest = std::max(strongest, std::abs(static_cast<double>(channel)));
    return strongest;
}

// Integrals over spectra, worked out once.
const std::vector<LampRegistry::Entry>& navigation_entries() {
    static const std::vector<LampRegistry::Entry> entries = [] {
        std::vector<LampRegistry::Entry> made(glare::lamp_count);
        for (int c = 0; c < glare::lamp_count; ++c) {
            LampRegistry::Entry& entry = made[static_cast<std::size_t>(c)];
            entry.colour = glare::navigation_colour(c);
            entry.lamp = static_cast<std::uint8_t>(c);
            entry.users = 1;
        }
        return made;
    }();
    return entries;
}

}  // namespace

LampRegistry::LampRegistry() : entries_(navigation_entries()) {}

LampRegistry::Index LampRegistry::intern(const SharedLamp& spectrum) {
    const auto begin = entries_.begin() + glare::lamp_count;
    auto found = std::find_if(begin, entries_.end(),
                              [&](const Entry& e) { return e.users > 0 && same(e.spectrum, spectrum); });
    if (found == entries_.end()) {
        found = std::find_if(begin, entries_.end(), [](const Entry& e) { return e.users == 0; });
        if (found == entries_.end()) {
            if (entries_.size() > std::numeric_limits<Index>::max())
                throw std::length_error("too many spectra");
            entries_.emplace_back();
            found = entries_.end() - 1;
        }
        *found = {};
        found->colour = spectrum->colour();
        found->own_slot = false;
        found->spectrum = spectrum;
        found->users = 1;
        rebuild();
    } else {
        ++found->users;
    }
    return static_cast<Index>(found - entries_.begin());
}

void LampRegistry::release(Index index) {
    if (index < glare::lamp_count) return;
    Entry& entry = entries_[index];
    if (--entry.users > 0) return;
    entry = {};  // list() keeps the spectrum until the next change: nothing here can run out of memory
}

// Who has a slot keeps it: a pattern must not change because another light was loaded.
void LampRegistry::rebuild() {
    std::array<SharedLamp, glare::most_lamps> slots{};
    for (std::size_t i = glare::lamp_count; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        if (entry.spectrum && entry.own_slot && entry.lamp >= glare::lamp_count)
            slots[entry.lamp] = entry.spectrum;
    }
    strongest_ = 0;
    without_slot_ = 0;
    std::size_t next = glare::lamp_count;
    for (std::size_t i = glare::lamp_count; i < entries_.size(); ++i) {
        Entry& entry = entries_[i];
        if (!entry.spectrum) continue;
        strongest_ = std::max(strongest_, strongest_channel(entry.colour));
        if (entry.own_slot) continue;
        // A named spectrum that is a navigation lamp's needs no second pattern.
        for (int c = 0; c < glare::lamp_count && !entry.own_slot; ++c) {
            if (!(glare::navigation_lamp_spectrum(c) == *entry.spectrum)) continue;
            entry.lamp = static_cast<std::uint8_t>(c);
            entry.own_slot = true;
        }
        while (next < slots.size() && slots[next])
            ++next;
        if (entry.own_slot || next == slots.size()) continue;
        slots[next] = entry.spectrum;
        entry.lamp = static_cast<std::uint8_t>(next);
        entry.own_slot = true;
    }
    list_ = std::any_of(slots.begin(), slots.end(), [](const SharedLamp& s) { return s != nullptr; })
                ? glare::make_lamp_list(slots)
                : nullptr;
    const glare::LampList& list = list_ ? *list_ : glare::navigation_lamps();
    for (Entry& entry : entries_) {
        if (!entry.spectrum || entry.own_slot) continue;
        ++without_slot_;
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t lamp = 0; lamp < list.spectra.size(); ++lamp) {
            if (!list.spectra[lamp]) continue;
            const auto distance =
                static_cast<float>(glare::spectral_distance_nm(*list.spectra[lamp], *entry.spectrum));
            if (distance >= least) continue;
            least = distance;
            entry.lamp = static_cast<std::uint8_t>(lamp);
        }
    }
}

std::size_t LampRegistry::memory_bytes() const {
    const auto spectra = static_cast<std::size_t>(std::count_if(
        entries_.begin(), entries_.end(), [](const Entry& e) { return e.spectrum != nullptr; }));
    return entries_.capacity() * sizeof(Entry) + spectra * sizeof(glare::LampSpectrum) +
           (list_ ? sizeof(glare::LampList) : 0);
}

}  // namespace seaglare::lightdb
