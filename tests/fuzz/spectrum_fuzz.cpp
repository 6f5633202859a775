// libFuzzer target: no text crashes the readers of spectra, CSV and IES TM-27-14, and what they read is a spectrum that
// comes back from its own text. What begins with < is XML.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "lightdb/spectrum_file.h"
#include "tests/fuzz/allocation_bound.h"

namespace {

using seaglare::lightdb::SpectrumFileError;
using seaglare::lightdb::SpectrumTable;

// The shortest row of CSV, "9e2,0\n", has six bytes and becomes two doubles, twice while the lists grow; expat keeps its
// own copy of the text and some tables.
constexpr std::size_t bytes_per_input_byte = 32;
constexpr std::size_t constant_bytes = std::size_t{256} << 10;

void hold(bool fact, const char* broken) {
    if (fact) return;
    std::fprintf(stderr, "error: %s\n", broken);
    std::abort();
}

SpectrumTable read(bool xml, std::string_view text) {
    return xml ? seaglare::lightdb::parse_spectrum_spdx(text, "fuzz")
               : seaglare::lightdb::parse_spectrum_csv(text, "fuzz");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    // Files of the corpus begin as their format does.
    const bool xml = data[0] == '<';
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    SpectrumTable table;
    try {
        const seaglare::fuzz::AllocationBound bound(size, bytes_per_input_byte, constant_bytes);
        table = read(xml, text);
    } catch (const SpectrumFileError& error) {
        hold(error.line() > 0 && error.column() > 0 && error.column() <= size + 2, "a place that is none");
        return 0;
    }
    hold(table.wavelength_nm.size() == table.value.size() && table.value.size() >= 2, "rows with holes");
    double before_nm = 0;
    double largest = 0;
    for (std::size_t i = 0; i < table.value.size(); ++i) {
        hold(table.wavelength_nm[i] > before_nm && table.wavelength_nm[i] <= 10000,
             "wavelengths that do not ascend");
        hold(table.value[i] >= 0 && std::isfinite(table.value[i]), "a power that is none");
        before_nm = table.wavelength_nm[i];
        largest = table.value[i] > largest ? table.value[i] : largest;
    }
    hold(largest > 0, "a spectrum without light");
    const SpectrumTable csv =
        seaglare::lightdb::parse_spectrum_csv(seaglare::lightdb::format_spectrum_csv(table), "own");
    hold(csv.wavelength_nm == table.wavelength_nm && csv.value == table.value, "CSV does not come back");
    // A description may hold what XML cannot carry (blanks at its ends); the numbers always come back.
    const SpectrumTable spdx =
        seaglare::lightdb::parse_spectrum_spdx(seaglare::lightdb::format_spectrum_spdx(table), "own");
    hold(spdx.wavelength_nm == table.wavelength_nm && spdx.value == table.value, "TM-27 does not come back");
    return 0;
}
