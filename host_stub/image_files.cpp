#include "host_stub/image_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <png.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace seaglare::host {

void write_png(const std::filesystem::path& path, int width_px, int height_px,
               std::span<const std::uint8_t> rgba) {
    // libpng's simplified interface writes the sRGB chunk for 8-bit formats by itself.
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width_px);
    image.height = static_cast<png_uint_32>(height_px);
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4)
        rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    if (!png_image_write_to_file(&image, path.c_str(), 0, rgb.data(), 0, nullptr))
        throw std::runtime_error("cannot write " + path.string() + ": " + image.message);
}

void write_exr(const std::filesystem::path& path, int width_px, int height_px, std::span<const float> rgbv) {
    try {
        Imf::Header header(width_px, height_px);
        header.compression() = Imf::ZIP_COMPRESSION;
        header.insert("comments",
                      Imf::StringAttribute("R, G, B: linear sRGB, luminance in cd/m2, signed outside the "
                                           "gamut. V: scotopic luminance."));
        // EXR's first row is the uppermost: a negative stride turns the picture over.
        const auto row_bytes = static_cast<std::ptrdiff_t>(sizeof(float)) * 4 * width_px;
        auto* top = reinterpret_cast<char*>(const_cast<float*>(rgbv.data())) + row_bytes * (height_px - 1);
        Imf::FrameBuffer buffer;
        const char* names[] = {"R", "G", "B", "V"};
        for (int c = 0; c < 4; ++c) {
            header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
            buffer.insert(names[c], Imf::Slice(Imf::FLOAT, top + sizeof(float) * c, 4 * sizeof(float),
                                               static_cast<std::size_t>(-row_bytes)));
        }
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(height_px);
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot write " + path.string() + ": " + e.what());
    }
}

}  // namespace seaglare::host
