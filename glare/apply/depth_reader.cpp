#include "glare/apply/depth_reader.h"

#include <algorithm>
#include <cmath>

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

namespace {

// Rounding in the rasteriser and in the host's own transform adds to the format's: two steps are allowed for.
constexpr double steps_of_error = 2;

void set_error(DepthImage& image, int bits, bool floating) {
    if (floating) {
        image.quantum = steps_of_error * std::exp2(-24);
        image.quantum_relative = steps_of_error * std::exp2(-23);
    } else {
        image.quantum = steps_of_error * std::exp2(-bits);
    }
}

struct DepthFormat {
    GLint depth_bits = 0;
    GLint stencil_bits = 0;
    GLint type = 0;
    bool operator==(const DepthFormat&) const = default;
};

// Of the framebuffer bound for reading. 0 depth bits: it has no depth.
DepthFormat attached_format(const Gl& gl, bool window) {
    DepthFormat format;
    const GLenum depth = window ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    const GLenum stencil = window ? GL_STENCIL : GL_STENCIL_ATTACHMENT;
    GLint type = GL_NONE;
    gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, depth, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE,
                                           &type);
    if (type == GL_NONE) return format;
    gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, depth, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE,
                                           &format.depth_bits);
    gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, depth,
                                           GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &format.type);
    gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, stencil,
                                           GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type != GL_NONE) {
        gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, stencil,
                                               GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE, &format.stencil_bits);
    }
    return format;
}

GLenum internal_format(const DepthFormat& format) {
    const bool floating = format.type == GL_FLOAT;
    if (format.stencil_bits > 0) return floating ? GL_DEPTH32F_STENCIL8 : GL_DEPTH24_STENCIL8;
    if (floating) return GL_DEPTH_COMPONENT32F;
    if (format.depth_bits <= 16) return GL_DEPTH_COMPONENT16;
    return format.depth_bits <= 24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT32;
}

double bytes_per_px(GLenum format) {
    return format == GL_DEPTH_COMPONENT16 ? 2 : (format == GL_DEPTH32F_STENCIL8 ? 8 : 4);
}

}  // namespace

DepthImage DepthReader::read(const Frame& frame) {
    switch (frame.depth_source) {
        case DepthSource::texture:
        case DepthSource::texture_ms:
            return texture(frame);
        case DepthSource::fbo:
            return copy(frame);
        case DepthSource::none:
            break;
    }
    return {};
}

DepthImage DepthReader::texture(const Frame& frame) const {
    const bool multisampled = frame.depth_source == DepthSource::texture_ms;
    DepthImage image;
    image.target = multisampled ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    image.texture = frame.depth_object;
    const std::string what = "depth_object " + std::to_string(frame.depth_object);
    if (frame.depth_object == 0 || gl_.IsTexture(frame.depth_object) == GL_FALSE) {
        throw GlError(what + " is not a texture");
    }
    gl_.ActiveTexture(GL_TEXTURE2);
    gl_.BindTexture(image.target, image.texture);
    GLint bound = 0;
    gl_.GetIntegerv(multisampled ? GL_TEXTURE_BINDING_2D_MULTISAMPLE : GL_TEXTURE_BINDING_2D, &bound);
    if (static_cast<GLuint>(bound) != frame.depth_object) {
        throw GlError(what + " is not a " + (multisampled ? "GL_TEXTURE_2D_MULTISAMPLE" : "GL_TEXTURE_2D"));
    }
    const auto level = [&](GLenum parameter) {
        GLint value = 0;
        gl_.GetTexLevelParameteriv(image.target, 0, parameter, &value);
        return value;
    };
    image.width_px = level(GL_TEXTURE_WIDTH);
    image.height_px = level(GL_TEXTURE_HEIGHT);
    if (image.width_px <= 0 || image.height_px <= 0) throw GlError(what + " has no image");
    int bits = level(GL_TEXTURE_DEPTH_SIZE);
    int type = level(GL_TEXTURE_DEPTH_TYPE);
    if (bits == 0) {
        // Some hosts write depth into a red channel.
        bits = level(GL_TEXTURE_RED_SIZE);
        type = level(GL_TEXTURE_RED_TYPE);
    }
    if (bits == 0 || (type != GL_FLOAT && type != GL_UNSIGNED_NORMALIZED)) {
        throw GlError(what + " has neither a depth nor a red channel to read depth from");
    }
    set_error(image, bits, type == GL_FLOAT);
    image.samples = 1;
    if (multisampled) image.samples = std::max(1, level(GL_TEXTURE_SAMPLES));
    image.origin_px[0] = frame.depth_origin_px[0];
    image.origin_px[1] = frame.depth_origin_px[1];
    return image;
}

