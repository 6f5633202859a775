#include "lightdb/photometry_file.h"

#include "lightdb/photometry_text.h"
#include "lightdb/text_file.h"

namespace seaglare::lightdb {

namespace {

// A line that begins with TILT= is in every LM-63 file and in no other.
bool has_tilt_line(std::string_view text) {
    for (std::size_t at = text.find("TILT="); at != std::string_view::npos; at = text.find("TILT=", at + 1)) {
        std::size_t begin = at;
        while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t'))
            --begin;
        if (begin == 0 || text[begin - 1] == '\n' || text[begin - 1] == '\r') return true;
    }
    return false;
}

// The third line of a EULUMDAT file is the one digit of its symmetry.
bool has_symmetry_line(std::string_view text, const std::string& file) {
    PhotometryText lines(text, file, PhotometryText::Comma::decimal_point);
    for (int i = 0; i < 2; ++i) {
        if (lines.at_end()) return false;
        lines.line("");
    }
    if (lines.at_end()) return false;
    const std::string_view symmetry = trimmed(lines.line(""));
    return symmetry.size() == 1 && symmetry.front() >= '0' && symmetry.front() <= '4';
}

}  // namespace

PhotometryFileError::PhotometryFileError(std::string_view file, std::size_t line, std::size_t column,
                                         std::string_view text)
    : std::runtime_error(std::string(file) + ":" + std::to_string(line) + ":" + std::to_string(column) +
                         ": " + std::string(text)),
      line_(line),
      column_(column) {}

PhotometryFile parse_photometry(std::string_view text, const std::string& file) {
    if (text.substr(0, 5) == "IESNA" || text.substr(0, 4) == "IES:" || has_tilt_line(text))
        return parse_ies(text, file);
    if (ends_with_ignoring_case(file, ".ies")) return parse_ies(text, file);
    if (ends_with_ignoring_case(file, ".ldt") || has_symmetry_line(text, file))
        return parse_eulumdat(text, file);
    throw PhotometryFileError(file, 1, 1,
                              "neither an LM-63 file, which has a line TILT=, nor a EULUMDAT file");
}

PhotometryFile load_photometry_file(const std::string& path) {
    return parse_photometry(read_text_file(path, largest_photometry_file_bytes), path);
}

}  // namespace seaglare::lightdb
