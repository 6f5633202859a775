// A light as the shaders read it: eight texels of four floats. What can be said once per light and frame is said here,
// in double precision; the shaders only do what differs per pixel. Pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "glare/apply/fine_reach.h"
#include "glare/apply/screen_geometry.h"
#include "glare/frame.h"
#include "glare/psf/pattern.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

using RectPx = std::array<float, 4>;  // left, bottom, right, top in the viewport; empty when right <= left

struct LightInstance {
    std::array<float, 3> direction{};  // unit, view space
    float distance_m = 0;
    std::array<float, 4> illuminance{};  // linear sRGB lux, scotopic lux
    float disc_chord = 0;                // apparent radius as chord of the unit sphere, 2 sin(angle/2)
    float disc_nodes = 0;                // the same as sin(angle) in nodes of the pattern
    float fade_start = 0;  // sin(angle) where full resolution starts to hand over to the coarse grid
    float fade_end = 0;
    RectPx skirt_rect{};
    RectPx tail_rect{};
    RectPx core_rect{};
    std::array<float, 2> centre_px{};
    float disc_px = 0;
    float lamp_slot = 0;                  // of the pattern
    std::array<float, 4> px_from_disc{};  // pixels per disc radius along the pattern's u, then v
};
static_assert(sizeof(LightInstance) == 8 * 16);

struct ReachSettings {
    double threshold_cd_m2 = 0;       // what one light may lose at full resolution
    double tail_threshold_cd_m2 = 0;  // the same on the coarse grid, where omissions of many lights add up
    int cell_px = 8;
    bool tails = true;                // false: none is drawn
    const FineReach* fine = nullptr;  // of the pattern; null: its finer nodes are drawn as far as they reach
    double disc_scale = 1;            // what the skirt takes the lamp's apparent disc for
};

// Of the coarse grid for the tail: as coarse as the pattern's window allows, 1 ... 8 px.
int coarse_cell_px(const ScreenGeometry& geometry, const Pattern& pattern);

// Appends one instance per source, and its tag; sources that touch no pixel are left out. Returns the pixels touched by any
// of them.
PixelRect append_instances(const ScreenGeometry& geometry, const Pattern& pattern, const ReachSettings& reach,
                           std::span<const PointSource> sources, std::vector<LightInstance>& instances,
                           std::vector<std::uint32_t>* tags = nullptr);

// The largest amount, in lux, by which a light could move a display channel: rod brightness counts as white.
double channel_bound_lx(const PointSource& source);

// Direction of a source and its apparent angular radius: at most a quarter turn, also with the eye inside the lamp.
struct Appearance {
    Vec3 direction{};
    double distance_m = 0;
    double radius_rad = 0;
};
// False when the position or an illuminance is not finite, or it gives no light.
bool appearance_of(const ScreenGeometry& geometry, const PointSource& source, Appearance& appearance);

}  // namespace seaglare::glare
