// Photometric files as makers of lanterns hand them out: ANSI/IES LM-63 (.ies; 1986, 1991, 1995, 2002, 2019) and
// EULUMDAT (.ldt; Stockmar 1990).
//
// How their angles lie in a light's own frame, x to starboard, y ahead and z up:
//   LM-63 Type C and EULUMDAT: the vertical angle is 0 straight down, 90 in the horizontal plane, 180 straight up, so
//     elevation = gamma - 90. Horizontal angle (C plane) 0 is ahead; both count anticlockwise seen from above, so
//     bearing from ahead = -C.
//   LM-63 Type A: (0, 0) is ahead; horizontal angles count clockwise and are the bearing, vertical ones the elevation.
//   LM-63 Type B: (0, 0), the axis of the beam, is ahead; vertical angles turn upwards about the starboard axis,
//     horizontal ones lie in the plane so turned and count towards starboard. (LM-63 hangs a Type B luminaire with its
//     beam straight down; a beacon's beam is aimed at the horizon.)
// A lantern mounted another way is turned by the light's `orientation`.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightdb/photometric_solid.h"

namespace seaglare::lightdb {

// What is wrong with a photometric file. what() is "FILE:LINE:COLUMN: text", both from 1, columns in bytes.
class PhotometryFileError : public std::runtime_error {
  public:
    PhotometryFileError(std::string_view file, std::size_t line, std::size_t column, std::string_view text);
    std::size_t line() const { return line_; }
    std::size_t column() const { return column_; }

  private:
    std::size_t line_;
    std::size_t column_;
};

// A file that was read. For a light that has neither intensity nor range of its own, `solid->reference_cd` is its
// intensity: then the file's candela hold exactly. For one that has, the file gives only the shape: its candela are
// divided by reference_cd.
struct PhotometryFile {
    std::shared_ptr<const PhotometricSolid> solid;
    std::string name;         // of the luminaire; may be empty
    double lamp_flux_lm = 0;  // of all its lamps together as the file states it; 0: absolute photometry
    std::vector<std::pair<std::string, std::string>>
        keywords;                       // LM-63: "MANUFAC" and its text, in the file's order
    std::vector<std::string> warnings;  // FILE:LINE: text, of what was read but looks odd
};

inline constexpr std::size_t largest_photometry_file_bytes = 64U << 20U;

// Reads a file; its content says which format it is, and its name where that leaves it open. Throws PhotometryFileError
// for what is wrong inside, std::system_error when it cannot be read. Memory stays within a small multiple of the
// file's size whatever counts it states.
PhotometryFile load_photometry_file(const std::string& path);

// The same from text; `file` is its name in messages and in the solid.
PhotometryFile parse_photometry(std::string_view text, const std::string& file);

// One format, without looking which it is.
PhotometryFile parse_ies(std::string_view text, const std::string& file);
PhotometryFile parse_eulumdat(std::string_view text, const std::string& file);

}  // namespace seaglare::lightdb