DepthImage DepthReader::copy(const Frame& frame) {
    const std::string what = "depth_object: framebuffer " + std::to_string(frame.depth_object);
    if (frame.depth_object != 0 && gl_.IsFramebuffer(frame.depth_object) == GL_FALSE) {
        throw GlError(what + " is not a framebuffer");
    }
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, frame.depth_object);
    if (gl_.CheckFramebufferStatus(GL_READ_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw GlError(what + " is not complete");
    }
    const DepthFormat format = attached_format(gl_, frame.depth_object == 0);
    if (format.depth_bits == 0) throw GlError(what + " has no depth");

    const int width = frame.viewport_px[2];
    const int height = frame.viewport_px[3];
    make_copy_target(internal_format(format), width, height, what);
    // GL copies depth only between equal formats, and says so with an error of which the host would not know the
    // origin: the formats are compared instead.
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, copy_framebuffer_.name());
    const DepthFormat own = attached_format(gl_, false);
    if (!(own == format)) {
        throw GlError(what + " has depth of " + std::to_string(format.depth_bits) + " bits and stencil of " +
                      std::to_string(format.stencil_bits) +
                      ", which cannot be copied here: name a depth texture");
    }
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, frame.depth_object);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, copy_framebuffer_.name());
    const int x = frame.depth_origin_px[0];
    const int y = frame.depth_origin_px[1];
    gl_.BlitFramebuffer(x, y, x + width, y + height, 0, 0, width, height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);

    DepthImage image;
    image.texture = copy_texture_.name();
    image.samples = 1;
    image.width_px = width;
    image.height_px = height;
    set_error(image, format.depth_bits, format.type == GL_FLOAT);
    return image;
}

void DepthReader::make_copy_target(GLenum format, int width, int height, const std::string& what) {
    if (copy_texture_ && copy_format_ == format && copy_width_px_ == width && copy_height_px_ == height)
        return;
    copy_texture_ = GlObject(gl_, GlKind::texture);
    copy_framebuffer_ = GlObject(gl_, GlKind::framebuffer);
    copy_format_ = format;
    copy_width_px_ = width;
    copy_height_px_ = height;
    const bool stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    GLenum type = GL_FLOAT;
    if (format == GL_DEPTH24_STENCIL8) type = GL_UNSIGNED_INT_24_8;
    if (format == GL_DEPTH32F_STENCIL8) type = GL_FLOAT_32_UNSIGNED_INT_24_8_REV;
    gl_.ActiveTexture(GL_TEXTURE2);
    gl_.BindTexture(GL_TEXTURE_2D, copy_texture_.name());
    gl_.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0,
                   stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT, type, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    label(gl_, GL_TEXTURE, copy_texture_.name(), "Seaglare: copy of the depth");
    gl_.BindFramebuffer(GL_FRAMEBUFFER, copy_framebuffer_.name());
    gl_.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                             GL_TEXTURE_2D, copy_texture_.name(), 0);
    gl_.DrawBuffer(GL_NONE);
    gl_.ReadBuffer(GL_NONE);
    if (gl_.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        copy_texture_.reset();
        throw GlError(what + ": no texture for a copy of its depth");
    }
}

double DepthReader::memory_bytes() const {
    return copy_texture_ ? bytes_per_px(copy_format_) * copy_width_px_ * copy_height_px_ : 0;
}

void DepthReader::forget() {
    copy_texture_.forget();
    copy_framebuffer_.forget();
}

}  // namespace seaglare::glare
