#include "host_stub/contract_check.h"

#include <algorithm>
#include <array>
#include <cfenv>
#include <clocale>
#include <cstring>
#include <sstream>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace seaglare::host {
namespace {

struct Slot {
    const char* name;
    GLenum pname;
    int count;
};
#define SLOT(pname, count)   \
    Slot {                   \
#pname, pname, count \
    }

constexpr std::array slots{SLOT(GL_ACTIVE_TEXTURE, 1),
                           SLOT(GL_ARRAY_BUFFER_BINDING, 1),
                           SLOT(GL_ELEMENT_ARRAY_BUFFER_BINDING, 1),
                           SLOT(GL_UNIFORM_BUFFER_BINDING, 1),
                           SLOT(GL_PIXEL_PACK_BUFFER_BINDING, 1),
                           SLOT(GL_PIXEL_UNPACK_BUFFER_BINDING, 1),
                           SLOT(GL_COPY_READ_BUFFER, 1),
                           SLOT(GL_COPY_WRITE_BUFFER, 1),
                           SLOT(GL_VERTEX_ARRAY_BINDING, 1),
                           SLOT(GL_CURRENT_PROGRAM, 1),
                           SLOT(GL_DRAW_FRAMEBUFFER_BINDING, 1),
                           SLOT(GL_READ_FRAMEBUFFER_BINDING, 1),
                           SLOT(GL_RENDERBUFFER_BINDING, 1),
                           SLOT(GL_DRAW_BUFFER, 1),
                           SLOT(GL_READ_BUFFER, 1),
                           SLOT(GL_BLEND, 1),
                           SLOT(GL_BLEND_SRC_RGB, 1),
                           SLOT(GL_BLEND_DST_RGB, 1),
                           SLOT(GL_BLEND_SRC_ALPHA, 1),
                           SLOT(GL_BLEND_DST_ALPHA, 1),
                           SLOT(GL_BLEND_EQUATION_RGB, 1),
                           SLOT(GL_BLEND_EQUATION_ALPHA, 1),
                           SLOT(GL_BLEND_COLOR, 4),
                           SLOT(GL_COLOR_WRITEMASK, 4),
                           SLOT(GL_COLOR_CLEAR_VALUE, 4),
                           SLOT(GL_COLOR_LOGIC_OP, 1),
                           SLOT(GL_LOGIC_OP_MODE, 1),
                           SLOT(GL_CULL_FACE, 1),
                           SLOT(GL_CULL_FACE_MODE, 1),
                           SLOT(GL_FRONT_FACE, 1),
                           SLOT(GL_POLYGON_MODE, 1),
                           SLOT(GL_DEPTH_TEST, 1),
                           SLOT(GL_DEPTH_FUNC, 1),
                           SLOT(GL_DEPTH_WRITEMASK, 1),
                           SLOT(GL_DEPTH_CLEAR_VALUE, 1),
                           SLOT(GL_DEPTH_RANGE, 2),
                           SLOT(GL_DEPTH_CLAMP, 1),
                           SLOT(GL_DITHER, 1),
                           SLOT(GL_FRAMEBUFFER_SRGB, 1),
                           SLOT(GL_LINE_WIDTH, 1),
                           SLOT(GL_MULTISAMPLE, 1),
                           SLOT(GL_POINT_SIZE, 1),
                           SLOT(GL_PROGRAM_POINT_SIZE, 1),
                           SLOT(GL_POLYGON_OFFSET_FILL, 1),
                           SLOT(GL_POLYGON_OFFSET_FACTOR, 1),
                           SLOT(GL_POLYGON_OFFSET_UNITS, 1),
                           SLOT(GL_PRIMITIVE_RESTART, 1),
                           SLOT(GL_PRIMITIVE_RESTART_INDEX, 1),
                           SLOT(GL_PROVOKING_VERTEX, 1),
                           SLOT(GL_RASTERIZER_DISCARD, 1),
                           SLOT(GL_SAMPLE_ALPHA_TO_COVERAGE, 1),
                           SLOT(GL_SAMPLE_COVERAGE, 1),
                           SLOT(GL_SAMPLE_MASK, 1),
                           SLOT(GL_SCISSOR_TEST, 1),
                           SLOT(GL_SCISSOR_BOX, 4),
                           SLOT(GL_STENCIL_TEST, 1),
                           SLOT(GL_STENCIL_FUNC, 1),
                           SLOT(GL_STENCIL_REF, 1),
                           SLOT(GL_STENCIL_VALUE_MASK, 1),
                           SLOT(GL_STENCIL_WRITEMASK, 1),
                           SLOT(GL_STENCIL_FAIL, 1),
                           SLOT(GL_STENCIL_BACK_FUNC, 1),
                           SLOT(GL_STENCIL_BACK_WRITEMASK, 1),
                           SLOT(GL_STENCIL_CLEAR_VALUE, 1),
                           SLOT(GL_TEXTURE_CUBE_MAP_SEAMLESS, 1),
                           SLOT(GL_VIEWPORT, 4),
                           SLOT(GL_CLIP_DISTANCE0, 1),
                           SLOT(GL_CLIP_DISTANCE1, 1),
                           SLOT(GL_CLAMP_READ_COLOR, 1),
                           SLOT(GL_PACK_ALIGNMENT, 1),
                           SLOT(GL_PACK_ROW_LENGTH, 1),
                           SLOT(GL_PACK_SKIP_ROWS, 1),
                           SLOT(GL_PACK_SKIP_PIXELS, 1),
                           SLOT(GL_PACK_SWAP_BYTES, 1),
                           SLOT(GL_PACK_LSB_FIRST, 1),
                           SLOT(GL_UNPACK_ALIGNMENT, 1),
                           SLOT(GL_UNPACK_ROW_LENGTH, 1),
                           SLOT(GL_UNPACK_IMAGE_HEIGHT, 1),
                           SLOT(GL_UNPACK_SKIP_ROWS, 1),
                           SLOT(GL_UNPACK_SKIP_PIXELS, 1),
                           SLOT(GL_UNPACK_SKIP_IMAGES, 1),
                           SLOT(GL_UNPACK_SWAP_BYTES, 1),
                           SLOT(GL_UNPACK_LSB_FIRST, 1)};
constexpr std::array unit_slots{
    SLOT(GL_TEXTURE_BINDING_2D, 1),        SLOT(GL_TEXTURE_BINDING_2D_ARRAY, 1),
    SLOT(GL_TEXTURE_BINDING_3D, 1),        SLOT(GL_TEXTURE_BINDING_BUFFER, 1),
    SLOT(GL_TEXTURE_BINDING_CUBE_MAP, 1),  SLOT(GL_TEXTURE_BINDING_2D_MULTISAMPLE, 1),
    SLOT(GL_TEXTURE_BINDING_RECTANGLE, 1), SLOT(GL_SAMPLER_BINDING, 1)};
#undef SLOT

}  // namespace

