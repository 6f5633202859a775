// The rows of a spectrum file as they come, checked one by one. Internal to lightdb/spectrum_*.cpp.
#pragma once

#include <string>
#include <string_view>

#include "lightdb/spectrum_file.h"

namespace seaglare::lightdb {

// Where in a file something stands, both from 1.
struct TextPlace {
    std::size_t line = 1;
    std::size_t column = 1;
};

// Without blanks at either end.
std::string_view without_blanks(std::string_view text);
// A whole text as a finite number. False: it is none.
bool number_from(std::string_view text, double& number);

class SpectrumRows {
  public:
    explicit SpectrumRows(std::string file) : file_(std::move(file)) {}

    // Throw SpectrumFileError at the place.
    void add(double wavelength_nm, TextPlace wavelength_place, double value, TextPlace value_place);
    // At the end: are they a spectrum?
    SpectrumTable finished(TextPlace end);
    [[noreturn]] void refuse(TextPlace place, std::string_view text) const;

    SpectrumTable table;

  private:
    std::string file_;
    double largest_ = 0;
};

}  // namespace seaglare::lightdb
