#include "plugin_api/validate.h"

#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>

namespace seaglare::plugin {

namespace {

constexpr double earth_reach_m =
    1e8;  // beyond any position a simulator uses, near enough for exact millimetres
constexpr double most_intensity_cd = 1e12;
constexpr double most_luminance_cd_m2 = 1e12;
constexpr double most_head_rate_rad_s = 1000;
constexpr std::int32_t most_viewport_px = 16384;
constexpr std::int32_t most_offset_px = 1 << 24;

std::string number(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << value;
    return text.str();
}

}  // namespace

void check_struct_size(std::uint32_t size, std::size_t todays_size, const char* name) {
    const bool possible = size >= 2 * sizeof(std::uint32_t) && size % sizeof(std::uint32_t) == 0;
    if (possible && size <= todays_size) return;
    std::string text = std::string(name) + ".struct_size is " + std::to_string(size);
    if (size == 0) {
        text += ": set it to sizeof(the struct)";
    } else if (possible) {
        text += ", larger than this library's " + std::to_string(todays_size) +
                ": the header is newer than the library";
    } else {
        text += ", which is no size of this struct: set it to sizeof(the struct)";
    }
    throw Failure(SEAGLARE_ERROR_STRUCT_SIZE, text);
}

std::string Field::text() const {
    std::string text = entry >= 0 ? "updates[" + std::to_string(entry) + "]." : std::string();
    text += name;
    if (component >= 0) text += "[" + std::to_string(component) + "]";
    return text;
}

void check_finite(double value, const Field& field) {
    if (!std::isfinite(value))
        invalid_argument(field.text() + " is " + (std::isnan(value) ? "not a number" : "infinite"));
}

void check_finite(const double* values, int count, const Field& field) {
    for (int i = 0; i < count; ++i)
        if (!std::isfinite(values[i])) check_finite(values[i], Field(field.name, i, field.entry));
}

void check_range(double value, double low, double high, const Field& field) {
    check_finite(value, field);
    if (value < low || value > high) {
        invalid_argument(field.text() + " is " + number(value) + ": it must lie between " + number(low) +
                         " and " + number(high));
    }
}

void check_flags(std::uint32_t flags, std::uint32_t known, const Field& field) {
    if ((flags & ~known) != 0) {
        std::ostringstream text;
        text << field.text() << " has unknown bits 0x" << std::hex << (flags & ~known);
        invalid_argument(text.str());
    }
}

void check_enumerator(std::int32_t value, std::int32_t last, const Field& field) {
    if (value < 0 || value > last)
        invalid_argument(field.text() + " is " + std::to_string(value) + ": it must be 0 to " +
                         std::to_string(last));
}

void check_quaternion(const double* xyzw, const Field& field) {
    check_finite(xyzw, 4, field);
    const double length = std::hypot(std::hypot(xyzw[0], xyzw[1]), std::hypot(xyzw[2], xyzw[3]));
    if (!(length > 1e-6) || length > 1e6)
        invalid_argument(field.text() + " has length " + number(length) + ": it must be a unit quaternion");
}

void check(const seaglare_create_info& info) {
    check_flags(info.flags, SEAGLARE_CREATE_NO_OPENCL, "create_info.flags");
    check_enumerator(info.axes, SEAGLARE_AXES_EARTH_CENTRED, "create_info.axes");
    check_enumerator(info.earth, SEAGLARE_EARTH_ROUND, "create_info.earth");
    check_range(info.origin_latitude_deg, -90, 90, "create_info.origin_latitude_deg");
    check_range(info.origin_longitude_deg, -360, 360, "create_info.origin_longitude_deg");
    check_range(info.origin_height_m, -earth_reach_m, earth_reach_m, "create_info.origin_height_m");
}

void check(const seaglare_view_info& info) {
    check_flags(info.flags, SEAGLARE_VIEW_HOST_RESTORES_STATE | SEAGLARE_VIEW_NO_GPU_TIMES,
                "view_info.flags");
    if (info.get_proc == nullptr) invalid_argument("view_info.get_proc is NULL");
}

void check(const seaglare_light& light) {
    // Sizes are whole fours, but half a pointer is none.
    if (light.struct_size > offsetof(seaglare_light, spectrum) && light.struct_size < sizeof light) {
        throw Failure(
            SEAGLARE_ERROR_STRUCT_SIZE,
            "light.struct_size is " + std::to_string(light.struct_size) + ": it ends within light.spectrum");
    }
    check_flags(light.flags, 0, "light.flags");
    for (int i = 0; i < 3; ++i)
        check_range(light.position_m[i], -earth_reach_m, earth_reach_m, Field("light.position_m", i));
    check_range(light.intensity_cd, 0, most_intensity_cd, "light.intensity_cd");
    check_range(light.nominal_range_nm, 0, 60, "light.nominal_range_nm");
    check_range(light.radius_m, 0, 1000, "light.radius_m");
    check_enumerator(light.colour, SEAGLARE_COLOUR_VIOLET, "light.colour");
}

void check(const seaglare_light_update& update, std::int64_t entry) {
    check_flags(update.set,
                SEAGLARE_SET_POSITION | SEAGLARE_SET_ORIENTATION | SEAGLARE_SET_INTENSITY |
                    SEAGLARE_SET_VISIBILITY | SEAGLARE_SET_ON,
                Field("set", -1, entry));
    if ((update.set & SEAGLARE_SET_POSITION) != 0) {
        for (int i = 0; i < 3; ++i) {
            const double value = update.position_m[i];
            if (!(std::abs(value) <= earth_reach_m))
                check_range(value, -earth_reach_m, earth_reach_m, Field("position_m", i, entry));
        }
    }
    if ((update.set & SEAGLARE_SET_ORIENTATION) != 0)
        check_quaternion(update.orientation, Field("orientation", -1, entry));
    if ((update.set & SEAGLARE_SET_INTENSITY) != 0)
        check_range(update.intensity_cd, 0, most_intensity_cd, Field("intensity_cd", -1, entry));
    if ((update.set & SEAGLARE_SET_VISIBILITY) != 0)
        check_range(static_cast<double>(update.visibility), 0, 1, Field("visibility", -1, entry));
    if ((update.set & SEAGLARE_SET_ON) != 0) check_enumerator(update.on, 1, Field("on", -1, entry));
}

std::uint32_t eye_state_flags(std::uint32_t struct_size) {
    std::uint32_t flags = 0;
    if (struct_size > offsetof(seaglare_eye_state, is_day)) flags |= SEAGLARE_EYE_HAS_DAY;
    if (struct_size >= offsetof(seaglare_eye_state, vitreous_orientation)) flags |= SEAGLARE_EYE_HAS_ADAPTED;
    if (struct_size >= sizeof(seaglare_eye_state)) flags |= SEAGLARE_EYE_HAS_VITREOUS;
    return flags;
}

void check(const seaglare_eye_state& state) {
    check_flags(state.flags, eye_state_flags(state.struct_size), "eye_state.flags");
    check_enumerator(state.is_day, 1, "eye_state.is_day");
    if (state.reserved != 0) invalid_argument("eye_state.reserved is not 0");
    check_range(state.adaptation_luminance_cd_m2, 0, most_luminance_cd_m2,
                "eye_state.adaptation_luminance_cd_m2");
    check_finite(state.time_s, "eye_state.time_s");
    check_range(state.adapted_luminance_cd_m2, 0, most_luminance_cd_m2, "eye_state.adapted_luminance_cd_m2");
    check_finite(state.vitreous_orientation, 4, "eye_state.vitreous_orientation");
    if ((state.flags & SEAGLARE_EYE_HAS_VITREOUS) != 0)
        check_quaternion(state.vitreous_orientation, "eye_state.vitreous_orientation");
    for (int i = 0; i < 3; ++i) {
        check_range(state.vitreous_spin_rad_s[i], -2 * most_head_rate_rad_s, 2 * most_head_rate_rad_s,
                    Field("eye_state.vitreous_spin_rad_s", i));
        check_range(state.head_rate_rad_s[i], -most_head_rate_rad_s, most_head_rate_rad_s,
                    Field("eye_state.head_rate_rad_s", i));
    }
}

namespace {

// The upper left 3x3 must be a rotation, or a rotation with a reflection for left-handed hosts; the tolerance lets
// matrices pass that a host made in single precision.
void check_rigid(const double* m, const Field& field) {
    constexpr double tolerance = 1e-3;
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            const double dot =
                m[4 * i] * m[4 * j] + m[4 * i + 1] * m[4 * j + 1] + m[4 * i + 2] * m[4 * j + 2];
            if (std::abs(dot - (i == j ? 1 : 0)) > tolerance) {
                invalid_argument(field.text() + " is not rigid: columns " + std::to_string(i) + " and " +
                                 std::to_string(j) + " have the product " + number(dot) +
                                 " (rotation and translation only, no scale; column-major)");
            }
        }
    }
    for (int column = 0; column < 4; ++column) {
        const double wanted = column == 3 ? 1 : 0;
        if (std::abs(m[4 * column + 3] - wanted) > 1e-6) {
            invalid_argument(Field(field.name, 4 * column + 3).text() + " is " + number(m[4 * column + 3]) +
                             ", not " + number(wanted) + ": is the matrix row-major?");
        }
    }
    for (int row = 0; row < 3; ++row)
        check_range(m[12 + row], -earth_reach_m, earth_reach_m, Field(field.name, 12 + row));
}