GlState GlState::capture() {
    GlState state;
    const auto add = [&](const std::string& name, const Slot& slot) {
        // As double: all of GL's integers and floats fit without loss.
        std::array<GLdouble, 4> values{};
        glGetDoublev(slot.pname, values.data());
        for (int i = 0; i < slot.count; ++i)
            state.entries_.push_back({slot.count == 1 ? name : name + "[" + std::to_string(i) + "]",
                                      values[static_cast<std::size_t>(i)]});
    };
    for (const Slot& slot : slots)
        add(slot.name, slot);

    GLint units = 0, active = 0, draw_buffers = 0, attributes = 0;
    glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLint u = 0; u < std::min(units, 32); ++u) {
        glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + u));
        for (const Slot& slot : unit_slots)
            add(std::string(slot.name) + " of unit " + std::to_string(u), slot);
    }
    glActiveTexture(static_cast<GLenum>(active));

    glGetIntegerv(GL_MAX_DRAW_BUFFERS, &draw_buffers);
    for (GLint b = 0; b < draw_buffers; ++b) {
        const auto index = static_cast<GLuint>(b);
        const std::string of = " of draw buffer " + std::to_string(b);
        state.entries_.push_back({"GL_BLEND" + of, static_cast<double>(glIsEnabledi(GL_BLEND, index))});
        std::array<GLboolean, 4> mask{};
        glGetBooleani_v(GL_COLOR_WRITEMASK, index, mask.data());
        for (int c = 0; c < 4; ++c)
            state.entries_.push_back({"GL_COLOR_WRITEMASK[" + std::to_string(c) + "]" + of,
                                      static_cast<double>(mask[static_cast<std::size_t>(c)])});
    }
    // Attributes belong to the vertex array that is bound, and to the context: a renderer with its own must not leave traces.
    glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &attributes);
    GLint vertex_array = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array);
    if (vertex_array != 0)
        for (GLint a = 0; a < attributes; ++a) {
            GLint enabled = 0, buffer = 0;
            glGetVertexAttribiv(static_cast<GLuint>(a), GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled);
            glGetVertexAttribiv(static_cast<GLuint>(a), GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &buffer);
            state.entries_.push_back(
                {"enabled attribute " + std::to_string(a), static_cast<double>(enabled)});
            state.entries_.push_back(
                {"buffer of attribute " + std::to_string(a), static_cast<double>(buffer)});
        }
    state.entries_.push_back({"glGetError", static_cast<double>(glGetError())});
    return state;
}

std::vector<std::string> GlState::differences(const GlState& before, const GlState& after) {
    std::vector<std::string> found;
    if (before.entries_.size() != after.entries_.size())
        found.push_back(
            "the number of states changed: another vertex array is bound, or another context current");
    for (std::size_t i = 0; i < std::min(before.entries_.size(), after.entries_.size()); ++i) {
        const Entry &a = before.entries_[i], &b = after.entries_[i];
        if (a.name != b.name || a.value == b.value) continue;
        std::ostringstream text;
        text << a.name << ": " << a.value << " became " << b.value;
        found.push_back(text.str());
    }
    return found;
}

