// Spectra as CSV; what a row is: spectrum_file.h.
#include "lightdb/spectrum_rows.h"

#include <algorithm>

namespace seaglare::lightdb {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// A field, and where it begins in its line.
struct Field {
    std::string_view text;
    std::size_t column = 1;
};

class CsvReader {
  public:
    CsvReader(std::string_view text, const std::string& file) : text_(text), rows_(file) {}

    SpectrumTable read() {
        if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
        for (place_.line = 1; at_ < text_.size(); ++place_.line)
            read_line(next_line());
        return rows_.finished({place_.line, 1});
    }

  private:
    std::string_view next_line() {
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        const std::string_view line = text_.substr(at_, end - at_);
        at_ = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
        return line;
    }

    void read_line(std::string_view line) {
        const std::string_view content = without_blanks(line);
        if (content.empty() || content.front() == '#') return;
        const std::size_t begin = static_cast<std::size_t>(content.data() - line.data());
        const std::size_t gap = content.find_first_of(",;\t");
        const Field first = field(content.substr(0, gap), begin);
        double wavelength_nm = 0;
        const bool is_number = number_from(first.text, wavelength_nm);
        if (!is_number && !had_row_) {
            had_row_ = true;  // a header, once
            return;
        }
        had_row_ = true;
        if (!is_number) refuse(first.column, "'" + brief(first.text) + "' is not a number of nanometres");
        if (gap == std::string_view::npos)
            refuse(begin + content.size() + 1,
                   "a value is missing: a row is a wavelength in nm, a comma and a power");
        const Field second = field(content.substr(gap + 1), begin + gap + 1);
        const std::size_t more = second.text.find_first_of(",;\t");
        if (more != std::string_view::npos)
            refuse(second.column + more, "a third column: a row is a wavelength in nm and one power");
        double value = 0;
        if (!number_from(second.text, value))
            refuse(second.column, "'" + brief(second.text) + "' is not a number");
        rows_.add(wavelength_nm, {place_.line, first.column}, value, {place_.line, second.column});
    }

    // `begin` counts from 0 in the line.
    static Field field(std::string_view text, std::size_t begin) {
        const std::string_view content = without_blanks(text);
        if (content.empty()) return {content, begin + 1};
        return {content, begin + static_cast<std::size_t>(content.data() - text.data()) + 1};
    }
    static std::string brief(std::string_view text) {
        constexpr std::size_t most = 40;
        return text.size() <= most ? std::string(text) : std::string(text.substr(0, most)) + "…";
    }
    [[noreturn]] void refuse(std::size_t column, const std::string& text) const {
        rows_.refuse({place_.line, column}, text);
    }

    std::string_view text_;
    SpectrumRows rows_;
    TextPlace place_;
    std::size_t at_ = 0;
    bool had_row_ = false;
};

}  // namespace

SpectrumTable parse_spectrum_csv(std::string_view text, const std::string& file) {
    return CsvReader(text, file).read();
}

}  // namespace seaglare::lightdb
