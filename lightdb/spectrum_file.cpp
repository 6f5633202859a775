#include "lightdb/spectrum_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "lightdb/spectrum_rows.h"
#include "lightdb/text_file.h"

namespace seaglare::lightdb {

namespace {

std::string shown(double number) {
    std::array<char, 40> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') {
            result += "&amp;";
        } else if (c == '<') {
            result += "&lt;";
        } else if (c == '>') {
            result += "&gt;";
        } else {
            result += c;
        }
    }
    return result;
}

}  // namespace

SpectrumFileError::SpectrumFileError(std::string_view file, std::size_t line, std::size_t column,
                                     std::string_view text)
    : std::runtime_error(std::string(file) + ":" + std::to_string(line) + ":" + std::to_string(column) +
                         ": " + std::string(text)),
      line_(line),
      column_(column) {}

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

bool number_from(std::string_view text, double& number) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    return failed == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}

void SpectrumRows::refuse(TextPlace place, std::string_view text) const {
    throw SpectrumFileError(file_, place.line, place.column, text);
}

void SpectrumRows::add(double wavelength_nm, TextPlace wavelength_place, double value,
                       TextPlace value_place) {
    if (wavelength_nm >= 0.1 && wavelength_nm < 10) {
        refuse(wavelength_place, "wavelength " + shown(wavelength_nm) +
                                     " is less than 100 nm: is it in micrometres? Nanometres are needed");
    }
    if (!(wavelength_nm >= shortest_wavelength_nm && wavelength_nm <= longest_wavelength_nm)) {
        refuse(wavelength_place, "wavelength " + shown(wavelength_nm) + " is not from 100 to 10000 nm");
    }
    if (!table.wavelength_nm.empty() && wavelength_nm == table.wavelength_nm.back())
        refuse(wavelength_place, "wavelength " + shown(wavelength_nm) + " nm stands twice");
    if (!table.wavelength_nm.empty() && wavelength_nm < table.wavelength_nm.back()) {
        refuse(wavelength_place, "wavelength " + shown(wavelength_nm) + " nm comes after " +
                                     shown(table.wavelength_nm.back()) + " nm: they must ascend");
    }
    if (!(value >= 0)) refuse(value_place, "a spectrum has no negative values, but here is " + shown(value));
    table.wavelength_nm.push_back(wavelength_nm);
    table.value.push_back(value);
    largest_ = std::max(largest_, value);
}

SpectrumTable SpectrumRows::finished(TextPlace end) {
    if (table.value.size() < 2)
        refuse(end, "a spectrum needs two wavelengths, and here is " + std::to_string(table.value.size()));
    if (largest_ == 0) refuse(end, "the spectrum is 0 everywhere");
    return std::move(table);
}

bool is_spectrum_table_name(std::string_view name) {
    return ends_with_ignoring_case(name, ".csv") || ends_with_ignoring_case(name, ".spdx");
}

SpectrumTable load_spectrum_table(const std::string& path) {
    const std::string text = read_text_file(path, largest_spectrum_file_bytes);
    return ends_with_ignoring_case(path, ".spdx") ? parse_spectrum_spdx(text, path)
                                                  : parse_spectrum_csv(text, path);
}

std::string format_spectrum_csv(const SpectrumTable& table) {
    std::string text = "wavelength_nm,relative_power\n";
    for (std::size_t i = 0; i < table.value.size(); ++i)
        text += shown(table.wavelength_nm[i]) + "," + shown(table.value[i]) + "\n";
    return text;
}

std::string format_spectrum_spdx(const SpectrumTable& table) {
    const char* const quantity = table.quantity == SpectralQuantity::transmittance ? "transmittance"
                                 : table.quantity == SpectralQuantity::power       ? "flux"
                                                                                   : "relative";
    std::string text =
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
        "<IESTM2714 xmlns=\"http://www.ies.org/iestm2714\" version=\"1.0\">\n"
        "  <Header>\n    <Description>" +
        escaped(table.description) +
        "</Description>\n  </Header>\n  <SpectralDistribution>\n    <SpectralQuantity>" + quantity +
        "</SpectralQuantity>\n";
    for (std::size_t i = 0; i < table.value.size(); ++i) {
        text += "    <SpectralData wavelength=\"" + shown(table.wavelength_nm[i]) + "\">" +
                shown(table.value[i]) + "</SpectralData>\n";
    }
    return text + "  </SpectralDistribution>\n</IESTM2714>\n";
}

}  // namespace seaglare::lightdb
