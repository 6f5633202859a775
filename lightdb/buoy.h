// A buoy that swings on the sea. Heave follows the elevation at the mooring, roll and pitch its slope, each as a damped
// linear oscillator. What the waves of the past have left is their steady state, in closed form: the pose is a pure
// function of absolute time, so every channel has the same one and nothing is carried from frame to frame.
#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lightdb/geodesy.h"
#include "lightdb/light_store.h"
#include "lightdb/waves.h"

namespace seaglare::lightdb {

// x'' + 2 damping w0 x' + w0^2 x = w0^2 (what drives it), w0 = 2 pi / period_s.
struct Oscillator {
    double period_s = 0;  // natural, undamped; 0: our default for the buoy's height
    double damping = 0;   // ratio to the critical; 0: our default
    friend bool operator==(const Oscillator&, const Oscillator&) = default;
};

struct Buoy {
    std::string name;
    std::uint32_t body_id =
        0;              // of its lights; its frame has its origin at the waterline on the axis, z up the mast
    Vec3 position_m{};  // of the mooring at the still water's surface, scene
    bool geographic = false;  // position_m follows from latitude and longitude: place_buoy()
    double latitude_deg = 0;
    double longitude_deg = 0;
    double focal_height_m = 4;  // of its light above the water, at rest
    Oscillator heave;
    Oscillator roll;  // and pitch: a buoy is round
    double max_tilt_deg = 60;
    Quaternion upright{0, 0, 0,
                       1};  // scene from the buoy at rest; not the identity far away on a round Earth
    friend bool operator==(const Buoy&, const Buoy&) = default;
};

// What files and hosts may ask for.
inline constexpr double lowest_focal_height_m = 0.1, highest_focal_height_m = 50;
inline constexpr double shortest_buoy_period_s = 0.1, longest_buoy_period_s = 60;
inline constexpr double least_buoy_damping = 0.001, most_buoy_damping = 10;
inline constexpr double steepest_tilt_deg = 89;

// What holds where a buoy leaves an oscillator at 0. Ours, for lack of a general figure: roll as a pendulum of the focal
// height (4.0 s at 4 m), heave as one of half of it (2.8 s), damping 0.1 and 0.3 of critical. Measure your buoys.
Oscillator heave_of(const Buoy& buoy);
Oscillator roll_of(const Buoy& buoy);

// Steady state of the oscillator to a force exp(-i w t): |.| the gain, arg() the phase by which it lags.
std::complex<double> response(const Oscillator& oscillator, double angular_frequency_rad_s);

// The turn of a buoy at rest at a point of the scene, on a round Earth (WGS 84).
Quaternion upright_at(const Vec3& position_m, const GeographicPoint& origin);

// Puts a buoy on the water, upright: a geographic one at its place, another at its east and north.
void place_buoy(Buoy& buoy, const GeographicPoint& origin, Earth earth);

// Where it is and how it leans: towards the trough, by the angle whose tangent is the slope its oscillator has filtered, at
// most max_tilt_deg. It does not turn about its axis. No waves: upright, at rest. A time that is not finite counts as 0.
BodyPose buoy_pose(const Buoy& buoy, std::span<const WaveComponent> waves, double time_s);

// All buoys of a context, with what does not change from frame to frame worked out beforehand.
class BuoyField {
  public:
    void set_waves(std::vector<WaveComponent> waves);
    const std::vector<WaveComponent>& waves() const { return waves_; }
    // A buoy of the same body is replaced.
    void add(const Buoy& buoy);
    bool remove(std::uint32_t body_id);  // false: no such buoy
    void clear();                        // forgets buoys, not the waves
    const Buoy* find(std::uint32_t body_id) const;
    std::size_t size() const { return floats_.size(); }
    // Sets the poses of all buoys: those of buoy_pose(), at one multiplication per buoy and wave.
    void pose(double time_s, LightStore& store);

  private:
    struct Float {
        Buoy buoy;
        std::vector<std::complex<double>> motion;  // heave, slope east, slope north for each wave
    };
    void prepare(Float& one) const;

    std::vector<WaveComponent> waves_;
    std::vector<Float> floats_;                  // by body_id
    std::vector<std::complex<double>> carrier_;  // exp(-i w t) of each wave
    bool at_rest_ = false;                       // no waves, and every pose is set
};

}  // namespace seaglare::lightdb
