#include "glare/apply/hdr_buffers.h"

#include <array>
#include <string>

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

void FloatBuffer::resize(GLenum internal_format, int width_px, int height_px, int rows, const char* what) {
    width_px_ = width_px;
    height_px_ = height_px;
    move_to(0, rows);
    if (texture_ && format_ == internal_format && width_px <= allocated_width_ && rows <= allocated_rows_)
        return;
    // Asked for rather than tried: the error that GL would raise is one the host finds and cannot explain.
    GLint largest_px = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_px);
    if (width_px > largest_px || height_px > largest_px) {
        throw GlError(std::string(what) + " of " + std::to_string(width_px) + "x" +
                      std::to_string(height_px) + " pixels: this GL has none larger than " +
                      std::to_string(largest_px));
    }
    texture_ = GlObject(gl_, GlKind::texture);
    framebuffer_ = GlObject(gl_, GlKind::framebuffer);
    format_ = internal_format;
    allocated_width_ = width_px;
    allocated_rows_ = rows;
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, texture_.name());
    gl_.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal_format), width_px, rows, 0, GL_RGBA,
                   GL_FLOAT, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    label(gl_, GL_TEXTURE, texture_.name(), std::string("Seaglare: ") + what);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        texture_.reset();
        throw GlError(std::string(what) + " of " + std::to_string(width_px) + "x" +
                      std::to_string(height_px) + " pixels cannot be made");
    }
}

void FloatBuffer::bind_for_drawing() const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.Viewport(0, -first_row_, width_px_, height_px_);
}

void FloatBuffer::clear() const {
    const std::array<float, 4> zero{};
    gl_.ClearBufferfv(GL_COLOR, 0, zero.data());
}

void FloatBuffer::read(std::span<float> rgba) const {
    if (!texture_ || rgba.size() < static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(rows_) * 4)
        return;
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.ReadPixels(0, 0, width_px_, rows_, GL_RGBA, GL_FLOAT, rgba.data());
}

void FloatBuffer::write(std::span<const float> rgba) const {
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, texture_.name());
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_px_, rows_, GL_RGBA, GL_FLOAT, rgba.data());
}

double FloatBuffer::memory_bytes() const {
    return texture_ ? (format_ == GL_R32F ? 4.0 : 16.0) * allocated_width_ * allocated_rows_ : 0;
}

void FloatBuffer::forget() {
    texture_.forget();
    framebuffer_.forget();
}

void add_coarse_grid(std::span<const float> grid, int grid_width, int cell_px, std::span<float> rgba,
                     int width_px) {
    const auto height_px = static_cast<int>(rgba.size() / 4 / static_cast<std::size_t>(width_px));
    for (int y = 0; y < height_px; ++y) {
        const float at_y = (static_cast<float>(y) + 0.5F) / static_cast<float>(cell_px);
        const int j = static_cast<int>(at_y);
        const float ty = at_y - static_cast<float>(j);
        for (int x = 0; x < width_px; ++x) {
            const float at_x = (static_cast<float>(x) + 0.5F) / static_cast<float>(cell_px);
            const int i = static_cast<int>(at_x);
            const float tx = at_x - static_cast<float>(i);
            const float* const low = &grid[(static_cast<std::size_t>(j) * grid_width + i) * 4];
            const float* const high = low + static_cast<std::size_t>(grid_width) * 4;
            float* const out = &rgba[(static_cast<std::size_t>(y) * width_px + x) * 4];
            for (int c = 0; c < 4; ++c) {
                const float below = low[c] + tx * (low[c + 4] - low[c]);
                const float above = high[c] + tx * (high[c + 4] - high[c]);
                out[c] += below + ty * (above - below);
            }
        }
    }
}

}  // namespace seaglare::glare
