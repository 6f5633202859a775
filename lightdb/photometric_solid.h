// Candela over the whole sphere around a light, as a goniophotometer measured it and a photometric file hands it on.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seaglare::lightdb {

// A grid on the sphere: azimuth about an axis, latitude from the plane across that axis towards it. In the light's own
// frame (x to starboard, y ahead, z up):
//   axis up         azimuth is the bearing from ahead, clockwise seen from above; latitude is the elevation.
//                   direction = (cos lat sin az, cos lat cos az, sin lat)
//   axis starboard  azimuth turns from ahead upwards about the starboard axis; latitude runs towards starboard.
//                   direction = (sin lat, cos lat cos az, cos lat sin az)
// Between the samples candela is linear in both angles, as photometric files mean it. Beyond the latitudes and azimuths
// that the grid has, nothing was measured and the light is dark.
struct PhotometricSolid {
    enum class Axis : std::uint8_t { up, starboard };

    Axis axis = Axis::up;
    std::vector<double> azimuth_deg;   // ascending, within one turn; one sample: the same all round
    std::vector<double> latitude_deg;  // ascending, -90 ... 90, at least two
    std::vector<double> candela;       // [azimuth][latitude], >= 0
    // The azimuths go all round: between the last and the first it runs on through 360 degrees. Else an arc.
    bool whole_turn = true;
    // What a light's own intensity stands for: the largest candela in the light's horizontal plane, where intensities
    // and ranges of navigation lights are stated. Where that is under a hundredth of the largest of all (a lamp made to
    // shine up or down) the largest of all. > 0.
    double reference_cd = 0;
    std::optional<double>
        radius_m;      // of a disc as large as the luminous opening; nothing: the file gives none
    std::string file;  // path it was loaded from: where it came from, not what it is
};

// Equal grids and values. Not the file's name: a copy elsewhere is the same light.
bool operator==(const PhotometricSolid& a, const PhotometricSolid& b);

// A solid that many lights share, compared by what it holds.
class SharedSolid {
  public:
    SharedSolid() = default;
    SharedSolid(std::shared_ptr<const PhotometricSolid> solid) : solid_(std::move(solid)) {}
    explicit operator bool() const { return solid_ != nullptr; }
    const PhotometricSolid& operator*() const { return *solid_; }
    const PhotometricSolid* operator->() const { return solid_.get(); }
    const PhotometricSolid* get() const { return solid_.get(); }
    friend bool operator==(const SharedSolid& a, const SharedSolid& b) {
        return a.solid_ == b.solid_ || (a.solid_ && b.solid_ && *a.solid_ == *b.solid_);
    }

  private:
    std::shared_ptr<const PhotometricSolid> solid_;
};

// Candela at angles of the grid, in degrees; azimuth in any turn. 0 outside of the grid and for what is not finite.
double candela_at(const PhotometricSolid& solid, double azimuth_deg, double latitude_deg);

// Candela in a direction of the light's own frame, of any length. Length 0 or not finite: 0. Straight along the axis the
// azimuth is 0.
double candela_towards(const PhotometricSolid& solid, const std::array<double, 3>& direction);

// Luminous flux in lumens: candela over the solid angle, by the exact integral of what candela_at() interpolates.
double flux_lm(const PhotometricSolid& solid);

// The part of it below the light's horizontal plane. Of a solid about the up axis.
double flux_below_horizon_lm(const PhotometricSolid& solid);

// The value for reference_cd: see there. 0 when the solid is dark all over.
double reference_of(const PhotometricSolid& solid);

}  // namespace seaglare::lightdb
