// The whole product as one channel of a bridge has it, for tests that measure what reaches the picture: the library
// opened from its file, a context without a display, an 8-bit target, a pinhole camera, and the numbers that come out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/abi/loaded_plugin.h"
#include "tests/gl/headless_context.h"

namespace seaglare::test {

// This machine has no OpenGL or no OpenCL: a test skips, with the reason.
struct NotHere : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// What a test may choose of the quality file that the channel writes for itself.
struct Quality {
    int transform_size = 1024;
    bool cie_tail = true;
    bool gratings = true;  // without them the eye absorbs nothing: all light arrives
    bool dither = true;
    double threshold_codes = 0;  // nothing is left out or cropped
};

struct ChannelOptions {
    Quality quality;
    std::uint32_t create_flags = 0;
    int width_px = 160;
    int height_px = 160;
    double focal_px = 869.117;  // 720 lines of 45 degrees
    // Of the world, which lies flat with axes east, north and up.
    double origin_latitude_deg = 0;
    double origin_longitude_deg = 0;
};

using Point = std::array<double, 3>;
// Linear sRGB and scotopic.
using Rgbv64 = std::array<double, 4>;

class Channel {
  public:
    // Throws NotHere when OpenGL is missing, or OpenCL though the options ask for it.
    explicit Channel(const ChannelOptions& options = {});
    ~Channel();
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;

    const LoadedPlugin& plugin() const { return plugin_; }
    seaglare_context* context() const { return context_; }
    int width_px() const { return options_.width_px; }
    int height_px() const { return options_.height_px; }
    std::string last_error() const { return plugin_.last_error(context_); }

    // The camera: level when it looks at its own height. It begins 20 m above the origin and looks north.
    void place_eye(const Point& eye_m) { eye_m_ = eye_m; }
    void look_along(const Point& direction);
    void look_at(const Point& point_m);
    // The world position seen at a pixel position ((0, 0): lower left corner) at a distance in m.
    Point at_px(double x_px, double y_px, double distance_m) const;
    // Whether a direction of the world falls into the picture.
    bool in_picture(const Point& direction) const;
    // World direction at `angle_rad` from the pixel position, at `azimuth_rad` around it.
    Point direction_around(double x_px, double y_px, double angle_rad, double azimuth_rad) const;

    seaglare_light_id add(const seaglare_light& light);
    void clear() { plugin_->clear_lights(context_); }

    // A frame of the camera by starlight (0.001 cd/m2) in clear air at t = 0; render() fills in target and camera.
    seaglare_frame frame() const;
    seaglare_result render(seaglare_frame frame);
    seaglare_result render() { return render(frame()); }
    seaglare_stats stats() const;

    // The host's picture: RGBA bytes of sRGB values, lower row first.
    void draw_background(const std::vector<std::uint8_t>& rgba);
    void draw_black();
    std::vector<std::uint8_t> picture() const;

    // The HDR buffer of the last render, four floats a pixel, lower row first, and its sum of L times the solid angle
    // of the pixel: the illuminance that the picture brings to the eye, in lux (scotopic lux last).
    std::vector<float> hdr() const;
    Rgbv64 energy_lx() const;

  private:
    ChannelOptions options_;
    LoadedPlugin plugin_;
    std::unique_ptr<HeadlessContext> gl_;
    seaglare_context* context_ = nullptr;
    seaglare_view* view_ = nullptr;
    GLuint framebuffer_ = 0;
    GLuint texture_ = 0;
    Point eye_m_{0, 0, 20};
    Point right_{1, 0, 0};
    Point up_{0, 0, 1};
    Point forward_{0, 1, 0};
};

// A fixed white all-round light.
seaglare_light white_light(const Point& position_m, double intensity_cd, double radius_m = 0.05);
// The radius in m of a lamp that appears with `radius_px` pixels of radius at this distance.
double radius_of_px(double radius_px, double distance_m, double focal_px = 869.117);
// The quality file that a channel writes.
std::string quality_text(const Quality& quality);

double luminance_of(const Rgbv64& rgb);
double distance(const Point& a, const Point& b);

// Points that fill the unit square evenly (Roberts' R2 sequence): sub-pixel positions.
std::array<double, 2> sub_pixel(int index);

// Makes a channel or skips the test with the reason.
#define SEAGLARE_CHANNEL(name, ...)                                              \
    std::unique_ptr<::seaglare::test::Channel> name##_owner;                     \
    try {                                                                        \
        name##_owner = std::make_unique<::seaglare::test::Channel>(__VA_ARGS__); \
    } catch (const ::seaglare::test::NotHere& reason) {                          \
        GTEST_SKIP() << reason.what();                                           \
    }                                                                            \
    ::seaglare::test::Channel& name = *name##_owner

}  // namespace seaglare::test
