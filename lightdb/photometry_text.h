// Lines and numbers of a photometric file, each of which knows where it stood: for the readers of LM-63 and EULUMDAT.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seaglare::lightdb {

// A cursor over the text, which must outlive it. Lines end with LF, CR LF or CR. Numbers stand between blanks, anywhere on
// the lines that follow.
class PhotometryText {
  public:
    // What parts numbers beside blanks: in LM-63 a comma does, in EULUMDAT a comma may be a decimal point.
    enum class Comma : std::uint8_t { parts_numbers, decimal_point };

    PhotometryText(std::string_view text, std::string file, Comma comma);

    bool at_end() const { return at_ >= text_.size(); }
    // The rest of the line the cursor stands in, without its end; the cursor moves to the next. Fails at the end of the text.
    std::string_view line(std::string_view what);
    // The number that a line of its own holds; a blank line is `blank`, or fails where there is no such value.
    double line_number(std::string_view what, std::optional<double> blank = std::nullopt);

    double number(std::string_view what);  // the next one; finite, or it fails
    double number(std::string_view what, double min, double max);
    std::size_t count(std::string_view what, std::size_t min);  // a whole number
    // So many numbers, each above the one before it. Checks that the text is long enough before it makes room for them.
    std::vector<double> ascending(std::size_t how_many, std::string_view what, double min, double max);
    // Fails if the rest of the text is too short for so many numbers.
    void check_room(double how_many, std::string_view what) const;
    void expect_end(std::string_view what);  // nothing but blanks may follow

    // Throws PhotometryFileError at what was read last.
    [[noreturn]] void fail(const std::string& text) const;
    std::string warning(const std::string& text) const;  // "FILE:LINE: text", of what was read last
    const std::string& file() const { return file_; }

  private:
    std::string_view token();
    double parsed(std::string_view token, std::string_view what) const;

    std::string_view text_;
    std::string file_;
    Comma comma_;
    std::size_t at_ = 0;
    std::size_t last_ = 0;  // where the last line or number began
};

// Without blanks at its ends.
std::string_view trimmed(std::string_view text);

// A number for messages: "90", "0.5".
std::string short_number(double value);

}  // namespace seaglare::lightdb
