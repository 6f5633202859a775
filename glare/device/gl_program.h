// A linked shader program from the embedded sources.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "glare/device/gl_object.h"

namespace seaglare::glare {

class GlProgram {
  public:
    GlProgram() = default;
    // The files of shaders/ named are joined in order after "#version 330 core" and `defines`. Throws GlError with the
    // program's name and the compiler's log.
    GlProgram(const Gl& gl, std::string_view name, std::initializer_list<std::string_view> vertex_files,
              std::initializer_list<std::string_view> fragment_files, std::string_view defines = {});

    void use() const { gl_->UseProgram(object_.name()); }
    void forget() { object_.forget(); }

    // Set a uniform of the program in use; a name that the compiler dropped is ignored, as GL does.
    void set(const char* uniform, int value) const { gl_->Uniform1i(location(uniform), value); }
    void set(const char* uniform, double value) const {
        gl_->Uniform1f(location(uniform), static_cast<float>(value));
    }
    void set(const char* uniform, int x, int y) const { gl_->Uniform2i(location(uniform), x, y); }
    void set(const char* uniform, double x, double y) const {
        gl_->Uniform2f(location(uniform), static_cast<float>(x), static_cast<float>(y));
    }
    void set(const char* uniform, double x, double y, double z) const {
        gl_->Uniform3f(location(uniform), static_cast<float>(x), static_cast<float>(y),
                       static_cast<float>(z));
    }
    void set(const char* uniform, double x, double y, double z, double w) const {
        gl_->Uniform4f(location(uniform), static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
                       static_cast<float>(w));
    }
    GLint location(const char* uniform) const { return gl_->GetUniformLocation(object_.name(), uniform); }
    const Gl& gl() const { return *gl_; }

  private:
    const Gl* gl_ = nullptr;
    GlObject object_;
};

}  // namespace seaglare::glare
