// GL objects that delete themselves, and a program compiled from source. The host draws with libepoxy.
#pragma once

#include <epoxy/gl.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace seaglare::host {

class GlFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A GL name with the function that frees it. The context it was made in must be current when it dies.
class GlName {
  public:
    using Delete = void (*)(GLuint);
    GlName() = default;
    GlName(GLuint name, Delete free) : name_(name), free_(free) {}
    GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)), free_(other.free_) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(name_, other.name_);
        std::swap(free_, other.free_);
        return *this;
    }
    ~GlName() {
        if (name_ != 0) free_(name_);
    }
    operator GLuint() const { return name_; }

  private:
    GLuint name_ = 0;
    Delete free_ = nullptr;
};

GlName make_texture();
GlName make_framebuffer();
GlName make_renderbuffer();
GlName make_buffer();
GlName make_vertex_array();

// Throws GlFailure with the compiler's log.
GlName make_program(std::string_view vertex, std::string_view fragment, std::string_view what);

// Throws GlFailure when GL has an error pending; says at what.
void check_gl(std::string_view what);

}  // namespace seaglare::host
