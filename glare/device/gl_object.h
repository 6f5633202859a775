// Names of GL objects that delete themselves.
#pragma once

#include <utility>

#include "glare/device/gl.h"

namespace seaglare::glare {

enum class GlKind { buffer, texture, framebuffer, vertex_array, sampler, program };

class GlObject {
  public:
    GlObject() = default;
    // Generates a name. Needs the context current, as does the destructor unless forget() was called.
    GlObject(const Gl& gl, GlKind kind) : gl_(&gl), kind_(kind) {
        switch (kind) {
            case GlKind::buffer:
                gl.GenBuffers(1, &name_);
                break;
            case GlKind::texture:
                gl.GenTextures(1, &name_);
                break;
            case GlKind::framebuffer:
                gl.GenFramebuffers(1, &name_);
                break;
            case GlKind::vertex_array:
                gl.GenVertexArrays(1, &name_);
                break;
            case GlKind::sampler:
                gl.GenSamplers(1, &name_);
                break;
            case GlKind::program:
                name_ = gl.CreateProgram();
                break;
        }
    }
    ~GlObject() { reset(); }
    GlObject(GlObject&& other) noexcept
        : gl_(other.gl_), kind_(other.kind_), name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        if (this != &other) {
            reset();
            gl_ = other.gl_;
            kind_ = other.kind_;
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }
    // The context is gone: the name means nothing any more.
    void forget() { name_ = 0; }
    void reset() {
        if (name_ == 0) return;
        switch (kind_) {
            case GlKind::buffer:
                gl_->DeleteBuffers(1, &name_);
                break;
            case GlKind::texture:
                gl_->DeleteTextures(1, &name_);
                break;
            case GlKind::framebuffer:
                gl_->DeleteFramebuffers(1, &name_);
                break;
            case GlKind::vertex_array:
                gl_->DeleteVertexArrays(1, &name_);
                break;
            case GlKind::sampler:
                gl_->DeleteSamplers(1, &name_);
                break;
            case GlKind::program:
                gl_->DeleteProgram(name_);
                break;
        }
        name_ = 0;
    }

  private:
    const Gl* gl_ = nullptr;
    GlKind kind_ = GlKind::buffer;
    GLuint name_ = 0;
};

}  // namespace seaglare::glare
