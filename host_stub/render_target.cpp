#include "host_stub/render_target.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace seaglare::host {
namespace {

constexpr int wanted_samples = 4;

GLenum internal_format(TargetFormat format) {
    switch (format) {
        case TargetFormat::srgb8_alpha8:
            return GL_SRGB8_ALPHA8;
        case TargetFormat::rgba16f_linear:
            return GL_RGBA16F;
        case TargetFormat::rgba8_srgb_values:
            break;
    }
    return GL_RGBA8;
}

void require_complete(const char* what) {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw GlFailure(std::string(what) + " framebuffer is not complete: status " + std::to_string(status));
}

}  // namespace

RenderTarget::RenderTarget(int width_px, int height_px, TargetFormat format)
    : width_px_(width_px), height_px_(height_px), format_(format) {
    const GLenum colour_format = internal_format(format);
    colour_ = make_texture();
    glBindTexture(GL_TEXTURE_2D, colour_);
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(colour_format), width_px, height_px, 0, GL_RGBA,
                 format == TargetFormat::rgba16f_linear ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    depth_ = make_texture();
    glBindTexture(GL_TEXTURE_2D, depth_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width_px, height_px, 0, GL_DEPTH_COMPONENT,
                 GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
    fbo_ = make_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, fbo_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
    require_complete("the host's");

    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    const GLint samples = std::min(wanted_samples, most);
    multisampled_colour_ = make_renderbuffer();
    glBindRenderbuffer(GL_RENDERBUFFER, multisampled_colour_);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, colour_format, width_px, height_px);
    multisampled_depth_ = make_renderbuffer();
    glBindRenderbuffer(GL_RENDERBUFFER, multisampled_depth_);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT32F, width_px, height_px);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    multisampled_fbo_ = make_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, multisampled_fbo_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, multisampled_colour_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, multisampled_depth_);
    require_complete("the host's multisampled");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    check_gl("making the host's framebuffer");
}

void RenderTarget::resolve() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_fbo_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, fbo_);
    glBlitFramebuffer(0, 0, width_px_, height_px_, 0, 0, width_px_, height_px_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
    glBlitFramebuffer(0, 0, width_px_, height_px_, 0, 0, width_px_, height_px_, GL_DEPTH_BUFFER_BIT,
                      GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, fbo_);
}

std::vector<std::uint8_t> RenderTarget::read_raw() const {
    const bool half = format_ == TargetFormat::rgba16f_linear;
    const std::size_t pixels = static_cast<std::size_t>(width_px_) * height_px_;
    std::vector<std::uint8_t> bytes(pixels * (half ? 16 : 4));
    glBindTexture(GL_TEXTURE_2D, colour_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, half ? GL_FLOAT : GL_UNSIGNED_BYTE, bytes.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    return bytes;
}

std::vector<std::uint8_t> RenderTarget::read_srgb_rgba8() const {
    std::vector<std::uint8_t> raw = read_raw();
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width_px_) * height_px_ * 4);
    if (format_ == TargetFormat::rgba16f_linear) {
        const auto* linear = reinterpret_cast<const float*>(raw.data());
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const double v = std::clamp(static_cast<double>(linear[i]), 0.0, 1.0);
            const double coded = i % 4 == 3       ? v
                                 : v <= 0.0031308 ? 12.92 * v
                                                  : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
            bytes[i] = static_cast<std::uint8_t>(std::lround(255 * coded));
        }
    } else {
        bytes = std::move(raw);
    }
    const std::size_t row = static_cast<std::size_t>(width_px_) * 4;
    for (int y = 0; y < height_px_ / 2; ++y)
        std::swap_ranges(bytes.begin() + y * row, bytes.begin() + (y + 1) * row, bytes.end() - (y + 1) * row);
    return bytes;
}

std::vector<float> RenderTarget::read_depth() const {
    std::vector<float> depth(static_cast<std::size_t>(width_px_) * height_px_);
    glBindTexture(GL_TEXTURE_2D, depth_);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    return depth;
}

}  // namespace seaglare::host
