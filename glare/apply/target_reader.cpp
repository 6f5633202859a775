#include "glare/apply/target_reader.h"

#include <algorithm>

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

namespace {

struct ColourFormat {
    GLenum internal;
    double bytes_per_px;
};

// The target's own format where GL has one, so that copies keep every bit and resolves are allowed by strict drivers.
ColourFormat background_format(const TargetFormat& target, TargetEncoding encoding) {
    if (target.floating)
        return target.red_bits > 16 ? ColourFormat{GL_RGBA32F, 16} : ColourFormat{GL_RGBA16F, 8};
    if (encoding == TargetEncoding::srgb_format) return {GL_SRGB8_ALPHA8, 4};
    if (target.red_bits > 10) return {GL_RGBA16, 8};
    if (target.red_bits > 8) return {GL_RGB10_A2, 4};
    return {GL_RGBA8, 4};
}

}  // namespace

TargetFormat TargetReader::inspect(const Frame& frame) const {
    const std::string what = "target_fbo " + std::to_string(frame.target_fbo);
    if (frame.target_fbo != 0 && gl_.IsFramebuffer(frame.target_fbo) == GL_FALSE) {
        throw GlError(what + " is not a framebuffer");
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame.target_fbo);
    if (gl_.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw GlError(what + " is not complete");
    }
    TargetFormat format;
    GLint buffer = GL_NONE;
    gl_.GetIntegerv(GL_DRAW_BUFFER0, &buffer);
    if (buffer == GL_NONE) throw GlError(what + " draws to no colour buffer (GL_DRAW_BUFFER0 is GL_NONE)");
    format.draw_buffer = static_cast<GLenum>(buffer);
    // The window's buffers have other names when they are asked about.
    GLenum attachment = format.draw_buffer;
    if (frame.target_fbo == 0) {
        const bool front =
            buffer == GL_FRONT || buffer == GL_FRONT_LEFT || buffer == GL_FRONT_AND_BACK || buffer == GL_LEFT;
        attachment = front ? GL_FRONT_LEFT : GL_BACK_LEFT;
    }
    GLint type = GL_NONE;
    gl_.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                            GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type == GL_NONE) throw GlError(what + " has no colour buffer where it draws");
    const auto attached = [&](GLenum parameter) {
        GLint value = 0;
        gl_.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, parameter, &value);
        return value;
    };
    const GLint component = attached(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE);
    if (component == GL_INT || component == GL_UNSIGNED_INT)
        throw GlError(what + " holds integers, not colours");
    format.floating = component == GL_FLOAT;
    format.red_bits = attached(GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE);
    format.alpha_bits = attached(GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE);
    gl_.GetIntegerv(GL_SAMPLES, &format.samples);
    return format;
}

void TargetReader::make_texture(const Frame& frame, const TargetFormat& format) {
    const ColourFormat wanted = background_format(format, frame.target_encoding);
    const int width = frame.viewport_px[2];
    const int height = std::min(frame.viewport_px[3], band_rows);
    if (texture_ && format_ == wanted.internal && width_px_ == width && height_px_ == height) return;
    texture_ = GlObject(gl_, GlKind::texture);
    framebuffer_ = GlObject(gl_, GlKind::framebuffer);
    format_ = wanted.internal;
    bytes_per_px_ = wanted.bytes_per_px;
    width_px_ = width;
    height_px_ = height;
    gl_.BindTexture(GL_TEXTURE_2D, texture_.name());
    gl_.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format_), width, height, 0, GL_RGBA,
                   format.floating ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    label(gl_, GL_TEXTURE, texture_.name(), "Seaglare: copy of the picture");
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        texture_.reset();
        throw GlError("target_fbo " + std::to_string(frame.target_fbo) +
                      ": no texture for a copy of its pixels");
    }
}

void TargetReader::copy_background(const Frame& frame, const TargetFormat& format, int x, int y, int width,
                                   int height) {
    gl_.ActiveTexture(GL_TEXTURE2);
    make_texture(frame, format);
    const int from_x = frame.viewport_px[0] + x;
    const int from_y = frame.viewport_px[1] + y;
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, frame.target_fbo);
    GLint read_buffer = GL_NONE;
    gl_.GetIntegerv(GL_READ_BUFFER, &read_buffer);
    GLenum source = format.draw_buffer;
    if (source == GL_FRONT_AND_BACK) source = GL_BACK;
    gl_.ReadBuffer(source);
    if (format.samples > 0) {
        // Decoded, averaged and encoded again where the format is sRGB: the mean is one of light.
        gl_.Enable(GL_FRAMEBUFFER_SRGB);
        gl_.Disable(GL_SCISSOR_TEST);
        gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
        gl_.BlitFramebuffer(from_x, from_y, from_x + width, from_y + height, x, 0, x + width, height,
                            GL_COLOR_BUFFER_BIT, GL_NEAREST);
    } else {
        gl_.BindTexture(GL_TEXTURE_2D, texture_.name());
        gl_.CopyTexSubImage2D(GL_TEXTURE_2D, 0, x, 0, from_x, from_y, width, height);
    }
    gl_.ReadBuffer(static_cast<GLenum>(read_buffer));
}

void TargetReader::forget() {
    texture_.forget();
    framebuffer_.forget();
}

}  // namespace seaglare::glare