void check_target_and_depth(const seaglare_frame& frame) {
    check_enumerator(frame.target_encoding, SEAGLARE_TARGET_LINEAR, "frame.target_encoding");
    for (int i = 0; i < 2; ++i) {
        check_range(frame.viewport_px[i], -most_offset_px, most_offset_px, Field("frame.viewport_px", i));
        check_range(frame.viewport_px[2 + i], 1, most_viewport_px, Field("frame.viewport_px", 2 + i));
        check_range(frame.depth_origin_px[i], -most_offset_px, most_offset_px,
                    Field("frame.depth_origin_px", i));
    }
    check_enumerator(frame.depth_source, SEAGLARE_DEPTH_FBO, "frame.depth_source");
    check_enumerator(frame.depth_convention, SEAGLARE_DEPTH_LOGARITHMIC, "frame.depth_convention");
    const bool needs_name =
        frame.depth_source == SEAGLARE_DEPTH_TEXTURE || frame.depth_source == SEAGLARE_DEPTH_TEXTURE_MS;
    if (needs_name && frame.depth_object == 0)
        invalid_argument("frame.depth_object is 0: it must name the texture");
    if (frame.depth_source != SEAGLARE_DEPTH_NONE && frame.depth_convention == SEAGLARE_DEPTH_LOGARITHMIC) {
        check_range(frame.depth_log_c, 1e-12, 1e12, "frame.depth_log_c");
        check_range(frame.depth_log_far_m, 1e-3, 1e12, "frame.depth_log_far_m");
    }
}

}  // namespace

