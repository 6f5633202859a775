// Pictures on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace seaglare::host {

// 8-bit RGB PNG marked sRGB, from RGBA bytes, upper row first; alpha is left out, as a display does. Throws
// std::runtime_error that names the path.
void write_png(const std::filesystem::path& path, int width_px, int height_px,
               std::span<const std::uint8_t> rgba);

// OpenEXR with 32-bit float channels R, G, B (linear sRGB, cd/m2) and V (scotopic luminance), from four
// floats a pixel, lower row first. Throws std::runtime_error that names the path.
void write_exr(const std::filesystem::path& path, int width_px, int height_px, std::span<const float> rgbv);

}  // namespace seaglare::host
