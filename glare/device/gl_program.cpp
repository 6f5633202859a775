#include "glare/device/gl_program.h"

#include <algorithm>
#include <array>
#include <vector>

#include "glare/device/gl_debug.h"
#include "shaders/embedded.h"

namespace seaglare::glare {

namespace {

class Shader {
  public:
    Shader(const Gl& gl, GLenum type) : gl_(gl), name_(gl.CreateShader(type)) {}
    ~Shader() { gl_.DeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    GLuint name() const { return name_; }

  private:
    const Gl& gl_;
    GLuint name_;
};

void compile(const Gl& gl, const Shader& shader, std::string_view program,
             std::initializer_list<std::string_view> files, std::string_view defines) {
    std::string text = "#version 330 core\n";
    text += defines;
    for (const std::string_view file : files) {
        const std::string_view part = shaders::source(file);
        if (part.empty()) throw GlError("shader file " + std::string(file) + " is not in the library");
        text += part;
        text += '\n';
    }
    const char* const start = text.c_str();
    gl.ShaderSource(shader.name(), 1, &start, nullptr);
    gl.CompileShader(shader.name());
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return;
    std::array<char, 2048> log{};
    gl.GetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw GlError("shader program " + std::string(program) + " (" + std::string(*(files.end() - 1)) +
                  ") does not compile: " + log.data());
}

}  // namespace

GlProgram::GlProgram(const Gl& gl, std::string_view name,
                     std::initializer_list<std::string_view> vertex_files,
                     std::initializer_list<std::string_view> fragment_files, std::string_view defines)
    : gl_(&gl), object_(gl, GlKind::program) {
    const Shader vertex(gl, GL_VERTEX_SHADER);
    const Shader fragment(gl, GL_FRAGMENT_SHADER);
    compile(gl, vertex, name, vertex_files, defines);
    compile(gl, fragment, name, fragment_files, defines);
    gl.AttachShader(object_.name(), vertex.name());
    gl.AttachShader(object_.name(), fragment.name());
    gl.LinkProgram(object_.name());
    GLint linked = GL_FALSE;
    gl.GetProgramiv(object_.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) {
        label(gl, GL_PROGRAM, object_.name(), "Seaglare: " + std::string(name));
        list_uniforms();
        return;
    }
    std::array<char, 2048> log{};
    gl.GetProgramInfoLog(object_.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw GlError("shader program " + std::string(name) + " does not link: " + log.data());
}

void GlProgram::list_uniforms() {
    GLint count = 0;
    gl_->GetProgramiv(object_.name(), GL_ACTIVE_UNIFORMS, &count);
    std::array<char, 128> name{};
    for (GLint i = 0; i < count; ++i) {
        GLsizei length = 0;
        GLint size = 0;
        GLenum type = GL_NONE;
        gl_->GetActiveUniform(object_.name(), static_cast<GLuint>(i), static_cast<GLsizei>(name.size()),
                              &length, &size, &type, name.data());
        const std::string_view whole(name.data(), static_cast<std::size_t>(length));
        const GLint location = gl_->GetUniformLocation(object_.name(), name.data());
        uniforms_.push_back({std::string(whole.substr(0, whole.find('['))), location});
    }
    std::sort(uniforms_.begin(), uniforms_.end(),
              [](const Uniform& a, const Uniform& b) { return a.name < b.name; });
}

GLint GlProgram::location(std::string_view uniform) const {
    const auto found = std::lower_bound(uniforms_.begin(), uniforms_.end(), uniform,
                                        [](const Uniform& a, std::string_view b) { return a.name < b; });
    return found != uniforms_.end() && found->name == uniform ? found->location : -1;
}

}  // namespace seaglare::glare
