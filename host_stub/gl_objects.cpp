#include "host_stub/gl_objects.h"

#include <array>

namespace seaglare::host {
namespace {

GlName compile(GLenum kind, std::string_view source, std::string_view what) {
    GlName shader(glCreateShader(kind), [](GLuint n) { glDeleteShader(n); });
    const char* text = source.data();
    const auto length = static_cast<GLint>(source.size());
    glShaderSource(shader, 1, &text, &length);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        std::array<char, 4096> log{};
        glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
        throw GlFailure("shader of " + std::string(what) + " does not compile: " + log.data());
    }
    return shader;
}

}  // namespace

GlName make_texture() {
    GLuint n = 0;
    glGenTextures(1, &n);
    return {n, [](GLuint name) { glDeleteTextures(1, &name); }};
}

GlName make_framebuffer() {
    GLuint n = 0;
    glGenFramebuffers(1, &n);
    return {n, [](GLuint name) { glDeleteFramebuffers(1, &name); }};
}

GlName make_renderbuffer() {
    GLuint n = 0;
    glGenRenderbuffers(1, &n);
    return {n, [](GLuint name) { glDeleteRenderbuffers(1, &name); }};
}

GlName make_buffer() {
    GLuint n = 0;
    glGenBuffers(1, &n);
    return {n, [](GLuint name) { glDeleteBuffers(1, &name); }};
}

GlName make_vertex_array() {
    GLuint n = 0;
    glGenVertexArrays(1, &n);
    return {n, [](GLuint name) { glDeleteVertexArrays(1, &name); }};
}

GlName make_program(std::string_view vertex, std::string_view fragment, std::string_view what) {
    const GlName vs = compile(GL_VERTEX_SHADER, vertex, what);
    const GlName fs = compile(GL_FRAGMENT_SHADER, fragment, what);
    GlName program(glCreateProgram(), [](GLuint n) { glDeleteProgram(n); });
    glAttachShader(program, vs);
    glAttachShader(program, fs);
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        std::array<char, 4096> log{};
        glGetProgramInfoLog(program, log.size(), nullptr, log.data());
        throw GlFailure("program of " + std::string(what) + " does not link: " + log.data());
    }
    return program;
}

void check_gl(std::string_view what) {
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw GlFailure("GL error " + std::to_string(error) + " at " + std::string(what));
}

}  // namespace seaglare::host
