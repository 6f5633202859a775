// A linked shader program from the embedded sources.
#pragma once

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

    // Set a uniform of the program in use; a name that the compiler dropped is ignored, as GL does. Locations are looked
    // up in a table of our own: no call waits for a driver's thread, nothing is allocated.
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
    // The first elements of an array of vec4.
    void set(const char* uniform, std::span<const std::array<float, 4>> values) const {
        gl_->Uniform4fv(location(uniform), static_cast<GLsizei>(values.size()), values.data()->data());
    }
    // -1 for a name that the program does not use. An array goes by its name without brackets.
    GLint location(std::string_view uniform) const;
    const Gl& gl() const { return *gl_; }

  private:
    struct Uniform {
        std::string name;
        GLint location = -1;
    };
    void list_uniforms();

    const Gl* gl_ = nullptr;
    GlObject object_;
    std::vector<Uniform> uniforms_;  // by name
};

}  // namespace seaglare::glare
