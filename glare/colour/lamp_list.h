// Which spectra have a glare pattern of their own: what the light database tells the pattern sources.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "glare/colour/lamp_spectrum.h"

namespace seaglare::glare {

// By lamp index. The first lamp_count are the navigation colours', for ever; the others are named spectra, and null where
// no light has one. Never changed once it is made: a change is a new list with a new version.
struct LampList {
    std::uint64_t version = 0;  // of no other list in this process; 0: navigation colours alone
    std::array<std::shared_ptr<const LampSpectrum>, most_lamps> spectra{};
    // spectral_distance_nm between lamps; between lamps that do not exist 0.
    std::array<std::array<float, most_lamps>, most_lamps> distance_nm{};
};

// Fills in version and distances. Any thread.
std::shared_ptr<const LampList> make_lamp_list(
    const std::array<std::shared_ptr<const LampSpectrum>, most_lamps>& spectra);

// The navigation colours alone; lives as long as the process.
const LampList& navigation_lamps();

// Of the lamps of `mask` the `most` that get a pattern of their own, lowest index first: which that are depends on nothing
// but what is in view, so that every channel decides alike.
std::uint32_t lamps_with_own_pattern(std::uint32_t mask, int most);
// The lamp of `mask` whose spectrum is nearest to that of `lamp`; the lowest of those equally near, 0 for an empty mask.
int nearest_lamp(const LampList& list, std::uint32_t mask, int lamp);

}  // namespace seaglare::glare