void check(const seaglare_frame& frame) {
    check_flags(frame.flags,
                SEAGLARE_FRAME_HAS_ADAPTATION | SEAGLARE_FRAME_HAS_TIME_OF_DAY | SEAGLARE_FRAME_HAS_FOG |
                    SEAGLARE_FRAME_WAIT |
                    (frame.struct_size >= sizeof(seaglare_frame)
                         ? static_cast<std::uint32_t>(SEAGLARE_FRAME_HAS_HEAD_RATE)
                         : 0U),
                "frame.flags");
    for (int i = 0; i < 3; ++i)
        check_range(frame.head_rate_rad_s[i], -most_head_rate_rad_s, most_head_rate_rad_s,
                    Field("frame.head_rate_rad_s", i));
    if (frame.reserved != 0) invalid_argument("frame.reserved is not 0");
    // Every double, set or not: a NaN in an unused field is a struct that was not zeroed.
    check_finite(frame.depth_log_c, "frame.depth_log_c");
    check_finite(frame.depth_log_far_m, "frame.depth_log_far_m");
    check_finite(frame.view_from_world, 16, "frame.view_from_world");
    check_finite(frame.clip_from_view, 16, "frame.clip_from_view");
    check_finite(frame.time_s, "frame.time_s");
    check_range(frame.frame_interval_s, 0, 1e9, "frame.frame_interval_s");
    check_finite(frame.adaptation_luminance_cd_m2, "frame.adaptation_luminance_cd_m2");
    check_finite(frame.local_time_of_day_h, "frame.local_time_of_day_h");
    check_range(frame.ldr_white_luminance_cd_m2, 0, most_luminance_cd_m2, "frame.ldr_white_luminance_cd_m2");
    check_finite(frame.meteorological_visibility_m, "frame.meteorological_visibility_m");

    if ((frame.flags & SEAGLARE_FRAME_HAS_ADAPTATION) != 0) {
        check_range(frame.adaptation_luminance_cd_m2, 0, most_luminance_cd_m2,
                    "frame.adaptation_luminance_cd_m2");
    }
    if ((frame.flags & SEAGLARE_FRAME_HAS_TIME_OF_DAY) != 0)
        check_range(frame.local_time_of_day_h, 0, 24, "frame.local_time_of_day_h");
    if ((frame.flags & SEAGLARE_FRAME_HAS_FOG) != 0) {
        check_range(frame.meteorological_visibility_m, 1e-3, 1e9, "frame.meteorological_visibility_m");
    }
    check_target_and_depth(frame);
    check_rigid(frame.view_from_world, "frame.view_from_world");
}

}  // namespace seaglare::plugin
