// Names of the compatibility profile, which the core header leaves out. Values: Khronos XML registry, gl.xml.
#pragma once

#include "glare/device/gl.h"

namespace seaglare::plugin::legacy {

inline constexpr GLenum alpha_test = 0x0BC0;
inline constexpr GLenum polygon_stipple = 0x0B42;
inline constexpr GLenum index_logic_op = 0x0BF1;
inline constexpr GLenum list_index = 0x0B33;
inline constexpr GLenum render_mode = 0x0C40;
inline constexpr GLenum render = 0x1C00;
inline constexpr GLenum clamp_vertex_color = 0x891A;
inline constexpr GLenum clamp_fragment_color = 0x891B;
inline constexpr GLenum map_color = 0x0D10;
inline constexpr GLenum map_stencil = 0x0D11;
inline constexpr GLenum red_scale = 0x0D14;
inline constexpr GLenum red_bias = 0x0D15;
inline constexpr GLenum green_scale = 0x0D18;
inline constexpr GLenum green_bias = 0x0D19;
inline constexpr GLenum blue_scale = 0x0D1A;
inline constexpr GLenum blue_bias = 0x0D1B;
inline constexpr GLenum alpha_scale = 0x0D1C;
inline constexpr GLenum alpha_bias = 0x0D1D;
inline constexpr GLenum depth_scale = 0x0D1E;
inline constexpr GLenum depth_bias = 0x0D1F;

}  // namespace seaglare::plugin::legacy
