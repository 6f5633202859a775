// From the planes of a photometric file, which may state only a half or a quarter of a symmetric lantern, to the whole
// solid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightdb/photometric_solid.h"

namespace seaglare::lightdb {

// A measured plane and where it stands.
struct Plane {
    double angle_deg = 0;
    std::size_t column = 0;  // which plane of the file
};

// Planes that mirror each other: the file states one side of the plane named.
enum class PlaneSymmetry : std::uint8_t { none, plane_0_180, plane_90_270, both_planes };

// All planes of the turn, ascending from 0, below 360 degrees, each once: C angles in degrees, ascending, with the mirrored
// ones that the symmetry adds. 360 is 0.
std::vector<Plane> all_c_planes(std::span<const double> c_deg, PlaneSymmetry symmetry);

// The solid of vertical planes about the up axis. `plane` holds bearings from ahead, clockwise, in any turn; `candela` is
// [column][elevation]. An arc's planes are given ascending, those of a whole turn in any order.
PhotometricSolid solid_of_vertical_planes(std::vector<Plane> planes, bool whole_turn,
                                          std::vector<double> elevation_deg, std::span<const double> candela);

// Sets reference_cd. Makes a finished solid of one whose grid is filled.
void finish(PhotometricSolid& solid);

}  // namespace seaglare::lightdb
