#include "glare/device/gl.h"

namespace seaglare::glare {

namespace {

template <typename Function>
Function load(GetProc get_proc, void* user, const char* name) {
    // Functions and object pointers have one representation on every platform that has GL.
    return reinterpret_cast<Function>(get_proc(user, name));
}

}  // namespace

Gl load_gl(GetProc get_proc, void* user) {
    Gl gl;
#define SEAGLARE_GL_LOAD(name) gl.name = load<decltype(gl.name)>(get_proc, user, "gl" #name);
    SEAGLARE_GL_LOAD(GetIntegerv)
    if (gl.GetIntegerv == nullptr) throw GlError("get_proc returned NULL for glGetIntegerv");
    GLint major = 0;
    GLint minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    gl.version = major * 10 + minor;
    if (gl.version < 33) {
        throw GlTooOld("the GL context is version " + std::to_string(major) + "." + std::to_string(minor) +
                       ": 3.3 or later is needed (0.0 means that no context is current)");
    }
    GLint profile = 0;
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    gl.compatibility = (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
    SEAGLARE_GL_REQUIRED(SEAGLARE_GL_LOAD)
    SEAGLARE_GL_OPTIONAL(SEAGLARE_GL_LOAD)
#undef SEAGLARE_GL_LOAD
#define SEAGLARE_GL_CHECK(name) \
    if (gl.name == nullptr) throw GlError("get_proc returned NULL for gl" #name);
    SEAGLARE_GL_REQUIRED(SEAGLARE_GL_CHECK)
#undef SEAGLARE_GL_CHECK
    // A get_proc may return an address for a function that the context does not have.
    if (gl.version < 43 && !has_extension(gl, "GL_KHR_debug")) {
        gl.PushDebugGroup = nullptr;
        gl.PopDebugGroup = nullptr;
        gl.ObjectLabel = nullptr;
        gl.DebugMessageControl = nullptr;
    }
    return gl;
}

bool has_extension(const Gl& gl, std::string_view name) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const auto* known =
            reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
        if (known != nullptr && name == known) return true;
    }
    return false;
}

}  // namespace seaglare::glare
