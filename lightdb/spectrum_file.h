// Tables of spectra from files: CSV, and IES TM-27-14 (.spdx), the format in which laboratories hand out measured lamps.
//
// CSV: a row is a wavelength in nm and a relative power, apart by a comma, semicolon or tab. Empty lines and lines that
// begin with # are skipped; the first row may be a header.
// TM-27-14: XML with the root IESTM2714; its SpectralData elements are the rows. The rest of the standard (header,
// bandwidth, geometry) says where a measurement comes from and is passed over, but for SpectralQuantity.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace seaglare::lightdb {

// What is wrong with a spectrum file. what() is "FILE:LINE:COLUMN: text", both from 1, columns in bytes.
class SpectrumFileError : public std::runtime_error {
  public:
    SpectrumFileError(std::string_view file, std::size_t line, std::size_t column, std::string_view text);
    std::size_t line() const { return line_; }
    std::size_t column() const { return column_; }

  private:
    std::size_t line_;
    std::size_t column_;
};

// What its numbers are. CSV does not say.
enum class SpectralQuantity : std::uint8_t { unknown, power, transmittance };

struct SpectrumTable {
    std::vector<double> wavelength_nm;  // ascending, 100 ... 10 000
    std::vector<double> value;          // as many, at least two, finite and >= 0, not all 0
    SpectralQuantity quantity = SpectralQuantity::unknown;
    std::string description;  // of a .spdx file; may be empty
    friend bool operator==(const SpectrumTable&, const SpectrumTable&) = default;
};

inline constexpr std::size_t largest_spectrum_file_bytes = std::size_t{4} << 20;
inline constexpr double shortest_wavelength_nm = 100;
inline constexpr double longest_wavelength_nm = 10000;

// Whether a name ends as a table's does: .csv or .spdx, in small or capital letters.
bool is_spectrum_table_name(std::string_view name);

// Reads a table; the name's ending says which format it is. Throws SpectrumFileError for what is wrong inside,
// std::system_error when it cannot be read or is larger than largest_spectrum_file_bytes (EFBIG). Memory stays within a
// small multiple of the file's size.
SpectrumTable load_spectrum_table(const std::string& path);

// The same from text; `file` is its name in messages.
SpectrumTable parse_spectrum_csv(std::string_view text, const std::string& file);
// A document with a DOCTYPE is refused: entities that grow, and files that it would fetch, have no place in a spectrum.
SpectrumTable parse_spectrum_spdx(std::string_view text, const std::string& file);

// Texts that the two take back to the last bit (CSV knows neither quantity nor description).
std::string format_spectrum_csv(const SpectrumTable& table);
std::string format_spectrum_spdx(const SpectrumTable& table);

}  // namespace seaglare::lightdb
