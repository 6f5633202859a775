// What holds for every photometric file that was read, of whichever format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "lightdb/photometry_file.h"
#include "tests/fuzz/allocation_bound.h"

namespace seaglare::fuzz {

// A candela is written in two bytes ("0 ") and becomes a double: 4 for each byte, twice while its list grows, and once
// more when planes are mirrored, up to four times as many ("symmetric" files give a quarter of the sphere); the angles
// likewise. Keywords are strings of their text.
inline constexpr std::size_t photometry_bytes_per_input_byte = 128;
inline constexpr std::size_t photometry_constant_bytes = std::size_t{64} << 10;

template <class Parse>
void check_photometry(const std::uint8_t* data, std::size_t size, const Parse& parse) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    lightdb::PhotometryFile file;
    try {
        const AllocationBound bound(size, photometry_bytes_per_input_byte, photometry_constant_bytes);
        file = parse(text);
    } catch (const lightdb::PhotometryFileError& error) {
        if (error.line() == 0 || error.column() == 0 || error.column() > size + 1) std::abort();
        return;
    }
    const auto hold = [](bool fact, const char* broken) {
        if (fact) return;
        std::fprintf(stderr, "error: %s\n", broken);
        std::abort();
    };
    hold(file.solid != nullptr, "a file without a solid");
    const lightdb::PhotometricSolid& solid = *file.solid;
    const std::size_t columns = solid.latitude_deg.size();
    hold(columns >= 2 && !solid.azimuth_deg.empty(), "a grid without angles");
    hold(solid.candela.size() == columns * solid.azimuth_deg.size(), "a grid with holes");
    for (std::size_t i = 1; i < columns; ++i)
        hold(solid.latitude_deg[i] > solid.latitude_deg[i - 1], "latitudes that do not ascend");
    for (std::size_t i = 1; i < solid.azimuth_deg.size(); ++i)
        hold(solid.azimuth_deg[i] > solid.azimuth_deg[i - 1], "azimuths that do not ascend");
    hold(solid.latitude_deg.front() >= -90.000001 && solid.latitude_deg.back() <= 90.000001,
         "beyond the poles");
    for (const double candela : solid.candela)
        hold(candela >= 0 && candela <= 1e300, "a candela that is none");
    hold(solid.reference_cd > 0 && solid.reference_cd <= 1e300, "nothing to divide by");
    // Between the samples nothing exceeds them.
    double largest_cd = 0;
    for (const double candela : solid.candela)
        largest_cd = candela > largest_cd ? candela : largest_cd;
    for (int azimuth_deg = -400; azimuth_deg <= 400; azimuth_deg += 100) {
        for (int latitude_deg = -90; latitude_deg <= 90; latitude_deg += 45) {
            const double candela = lightdb::candela_at(solid, azimuth_deg, latitude_deg);
            hold(candela >= 0 && candela <= largest_cd * (1 + 1e-9), "more light than was measured");
        }
    }
}

}  // namespace seaglare::fuzz
