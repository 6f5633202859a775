// The plain data that cross from the light database into the glare renderer: one frame, and the point sources that
// reach the eye in it. `glare` draws point sources and knows no navigation light.
#pragma once

#include <array>
#include <cstdint>

namespace seaglare::glare {

// One light as it arrives at the eye. View space: x right, y up, metres, the eye at the origin; the sign of z is the
// host's (its projection matrix says which way is ahead).
struct PointSource {
    std::array<float, 3> position_view_m{};
    float radius_m = 0;
    // Illuminance at the eye, in lux, as linear sRGB whose luminance (0.2126, 0.7152, 0.0722) is the photopic
    // illuminance. Signed: a colour outside the sRGB gamut keeps its negative component. Extinction by the air, rhythm,
    // sectors and profiles are in; occlusion by the host's picture is not.
    std::array<float, 3> illuminance_rgb_lx{};
    float illuminance_scotopic_lx = 0;  // the same through V', in scotopic lux (K'm = 1700)
    // Which lamp's glare pattern it has, by index in the LampList of the frame (colour/lamp_list.h), less than most_lamps:
    // the spectrum decides where colours go in the halo.
    std::uint32_t lamp = 0;
    std::uint32_t tag = 0;  // the caller's own: says after culling which of its lights this is
};

enum class TargetEncoding : std::int32_t { srgb_values = 0, srgb_format = 1, linear = 2 };
enum class DepthSource : std::int32_t { none = 0, texture = 1, texture_ms = 2, fbo = 3 };
enum class DepthConvention : std::int32_t { standard = 0, zero_to_one = 1, logarithmic = 2 };

// How it is judged what the host's depth hides.
struct OcclusionSettings {
    double smoothing_s = 0;  // time constant with which a light goes and comes back; 0: at once
    double body_m = 0;  // what stands no further before a lamp is its own body; at least the lamp's radius
    // Whoever needs it on the CPU waits for it: the same picture in every run. Otherwise it comes a frame or two late.
    bool wait = false;
};

// What the renderer needs to know of the host's frame; already validated by plugin_api.
struct Frame {
    std::uint32_t target_fbo = 0;
    TargetEncoding target_encoding = TargetEncoding::srgb_values;
    std::array<std::int32_t, 4> viewport_px{};  // x, y, width, height
    DepthSource depth_source = DepthSource::none;
    std::uint32_t depth_object = 0;
    DepthConvention depth_convention = DepthConvention::standard;
    std::array<std::int32_t, 2> depth_origin_px{};
    double depth_log_c = 0;
    double depth_log_far_m = 0;
    std::array<double, 16> clip_from_view{};  // column-major, perspective
    double time_s = 0;
    double adaptation_luminance_cd_m2 = 0.001;
    double ldr_white_luminance_cd_m2 = 0;  // 0: the inverse of our own tone curve
    OcclusionSettings occlusion;
};

}  // namespace seaglare::glare
