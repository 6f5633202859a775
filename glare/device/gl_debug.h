// Names for GL debuggers (KHR_debug, core in GL 4.3): groups around passes, labels on objects. Without it all of this does
// nothing (load_gl leaves the functions null). Needs the context current.
#pragma once

#include <string>

#include "glare/device/gl.h"

namespace seaglare::glare {

// Names an object that exists: a texture or buffer must have been bound once. `identifier` as glObjectLabel takes it.
void label(const Gl& gl, GLenum identifier, GLuint name, const std::string& text);

// The group around all that we draw in a frame. The host's debug callback hears of this one alone: the messages of groups
// within it are switched off, in the way that GL takes back when the group ends.
class OuterDebugGroup {
  public:
    // Room for the groups within it is asked for here, so that none of them makes a GL error.
    OuterDebugGroup(const Gl& gl, const char* text);
    ~OuterDebugGroup();
    OuterDebugGroup(const OuterDebugGroup&) = delete;
    OuterDebugGroup& operator=(const OuterDebugGroup&) = delete;
    // False without KHR_debug, and where the host has the stack of groups full: no group may be opened then.
    bool open() const { return open_; }

  private:
    const Gl& gl_;
    bool open_ = false;
};

// How deep groups may nest within the outer one.
inline constexpr int nested_debug_groups = 4;

}  // namespace seaglare::glare
