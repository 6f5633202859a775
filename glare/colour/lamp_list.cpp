#include "glare/colour/lamp_list.h"

#include <atomic>
#include <limits>

namespace seaglare::glare {

namespace {

void fill_distances(LampList& list) {
    for (std::size_t a = 0; a < most_lamps; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            if (!list.spectra[a] || !list.spectra[b]) continue;
            const auto distance =
                static_cast<float>(spectral_distance_nm(*list.spectra[a], *list.spectra[b]));
            list.distance_nm[a][b] = list.distance_nm[b][a] = distance;
        }
    }
}

void add_navigation_lamps(LampList& list) {
    for (int lamp = 0; lamp < lamp_count; ++lamp) {
        list.spectra[static_cast<std::size_t>(lamp)] =
            std::make_shared<const LampSpectrum>(navigation_lamp_spectrum(lamp));
    }
}

}  // namespace

std::shared_ptr<const LampList> make_lamp_list(
    const std::array<std::shared_ptr<const LampSpectrum>, most_lamps>& spectra) {
    static std::atomic<std::uint64_t> last{0};
    auto list = std::make_shared<LampList>();
    list->version = last.fetch_add(1, std::memory_order_relaxed) + 1;
    list->spectra = spectra;
    add_navigation_lamps(*list);
    fill_distances(*list);
    return list;
}

const LampList& navigation_lamps() {
    static const LampList list = [] {
        LampList made;
        add_navigation_lamps(made);
        fill_distances(made);
        return made;
    }();
    return list;
}

std::uint32_t lamps_with_own_pattern(std::uint32_t mask, int most) {
    std::uint32_t kept = 0;
    for (std::uint32_t bit = 1; bit != 0 && most > 0; bit <<= 1U) {
        if ((mask & bit) == 0) continue;
        kept |= bit;
        --most;
    }
    return kept;
}

int nearest_lamp(const LampList& list, std::uint32_t mask, int lamp) {
    const auto& distances = list.distance_nm[static_cast<std::size_t>(lamp)];
    int nearest = 0;
    float least = std::numeric_limits<float>::infinity();
    for (int other = 0; other < most_lamps; ++other) {
        if ((mask >> static_cast<unsigned>(other) & 1U) == 0) continue;
        if (distances[static_cast<std::size_t>(other)] >= least) continue;
        least = distances[static_cast<std::size_t>(other)];
        nearest = other;
    }
    return nearest;
}

}  // namespace seaglare::glare
