// What the renderer's tests share: a projection, a synthetic pattern, a target and a way to read them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "glare/apply/glare_bound.h"
#include "glare/apply/screen_geometry.h"
#include "glare/apply/view_renderer.h"
#include "glare/device/gl_object.h"
#include "glare/device/gl_touched_state.h"
#include "glare/psf/cie_curve.h"
#include "tests/gl/headless_context.h"

namespace seaglare::test {

using glare::Frame;
using glare::Gl;
using glare::GlKind;
using glare::GlObject;
using glare::Pattern;
using glare::PointSource;
using glare::RenderStats;
using glare::Rgbv;
using glare::ToneSettings;
using glare::ViewRenderer;

inline constexpr double pi = std::numbers::pi;

// glFrustum on the near plane at distance 1; depth standard. Column-major.
inline std::array<double, 16> frustum(double left, double right, double bottom, double top,
                                      double near_m = 0.1, double far_m = 1e5) {
    std::array<double, 16> m{};
    m[0] = 2 / (right - left);
    m[5] = 2 / (top - bottom);
    m[8] = (right + left) / (right - left);
    m[9] = (top + bottom) / (top - bottom);
    m[10] = -(far_m + near_m) / (far_m - near_m);
    m[11] = -1;
    m[14] = -2 * far_m * near_m / (far_m - near_m);
    return m;
}

inline std::array<double, 16> perspective(double vertical_fov_deg, double aspect) {
    const double t = std::tan(vertical_fov_deg * pi / 360);
    return frustum(-t * aspect, t * aspect, -t, t);
}

inline Frame make_frame(int width, int height, double vertical_fov_deg = 45) {
    Frame frame;
    frame.viewport_px = {0, 0, width, height};
    frame.clip_from_view = perspective(vertical_fov_deg, static_cast<double>(width) / height);
    return frame;
}

// A source that lands on a pixel position, at a distance.
inline PointSource source_at_px(const Frame& frame, double x_px, double y_px, double lux = 1e-4,
                                double distance_m = 1000, double radius_m = 0,
                                std::array<float, 3> rgb = {1, 1, 1}) {
    const glare::ScreenGeometry g = glare::screen_geometry(frame);
    const glare::Vec3 ray = glare::ray_of_px(g, x_px, y_px);
    PointSource source;
    for (std::size_t i = 0; i < 3; ++i) {
        source.position_view_m[i] = static_cast<float>(ray[i] * distance_m);
        source.illuminance_rgb_lx[i] = static_cast<float>(rgb[i] * lux);
    }
    source.radius_m = static_cast<float>(radius_m);
    source.illuminance_scotopic_lx = static_cast<float>(2.464 * lux);
    return source;
}

// A pattern of the CIE curve alone, every node the mean over its own area; layers are made wider with a plain disc.
struct SyntheticPattern {
    int radius_nodes = 60;
    bool with_tail = false;
    std::vector<float> layers = {0.0F};
};
// A view keeps its copy of a pattern while the generation is the same.
inline std::uint64_t next_generation() {
    static std::uint64_t last = 0;
    return ++last;
}
inline Pattern make_pattern(double pitch, const SyntheticPattern& settings = {}) {
    Pattern p;
    p.generation = next_generation();
    p.radius_nodes = settings.radius_nodes;
    p.pitch = pitch;
    p.core_energy[0] = {0.6F, 0.6F, 0.6F, 0.6F};
    p.layer_radius_nodes = settings.layers;
    p.window_outer = (settings.radius_nodes - 1) * pitch;
    p.window_inner = 0.8 * p.window_outer;
    p.tail_scale = settings.with_tail ? 1 : 0;
    const int side = 2 * settings.radius_nodes + 1;
    p.skirt.resize(static_cast<std::size_t>(side) * side * 4 * settings.layers.size());
    std::size_t out = 0;
    for (const float layer : settings.layers) {
        for (int y = -settings.radius_nodes; y <= settings.radius_nodes; ++y) {
            for (int x = -settings.radius_nodes; x <= settings.radius_nodes; ++x) {
                // A wide soft core stands in for the disc: smooth, and near enough for a test of the drawing.
                const double r = std::hypot(std::hypot(x, y), std::max(2.0, static_cast<double>(layer)));
                const double sine = std::hypot(x, y) * pitch;
                double w = 1;
                if (sine > p.window_inner) {
                    const double t = (sine - p.window_inner) / (p.window_outer - p.window_inner);
                    w = t < 1 ? (1 + std::cos(pi * t)) / 2 : 0;
                }
                const double value =
                    w * glare::cie_total_glare_sr(std::asin(std::min(1.0, r * pitch)) * 180 / pi, 24, 0.5);
                for (int c = 0; c < 4; ++c)
                    p.skirt[out++] = static_cast<float>(value);
            }
        }
    }
    return p;
}
// Energy of a layer: the sum of its nodes times their solid angle.
inline double skirt_energy(const Pattern& p, std::size_t layer = 0) {
    const int side = 2 * p.radius_nodes + 1;
    double sum = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double u = (x - p.radius_nodes) * p.pitch;
            const double v = (y - p.radius_nodes) * p.pitch;
            const double cosine = std::sqrt(std::max(1e-6, 1 - u * u - v * v));
            const std::size_t node = (layer * side + y) * side + x;
            sum += static_cast<double>(p.skirt[node * 4 + 1]) * p.pitch * p.pitch / cosine;
        }
    }
    return sum;
}