GlPoison::GlPoison()
    : texture_(make_texture()),
      buffer_(make_buffer()),
      vertices_(make_vertex_array()),
      framebuffer_(make_framebuffer()) {
    GLuint sampler = 0;
    glGenSamplers(1, &sampler);
    sampler_ = {sampler, [](GLuint n) { glDeleteSamplers(1, &n); }};
    glSamplerParameteri(sampler_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    for (GLuint unit = 0; unit < 8; ++unit) {
        glBindSampler(unit, sampler_);
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, texture_);
    }
    glActiveTexture(GL_TEXTURE5);
    glBindVertexArray(vertices_);
    for (const GLenum target :
         {GL_ARRAY_BUFFER, GL_UNIFORM_BUFFER, GL_COPY_READ_BUFFER, GL_PIXEL_UNPACK_BUFFER})
        glBindBuffer(target, buffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_DST_COLOR, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_SRC_ALPHA_SATURATE);
    glBlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MIN);
    glBlendColor(0.1F, 0.2F, 0.3F, 0.4F);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glEnable(GL_SCISSOR_TEST);
    glScissor(3, 5, 7, 11);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_NEVER, 3, 0x55);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glDepthRange(0.25, 0.5);
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    glClearColor(0.9F, 0.1F, 0.9F, 0.5F);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2, 3);
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_INVERT);
    glEnable(GL_RASTERIZER_DISCARD);
    glEnable(GL_PRIMITIVE_RESTART);
    glPrimitiveRestartIndex(1);
    glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glViewport(13, 17, 19, 23);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 37);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    glPixelStorei(GL_PACK_ROW_LENGTH, 41);
}

GlPoison::~GlPoison() {
    for (GLuint unit = 0; unit < 8; ++unit) {
        glBindSampler(unit, 0);
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(0);
    for (const GLenum target :
         {GL_ARRAY_BUFFER, GL_UNIFORM_BUFFER, GL_COPY_READ_BUFFER, GL_PIXEL_UNPACK_BUFFER})
        glBindBuffer(target, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    for (const GLenum feature : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST,
                                 GL_POLYGON_OFFSET_FILL, GL_COLOR_LOGIC_OP, GL_RASTERIZER_DISCARD,
                                 GL_PRIMITIVE_RESTART, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_FRAMEBUFFER_SRGB})
        glDisable(feature);
    glBlendFunc(GL_ONE, GL_ZERO);
    glBlendEquation(GL_FUNC_ADD);
    glBlendColor(0, 0, 0, 0);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glStencilFunc(GL_ALWAYS, 0, ~0U);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glDepthRange(0, 1);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPolygonOffset(0, 0);
    glLogicOp(GL_COPY);
    glPrimitiveRestartIndex(0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
}

ProcessState ProcessState::capture() {
    ProcessState state;
    for (int number = 1; number < 32; ++number) {
        struct sigaction action {};
        if (sigaction(number, nullptr, &action) == 0) state.handlers_.emplace_back(number, action);
    }
    state.locale_ = std::setlocale(LC_ALL, nullptr);
    state.rounding_ = std::fegetround();
#if defined(__GLIBC__) && defined(_GNU_SOURCE)
    state.traps_ = fegetexcept();
#endif
#if defined(__SSE__)
    constexpr unsigned sticky_flags = 0x3F;  // these may be raised by any arithmetic
    state.control_ = _mm_getcsr() & ~sticky_flags;
#endif
    return state;
}

std::vector<std::string> ProcessState::differences(const ProcessState& before, const ProcessState& after) {
    // SA_RESTORER is the C library's own: it is there once anybody has called sigaction for the signal.
    constexpr int restorer = 0x04000000;
    std::vector<std::string> found;
    for (std::size_t i = 0; i < std::min(before.handlers_.size(), after.handlers_.size()); ++i) {
        const auto& [number, a] = before.handlers_[i];
        const auto& [same, b] = after.handlers_[i];
        if (a.sa_sigaction != b.sa_sigaction || (a.sa_flags | restorer) != (b.sa_flags | restorer))
            found.push_back("the handler of signal " + std::to_string(number) + " (" + strsignal(number) +
                            ") was replaced");
    }
    if (before.locale_ != after.locale_) found.push_back("the locale became " + after.locale_);
    if (before.rounding_ != after.rounding_) found.emplace_back("the rounding mode changed");
    if (before.traps_ != after.traps_) found.emplace_back("floating-point traps changed");
    if (before.control_ != after.control_) found.emplace_back("the SSE control register changed");
    return found;
}

}  // namespace seaglare::host
