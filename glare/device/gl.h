// GL entry points of one context, loaded through the host's get_proc. One table per view: contexts of
// different drivers may live in one process, and no symbol of ours can clash with the host's loader.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#define GL_GLEXT_PROTOTYPES  // for the functions' types only: nothing of GL is linked
#include <GL/glcorearb.h>

namespace seaglare::glare {

// A list of macros is set by hand: clang-format 14 never comes to rest on one.
// clang-format off
// Functions of GL 3.3 that we use: create_view fails without them.
#define SEAGLARE_GL_REQUIRED(X) \
    X(ActiveTexture) X(AttachShader) X(BeginQuery) X(BindAttribLocation) X(BindBuffer) X(BindBufferBase) \
    X(BindBufferRange) X(BindFragDataLocation) X(BindFramebuffer) X(BindRenderbuffer) X(BindSampler) \
    X(BindTexture) X(BindVertexArray) X(BlendColor) X(BlendEquation) X(BlendEquationSeparate) X(BlendFunc) \
    X(BlendFuncSeparate) X(BlitFramebuffer) X(BufferData) X(BufferSubData) X(CheckFramebufferStatus) \
    X(ClampColor) X(Clear) X(ClearBufferfv) X(ClearColor) X(ClearDepth) X(ClearStencil) X(ColorMask) \
    X(ColorMaski) X(CompileShader) X(CopyTexSubImage2D) X(CreateProgram) X(CreateShader) X(CullFace) \
    X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteQueries) X(DeleteSamplers) \
    X(DeleteShader) X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(DepthRange) \
    X(Disable) X(DisableVertexAttribArray) X(Disablei) X(DrawArrays) X(DrawArraysInstanced) X(DrawBuffer) \
    X(DrawBuffers) X(Enable) X(EnableVertexAttribArray) X(Enablei) X(EndQuery) X(Finish) X(Flush) \
    X(FramebufferTexture2D) X(FramebufferTextureLayer) X(FrontFace) X(GenBuffers) X(GenFramebuffers) \
    X(GenQueries) X(GenSamplers) X(GenTextures) X(GenVertexArrays) X(GetActiveUniform) X(GetBooleani_v) X(GetBooleanv) \
    X(GetDoublev) X(GetError) X(GetFloatv) X(GetFramebufferAttachmentParameteriv) X(GetInteger64i_v) \
    X(GetIntegeri_v) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv) X(GetQueryiv) X(GetShaderInfoLog) \
    X(GetShaderiv) X(GetString) X(GetStringi) X(GetTexLevelParameteriv) X(GetTexParameteriv) \
    X(GetUniformLocation) X(IsEnabled) X(IsEnabledi) X(IsTexture) X(IsFramebuffer) X(LinkProgram) X(LogicOp) \
    X(PixelStorei) X(PolygonMode) X(PolygonOffset) X(ReadBuffer) X(ReadPixels) X(SampleCoverage) \
    X(SampleMaski) X(SamplerParameteri) X(Scissor) X(ShaderSource) X(StencilFuncSeparate) \
    X(StencilMaskSeparate) X(StencilOpSeparate) X(TexBuffer) X(TexImage2D) X(TexImage3D) X(TexParameteri) \
    X(TexSubImage2D) X(TexSubImage3D) X(Uniform1f) X(Uniform1i) X(Uniform2f) X(Uniform2i) X(Uniform3f) \
    X(Uniform4f) X(Uniform4fv) X(UniformMatrix3fv) X(UniformMatrix4fv) X(UseProgram) X(VertexAttribDivisor) \
    X(VertexAttribPointer) X(Viewport) X(PrimitiveRestartIndex) X(ProvokingVertex) X(PointSize) X(LineWidth) \
    X(Hint) X(IsProgram) X(IsVertexArray) X(BeginConditionalRender) X(EndConditionalRender) \
    X(ClientWaitSync) X(DeleteSync) X(FenceSync) X(MapBufferRange) X(UnmapBuffer)

// Functions of later versions, extensions or the compatibility profile: null where the context has none.
#define SEAGLARE_GL_OPTIONAL(X) \
    X(ClipControl) X(BlendEquationi) X(BlendEquationSeparatei) X(BlendFunci) X(BlendFuncSeparatei) \
    X(PatchParameteri) X(PauseTransformFeedback) X(ResumeTransformFeedback) X(BindProgramPipeline) \
    X(MinSampleShading) X(ViewportIndexedf) X(ScissorIndexed) X(DepthRangeIndexed) X(GetFloati_v) \
    X(GetDoublei_v) X(PushDebugGroup) X(PopDebugGroup) X(GetGraphicsResetStatus) X(QueryCounter) \
    X(GetQueryObjectui64v) X(PolygonOffsetClamp) X(ObjectLabel) X(DebugMessageControl)
// clang-format on

struct Gl {
// A declarator cannot stand in parentheses. NOLINTNEXTLINE(bugprone-macro-parentheses)
#define SEAGLARE_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
    SEAGLARE_GL_REQUIRED(SEAGLARE_GL_MEMBER)
    SEAGLARE_GL_OPTIONAL(SEAGLARE_GL_MEMBER)
#undef SEAGLARE_GL_MEMBER

    int version = 0;             // 33 ... 46
    bool compatibility = false;  // compatibility profile: fixed-function state exists
};

// A GL call or object failed; the message names it.
class GlError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};
// The context is older than GL 3.3.
class GlTooOld : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

using GetProc = void* (*)(void* user, const char* name);
// Needs the context current. Throws GlError naming a missing function, GlTooOld for a context below 3.3.
Gl load_gl(GetProc get_proc, void* user);
// Needs the context current.
bool has_extension(const Gl& gl, std::string_view name);

}  // namespace seaglare::glare
