#include "lightdb/photometric_planes.h"

#include <algorithm>
#include <cmath>

namespace seaglare::lightdb {

namespace {

// Two planes as near as this are one.
constexpr double same_plane_deg = 1e-6;

double in_turn_deg(double angle_deg) {
    double result = std::fmod(angle_deg, 360.0);
    if (result < 0) result += 360;
    return result < 360 - same_plane_deg ? result : 0;
}

// Sorted, each angle once: the plane that the file lists first.
void sort_and_unite(std::vector<Plane>& planes) {
    std::stable_sort(planes.begin(), planes.end(),
                     [](const Plane& a, const Plane& b) { return a.angle_deg < b.angle_deg; });
    const auto same = [](const Plane& a, const Plane& b) {
        return b.angle_deg - a.angle_deg < same_plane_deg;
    };
    planes.erase(std::unique(planes.begin(), planes.end(), same), planes.end());
}

}  // namespace

std::vector<Plane> all_c_planes(std::span<const double> c_deg, PlaneSymmetry symmetry) {
    std::vector<Plane> planes;
    const bool about_0 = symmetry == PlaneSymmetry::plane_0_180 || symmetry == PlaneSymmetry::both_planes;
    const bool about_90 = symmetry == PlaneSymmetry::plane_90_270 || symmetry == PlaneSymmetry::both_planes;
    planes.reserve(c_deg.size() * (symmetry == PlaneSymmetry::both_planes ? 4
                                   : symmetry == PlaneSymmetry::none      ? 1
                                                                          : 2));
    for (std::size_t i = 0; i < c_deg.size(); ++i) {
        planes.push_back({in_turn_deg(c_deg[i]), i});
        if (about_0) planes.push_back({in_turn_deg(-c_deg[i]), i});
        if (about_90) planes.push_back({in_turn_deg(180 - c_deg[i]), i});
        if (about_0 && about_90) planes.push_back({in_turn_deg(180 + c_deg[i]), i});
    }
    sort_and_unite(planes);
    return planes;
}

PhotometricSolid solid_of_vertical_planes(std::vector<Plane> planes, bool whole_turn,
                                          std::vector<double> elevation_deg,
                                          std::span<const double> candela) {
    PhotometricSolid solid;
    solid.whole_turn = whole_turn;
    if (whole_turn) {
        for (Plane& plane : planes)
            plane.angle_deg = in_turn_deg(plane.angle_deg);
        sort_and_unite(planes);
    }
    solid.latitude_deg = std::move(elevation_deg);
    const std::size_t height = solid.latitude_deg.size();
    solid.azimuth_deg.reserve(planes.size());
    solid.candela.reserve(planes.size() * height);
    for (const Plane& plane : planes) {
        solid.azimuth_deg.push_back(plane.angle_deg);
        const std::span<const double> column = candela.subspan(plane.column * height, height);
        solid.candela.insert(solid.candela.end(), column.begin(), column.end());
    }
    finish(solid);
    return solid;
}

void finish(PhotometricSolid& solid) {
    solid.reference_cd = reference_of(solid);
}

}  // namespace seaglare::lightdb
