#include "glare/device/gl_debug.h"

namespace seaglare::glare {

void label(const Gl& gl, GLenum identifier, GLuint name, const std::string& text) {
    if (gl.ObjectLabel == nullptr || name == 0) return;
    gl.ObjectLabel(identifier, name, static_cast<GLsizei>(text.size()), text.c_str());
}

OuterDebugGroup::OuterDebugGroup(const Gl& gl, const char* text) : gl_(gl) {
    if (gl.PushDebugGroup == nullptr || gl.PopDebugGroup == nullptr) return;
    GLint depth = 0;
    GLint deepest = 0;
    gl.GetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
    gl.GetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &deepest);
    if (depth + 1 + nested_debug_groups > deepest) return;
    gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, text);
    open_ = true;
    if (gl.DebugMessageControl == nullptr || gl.IsEnabled(GL_DEBUG_OUTPUT) == GL_FALSE) return;
    for (const GLenum type : {GL_DEBUG_TYPE_PUSH_GROUP, GL_DEBUG_TYPE_POP_GROUP}) {
        gl.DebugMessageControl(GL_DEBUG_SOURCE_APPLICATION, type, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    }
}

OuterDebugGroup::~OuterDebugGroup() {
    if (open_) gl_.PopDebugGroup();
}

}  // namespace seaglare::glare
