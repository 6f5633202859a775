// All lights, for one eye at one instant: from the database to point sources with their illuminance at the
// eye. Every light left out is counted with its reason.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "glare/frame.h"
#include "lightdb/light_marks.h"
#include "lightdb/light_store.h"

namespace seaglare::lightdb {

struct Observer {
    std::array<double, 3> eye_m{};  // East-North-Up of the scene
    std::array<double, 16>
        view_from_scene{};  // column-major, rigid (a reflection is allowed: left-handed hosts)
    double time_s = 0;
    double exposure_s = 1.0 / 60;  // rhythms are averaged over it; at most 0.05 is used
    double extinction_per_m = 0;   // rho = -ln 0.05 / V_met; 0: clear
    bool is_day = false;           // photometers are off, lamps have their intensity by day: see daylight.h
    // Below it no light can change the picture, alone: a source with less, all colours together, is left out. 0:
    // everything that a float can hold counts.
    double least_illuminance_lx = 0;
    // Nor are crowds left out that give more together: then the threshold is lowered until what it leaves out gives less.
    double most_left_out_lx = std::numeric_limits<double>::infinity();
    bool geographic_horizon = true;  // a light below its geographical range is not seen
    bool round_earth = false;  // the scene's sea curves down from the tangent plane: heights above it follow
    double water_level_m = 0;  // z of the water at the scene's origin
    std::uint64_t seed = 0;
};

struct Evaluated {
    std::vector<glare::PointSource> sources;
    std::vector<LightIndex> light;  // which light each source is; parallel to `sources`, ascending
    // Live lights = sources + dark + below_horizon + too_faint. The spatial index leaves out groups of lights with
    // the reason that holds for the whole group, so that of two reasons that hold for a light the other may be told.
    std::uint32_t total = 0;
    std::uint32_t dark =
        0;  // off, eclipsed, out of sector or profile, photometer, underflown in fog, not finite
    std::uint32_t below_horizon = 0;
    std::uint32_t too_faint = 0;  // under least_illuminance_lx; where that is 0 such lights count as dark
    // At least what those that are too faint give at the eye together, in lux, with their sectors and rhythms at their
    // brightest: so crowds of them are not left out unseen.
    double too_faint_lx = 0;
    LightMarks marks;  // kept for its memory
};

enum class Culling { by_index, one_by_one };

// Illuminance at the eye by the chain I h v b T / max(D, r)^2: intensity, sector, vertical profile, rhythm
// over the exposure, air, distance. A light of a body that was never posed stands at the scene's origin with
// it. Sources come in the order of their slots, whatever became of the lights before: equal stores give equal
// pictures to the last bit. Reuses the capacity of `out`: no allocation in a steady frame. Never throws, never gives
// a value that is not finite. Looking at lights one by one gives the same sources (where no crowd
// lowers the threshold: the index knows only a bound of what it leaves out): it is there to compare with.
void evaluate(const LightStore& store, const Observer& observer, Evaluated& out,
              Culling culling = Culling::by_index);

// What one light sends towards the eye before air, distance and horizon: candela of each colour. For tools
// and tests.
std::array<double, colour_count> intensity_towards_cd(const LightStore& store, const Light& light,
                                                      const Observer& observer);

// Where a light is in the scene: its position, or its body's pose applied to it.
std::array<double, 3> scene_position_m(const LightStore& store, const Light& light);
std::array<double, 3> scene_position_m(const LightStore& store, LightIndex slot);

}  // namespace seaglare::lightdb