// A colour texture in a framebuffer.
class Target {
  public:
    Target(const Gl& gl, int width, int height, GLenum format = GL_RGBA8)
        : gl_(gl),
          width_(width),
          height_(height),
          texture_(gl, GlKind::texture),
          fbo_(gl, GlKind::framebuffer) {
        gl.BindTexture(GL_TEXTURE_2D, texture_.name());
        const bool floating = format == GL_RGBA16F || format == GL_RGBA32F;
        gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA,
                      floating ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        gl.BindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    }
    GLuint fbo() const { return fbo_.name(); }
    GLuint texture() const { return texture_.name(); }
    void fill(std::array<std::uint8_t, 4> colour) const {
        upload(std::vector<std::uint8_t>(fill_pixels(colour)));
    }
    void upload(const std::vector<std::uint8_t>& rgba) const {
        glare::set_neutral_pixel_store(gl_);
        gl_.BindTexture(GL_TEXTURE_2D, texture_.name());
        gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    }
    std::vector<std::uint8_t> read() const {
        std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width_) * height_ * 4);
        glare::set_neutral_pixel_store(gl_);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
        gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
        gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        return pixels;
    }
    std::vector<float> read_floats() const {
        std::vector<float> pixels(static_cast<std::size_t>(width_) * height_ * 4);
        glare::set_neutral_pixel_store(gl_);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
        gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
        gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels.data());
        return pixels;
    }

  private:
    std::vector<std::uint8_t> fill_pixels(std::array<std::uint8_t, 4> colour) const {
        std::vector<std::uint8_t> pixels;
        for (int i = 0; i < width_ * height_; ++i)
            pixels.insert(pixels.end(), colour.begin(), colour.end());
        return pixels;
    }
    const Gl& gl_;
    int width_;
    int height_;
    GlObject texture_;
    GlObject fbo_;
};

class ViewTest : public ::testing::Test {
  protected:
    void SetUp() override {
        try {
            context_ = std::make_unique<HeadlessContext>();
        } catch (const std::exception& error) {
            GTEST_SKIP() << "no GL context here: " << error.what();
        }
        renderer_ = std::make_unique<ViewRenderer>(gl());
    }
    void TearDown() override {
        if (context_) {
            EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
        }
        renderer_.reset();
    }
    const Gl& gl() const { return context_->gl(); }

    // Renders into a fresh black target and returns the HDR buffer.
    std::vector<float> hdr_of(Frame frame, const Pattern& pattern, std::vector<PointSource> sources,
                              const ToneSettings& tone = {}) {
        const Target target(gl(), frame.viewport_px[0] + frame.viewport_px[2],
                            frame.viewport_px[1] + frame.viewport_px[3]);
        target.fill({0, 0, 0, 255});
        frame.target_fbo = target.fbo();
        renderer_->render(frame, tone, pattern, sources, stats_);
        return read_hdr();
    }
    std::vector<float> read_hdr() const {
        std::vector<float> rgba(static_cast<std::size_t>(renderer_->hdr_width()) * renderer_->hdr_height() *
                                4);
        renderer_->read_hdr(rgba);
        return rgba;
    }
    // Sum of luminance times solid angle over the picture: lux, of one channel.
    static double energy_lx(const Frame& frame, const std::vector<float>& rgba, int channel = 1) {
        const glare::ScreenGeometry g = glare::screen_geometry(frame);
        double sum = 0;
        for (int y = 0; y < g.height_px; ++y) {
            for (int x = 0; x < g.width_px; ++x) {
                const double omega = glare::pixel_solid_angle_sr(g, glare::ray_of_px(g, x + 0.5, y + 0.5));
                sum +=
                    static_cast<double>(rgba[(static_cast<std::size_t>(y) * g.width_px + x) * 4 + channel]) *
                    omega;
            }
        }
        return sum;
    }

    std::unique_ptr<HeadlessContext> context_;
    std::unique_ptr<ViewRenderer> renderer_;
    RenderStats stats_;
};

}  // namespace seaglare::test
