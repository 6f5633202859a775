#include "tests/gl/gl_snapshot.h"

#include <array>
#include <initializer_list>
#include <sstream>
#include <stdexcept>

namespace seaglare::test {

namespace {

using glare::Gl;

constexpr int units = 12;  // more than Seaglare saves: it must not touch the others
constexpr int draw_buffers = 8;

// Of the compatibility profile; values from the Khronos registry, gl.xml.
constexpr GLenum alpha_test = 0x0BC0, alpha_test_func = 0x0BC1, alpha_test_ref = 0x0BC2,
                 polygon_stipple = 0x0B42;
constexpr GLenum index_logic_op = 0x0BF1, clamp_vertex_color = 0x891A, clamp_fragment_color = 0x891B;
constexpr GLenum red_scale = 0x0D14, blue_bias = 0x0D1B, map_color = 0x0D10, depth_scale = 0x0D1E;
constexpr GLenum fog = 0x0B60, lighting = 0x0B50, point_sprite = 0x8861, matrix_mode = 0x0BA0,
                 current_color = 0x0B00;
constexpr GLenum client_active_texture = 0x84E1, shade_model = 0x0B54;

template <class Function>
Function function(const char* name) {
    auto* address = reinterpret_cast<Function>(HeadlessContext::get_proc(nullptr, name));
    if (address == nullptr) throw std::runtime_error(std::string("no function ") + name);
    return address;
}

class Recorder {
  public:
    Recorder(const Gl& gl, GlSnapshot& out) : gl_(gl), out_(out) {}

    void floats(const char* name, GLenum what, int count) {
        std::array<GLfloat, 16> v{};
        gl_.GetFloatv(what, v.data());
        put(name, v.data(), count);
    }
    void integers(const char* name, GLenum what, int count = 1) {
        std::array<GLint, 16> v{};
        gl_.GetIntegerv(what, v.data());
        put(name, v.data(), count);
    }
    void indexed(const std::string& name, GLenum what, GLuint index, int count = 1) {
        std::array<GLint, 16> v{};
        gl_.GetIntegeri_v(what, index, v.data());
        put(name + "[" + std::to_string(index) + "]", v.data(), count);
    }
    void enabled(const char* name, GLenum what) { out_[name] = {static_cast<double>(gl_.IsEnabled(what))}; }
    void enabled(const std::string& name, GLenum what, GLuint index) {
        out_[name + "[" + std::to_string(index) + "]"] = {static_cast<double>(gl_.IsEnabledi(what, index))};
    }

  private:
    template <class T>
    void put(const std::string& name, const T* values, int count) {
        out_[name] = std::vector<double>(values, values + count);
    }
    const Gl& gl_;
    GlSnapshot& out_;
};

#define SNAP_INTEGER(name) record.integers(#name, name)
#define SNAP_ENABLED(name) record.enabled(#name, name)

void snap_bindings(const Gl& gl, Recorder& record) {
    for (const auto& [name, what] : std::initializer_list<std::pair<const char*, GLenum>>{
             {"draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING},
             {"read framebuffer", GL_READ_FRAMEBUFFER_BINDING},
             {"renderbuffer", GL_RENDERBUFFER_BINDING},
             {"program", GL_CURRENT_PROGRAM},
             {"vertex array", GL_VERTEX_ARRAY_BINDING},
             {"array buffer", GL_ARRAY_BUFFER_BINDING},
             {"element array buffer", GL_ELEMENT_ARRAY_BUFFER_BINDING},
             {"pixel pack buffer", GL_PIXEL_PACK_BUFFER_BINDING},
             {"pixel unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING},
             {"uniform buffer", GL_UNIFORM_BUFFER_BINDING},
             {"texture buffer", GL_TEXTURE_BUFFER_BINDING},
             {"copy read buffer", GL_COPY_READ_BUFFER_BINDING},
             {"copy write buffer", GL_COPY_WRITE_BUFFER_BINDING},
             {"transform feedback buffer", GL_TRANSFORM_FEEDBACK_BUFFER_BINDING},
             {"read buffer of the read framebuffer", GL_READ_BUFFER},
             {"active texture", GL_ACTIVE_TEXTURE}}) {
        record.integers(name, what);
    }
    if (gl.version >= 41) record.integers("program pipeline", GL_PROGRAM_PIPELINE_BINDING);
    if (gl.version >= 43) {
        record.integers("depth of debug groups", GL_DEBUG_GROUP_STACK_DEPTH);
        record.integers("debug messages waiting", GL_DEBUG_LOGGED_MESSAGES);
        record.enabled("debug output", GL_DEBUG_OUTPUT);
        record.enabled("synchronous debug output", GL_DEBUG_OUTPUT_SYNCHRONOUS);
    }
    for (GLuint i = 0; i < 4; ++i)
        record.indexed("indexed uniform buffer", GL_UNIFORM_BUFFER_BINDING, i);
    for (int i = 0; i < draw_buffers; ++i)
        record.integers(("draw buffer " + std::to_string(i)).c_str(),
                        GL_DRAW_BUFFER0 + static_cast<GLenum>(i));
}

void snap_textures(const Gl& gl, Recorder& record) {
    GLint active = 0;
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (int unit = 0; unit < units; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        const std::string suffix = " of unit " + std::to_string(unit);
        for (const auto& [name, what] : std::initializer_list<std::pair<const char*, GLenum>>{
                 {"texture 1D", GL_TEXTURE_BINDING_1D},
                 {"texture 2D", GL_TEXTURE_BINDING_2D},
                 {"texture 3D", GL_TEXTURE_BINDING_3D},
                 {"texture 2D array", GL_TEXTURE_BINDING_2D_ARRAY},
                 {"texture cube", GL_TEXTURE_BINDING_CUBE_MAP},
                 {"texture rectangle", GL_TEXTURE_BINDING_RECTANGLE},
                 {"texture 2D multisample", GL_TEXTURE_BINDING_2D_MULTISAMPLE},
                 {"texture buffer object", GL_TEXTURE_BINDING_BUFFER},
                 {"sampler", GL_SAMPLER_BINDING}}) {
            record.integers((name + suffix).c_str(), what);
        }
    }
    gl.ActiveTexture(static_cast<GLenum>(active));
}

void snap_raster(const Gl& gl, Recorder& record) {
    for (GLuint i = 0; i < draw_buffers; ++i) {
        record.enabled("blend", GL_BLEND, i);
        record.indexed("colour mask", GL_COLOR_WRITEMASK, i, 4);
        if (gl.version < 40) continue;
        record.indexed("blend source rgb", GL_BLEND_SRC_RGB, i);
        record.indexed("blend destination rgb", GL_BLEND_DST_RGB, i);
        record.indexed("blend source alpha", GL_BLEND_SRC_ALPHA, i);
        record.indexed("blend destination alpha", GL_BLEND_DST_ALPHA, i);
        record.indexed("blend equation rgb", GL_BLEND_EQUATION_RGB, i);
        record.indexed("blend equation alpha", GL_BLEND_EQUATION_ALPHA, i);
    }
    SNAP_INTEGER(GL_BLEND_SRC_RGB);
    SNAP_INTEGER(GL_BLEND_DST_RGB);
    SNAP_INTEGER(GL_BLEND_SRC_ALPHA);
    SNAP_INTEGER(GL_BLEND_DST_ALPHA);
    SNAP_INTEGER(GL_BLEND_EQUATION_RGB);
    SNAP_INTEGER(GL_BLEND_EQUATION_ALPHA);
    record.floats("blend colour", GL_BLEND_COLOR, 4);
    record.floats("clear colour", GL_COLOR_CLEAR_VALUE, 4);
    record.floats("clear depth", GL_DEPTH_CLEAR_VALUE, 1);
    SNAP_INTEGER(GL_STENCIL_CLEAR_VALUE);
    SNAP_INTEGER(GL_DEPTH_WRITEMASK);
    SNAP_INTEGER(GL_DEPTH_FUNC);
    SNAP_INTEGER(GL_STENCIL_FUNC);
    SNAP_INTEGER(GL_STENCIL_REF);
    SNAP_INTEGER(GL_STENCIL_VALUE_MASK);
    SNAP_INTEGER(GL_STENCIL_WRITEMASK);
    SNAP_INTEGER(GL_STENCIL_BACK_WRITEMASK);
    SNAP_INTEGER(GL_STENCIL_FAIL);
    SNAP_INTEGER(GL_CULL_FACE_MODE);
    SNAP_INTEGER(GL_FRONT_FACE);
    SNAP_INTEGER(GL_LOGIC_OP_MODE);
    record.floats("depth range", GL_DEPTH_RANGE, 2);
    record.floats("polygon offset factor", GL_POLYGON_OFFSET_FACTOR, 1);
    record.floats("polygon offset units", GL_POLYGON_OFFSET_UNITS, 1);
    record.floats("line width", GL_LINE_WIDTH, 1);
    record.floats("point size", GL_POINT_SIZE, 1);
    record.integers("polygon mode", GL_POLYGON_MODE, gl.compatibility ? 2 : 1);
    record.floats("sample coverage", GL_SAMPLE_COVERAGE_VALUE, 1);
    SNAP_INTEGER(GL_SAMPLE_COVERAGE_INVERT);
    SNAP_INTEGER(GL_PROVOKING_VERTEX);
    SNAP_INTEGER(GL_CLAMP_READ_COLOR);
    record.indexed("sample mask", GL_SAMPLE_MASK_VALUE, 0);
    SNAP_INTEGER(GL_PRIMITIVE_RESTART_INDEX);

    SNAP_ENABLED(GL_DEPTH_TEST);
    SNAP_ENABLED(GL_STENCIL_TEST);
    SNAP_ENABLED(GL_CULL_FACE);
    SNAP_ENABLED(GL_COLOR_LOGIC_OP);
    SNAP_ENABLED(GL_RASTERIZER_DISCARD);
    SNAP_ENABLED(GL_DITHER);
    SNAP_ENABLED(GL_FRAMEBUFFER_SRGB);
    SNAP_ENABLED(GL_MULTISAMPLE);
    SNAP_ENABLED(GL_SAMPLE_ALPHA_TO_COVERAGE);
    SNAP_ENABLED(GL_SAMPLE_ALPHA_TO_ONE);
    SNAP_ENABLED(GL_SAMPLE_COVERAGE);
    SNAP_ENABLED(GL_SAMPLE_MASK);
    SNAP_ENABLED(GL_PRIMITIVE_RESTART);
    SNAP_ENABLED(GL_PROGRAM_POINT_SIZE);
    SNAP_ENABLED(GL_POLYGON_SMOOTH);
    SNAP_ENABLED(GL_LINE_SMOOTH);
    SNAP_ENABLED(GL_POLYGON_OFFSET_FILL);
    SNAP_ENABLED(GL_POLYGON_OFFSET_LINE);
    SNAP_ENABLED(GL_POLYGON_OFFSET_POINT);
    SNAP_ENABLED(GL_DEPTH_CLAMP);
    SNAP_ENABLED(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    for (GLuint i = 0; i < 8; ++i)
        record.enabled(("clip distance " + std::to_string(i)).c_str(), GL_CLIP_DISTANCE0 + i);
    if (gl.version >= 40) {
        SNAP_ENABLED(GL_SAMPLE_SHADING);
        record.floats("min sample shading", GL_MIN_SAMPLE_SHADING_VALUE, 1);
        SNAP_INTEGER(GL_PATCH_VERTICES);
    }
    if (gl.version >= 43) {
        SNAP_ENABLED(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    }
    if (gl.version >= 45) {
        SNAP_INTEGER(GL_CLIP_ORIGIN);
        SNAP_INTEGER(GL_CLIP_DEPTH_MODE);
    }
    record.integers("viewport", GL_VIEWPORT, 4);
    record.integers("scissor box", GL_SCISSOR_BOX, 4);
    SNAP_ENABLED(GL_SCISSOR_TEST);
    if (gl.version >= 41) {
        for (GLuint i = 0; i < 16; ++i) {
            record.indexed("viewport", GL_VIEWPORT, i, 4);
            record.indexed("scissor box", GL_SCISSOR_BOX, i, 4);
            record.enabled("scissor test", GL_SCISSOR_TEST, i);
        }
    }
}

void snap_pixel_store(Recorder& record) {
    SNAP_INTEGER(GL_UNPACK_SWAP_BYTES);
    SNAP_INTEGER(GL_UNPACK_LSB_FIRST);
    SNAP_INTEGER(GL_UNPACK_ROW_LENGTH);
    SNAP_INTEGER(GL_UNPACK_IMAGE_HEIGHT);
    SNAP_INTEGER(GL_UNPACK_SKIP_ROWS);
    SNAP_INTEGER(GL_UNPACK_SKIP_PIXELS);
    SNAP_INTEGER(GL_UNPACK_SKIP_IMAGES);
    SNAP_INTEGER(GL_UNPACK_ALIGNMENT);
    SNAP_INTEGER(GL_PACK_SWAP_BYTES);
    SNAP_INTEGER(GL_PACK_LSB_FIRST);
    SNAP_INTEGER(GL_PACK_ROW_LENGTH);
    SNAP_INTEGER(GL_PACK_IMAGE_HEIGHT);
    SNAP_INTEGER(GL_PACK_SKIP_ROWS);
    SNAP_INTEGER(GL_PACK_SKIP_PIXELS);
    SNAP_INTEGER(GL_PACK_SKIP_IMAGES);
    SNAP_INTEGER(GL_PACK_ALIGNMENT);
}

void snap_legacy(Recorder& record) {
    SNAP_ENABLED(alpha_test);
    SNAP_ENABLED(polygon_stipple);
    SNAP_ENABLED(index_logic_op);
    SNAP_ENABLED(fog);
    SNAP_ENABLED(lighting);
    SNAP_ENABLED(point_sprite);
    SNAP_INTEGER(alpha_test_func);
    SNAP_INTEGER(clamp_vertex_color);
    SNAP_INTEGER(clamp_fragment_color);
    SNAP_INTEGER(map_color);
    SNAP_INTEGER(matrix_mode);
    SNAP_INTEGER(client_active_texture);
    SNAP_INTEGER(shade_model);
    record.floats("alpha test ref", alpha_test_ref, 1);
    record.floats("red scale", red_scale, 1);
    record.floats("blue bias", blue_bias, 1);
    record.floats("depth scale", depth_scale, 1);
    record.floats("current colour", current_color, 4);
}

GLuint make_program(const Gl& gl) {
    const auto compile = [&](GLenum type, const char* source) {
        const GLuint shader = gl.CreateShader(type);
        gl.ShaderSource(shader, 1, &source, nullptr);
        gl.CompileShader(shader);
        return shader;
    };
    const GLuint program = gl.CreateProgram();
    gl.AttachShader(program,
                    compile(GL_VERTEX_SHADER, "#version 330 core\nvoid main() { gl_Position = vec4(0); }"));
    gl.AttachShader(
        program,
        compile(GL_FRAGMENT_SHADER, "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1, 0, 1, 1); }"));
    gl.LinkProgram(program);
    return program;
}

void poison_objects(const Gl& gl, GLuint program) {
    std::array<GLuint, 8> buffers{};
    gl.GenBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
    std::size_t next = 0;
    GLuint vertex_array = 0;
    gl.GenVertexArrays(1, &vertex_array);
    gl.BindVertexArray(vertex_array);
    for (const GLenum target :
         {GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER,
          GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_TEXTURE_BUFFER}) {
        gl.BindBuffer(target, buffers[next++]);
        gl.BufferData(target, 4096, nullptr, GL_STATIC_DRAW);
    }
    gl.BindBuffer(GL_UNIFORM_BUFFER, buffers[next]);
    gl.BufferData(GL_UNIFORM_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, buffers[next]);
    gl.BindBufferRange(GL_UNIFORM_BUFFER, 2, buffers[next], 256, 512);
    gl.UseProgram(program);

    std::array<GLuint, 2> samplers{};
    gl.GenSamplers(2, samplers.data());
    gl.SamplerParameteri(samplers[0], GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.SamplerParameteri(samplers[1], GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    for (int unit = 0; unit < units; ++unit) {
        gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        for (const GLenum target :
             {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP,
              GL_TEXTURE_RECTANGLE, GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BUFFER}) {
            GLuint texture = 0;
            gl.GenTextures(1, &texture);
            gl.BindTexture(target, texture);
        }
        gl.BindSampler(static_cast<GLuint>(unit), samplers[static_cast<std::size_t>(unit % 2)]);
    }
    gl.ActiveTexture(GL_TEXTURE0 + 5);

    // Two framebuffers of the host's own: one that is drawn to with two colours, one that is read from without any.
    std::array<GLuint, 2> framebuffers{};
    gl.GenFramebuffers(2, framebuffers.data());
    std::array<GLuint, 2> colours{};
    gl.GenTextures(2, colours.data());
    gl.ActiveTexture(GL_TEXTURE0 + 11);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers[0]);
    for (GLuint i = 0; i < 2; ++i) {
        gl.BindTexture(GL_TEXTURE_2D, colours[i]);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + i, GL_TEXTURE_2D, colours[i], 0);
    }
    const std::array<GLenum, 2> drawn = {GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT0};
    gl.DrawBuffers(2, drawn.data());
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers[1]);
    gl.ReadBuffer(GL_NONE);
    gl.ActiveTexture(GL_TEXTURE0 + 5);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers[3]);
    GLuint renderbuffer = 0;
    function<void (*)(GLsizei, GLuint*)>("glGenRenderbuffers")(1, &renderbuffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
}

void poison_raster(const Gl& gl) {
    for (GLuint i = 0; i < draw_buffers; ++i) {
        if (i % 2 == 0) gl.Enablei(GL_BLEND, i);
        gl.ColorMaski(i, i % 2 == 0 ? GL_FALSE : GL_TRUE, GL_TRUE, GL_FALSE, i % 3 == 0 ? GL_TRUE : GL_FALSE);
    }
    gl.BlendFuncSeparate(GL_DST_COLOR, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR, GL_ZERO);
    gl.BlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
    if (gl.version >= 40) {
        gl.BlendFuncSeparatei(3, GL_ZERO, GL_SRC_COLOR, GL_ONE, GL_ONE);
        gl.BlendEquationSeparatei(3, GL_MIN, GL_FUNC_SUBTRACT);
        gl.Enable(GL_SAMPLE_SHADING);
        gl.MinSampleShading(0.75F);
        gl.PatchParameteri(GL_PATCH_VERTICES, 5);
    }
    gl.BlendColor(0.1F, 0.2F, 0.3F, 0.4F);
    gl.ClearColor(0.9F, 0.8F, 0.7F, 0.6F);
    gl.ClearDepth(0.25);
    gl.ClearStencil(3);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_NEVER);
    gl.DepthMask(GL_TRUE);
    gl.DepthRange(0.75, 0.25);
    gl.Enable(GL_DEPTH_CLAMP);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFuncSeparate(GL_FRONT_AND_BACK, GL_NEVER, 5, 0x0F);
    gl.StencilMaskSeparate(GL_FRONT_AND_BACK, 0x35);
    gl.StencilOpSeparate(GL_FRONT_AND_BACK, GL_INVERT, GL_ZERO, GL_REPLACE);
    gl.Enable(GL_CULL_FACE);
    gl.CullFace(GL_FRONT_AND_BACK);
    gl.FrontFace(GL_CW);
    gl.Enable(GL_COLOR_LOGIC_OP);
    gl.LogicOp(GL_XOR);
    gl.Enable(GL_RASTERIZER_DISCARD);
    gl.Disable(GL_DITHER);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    gl.Disable(GL_MULTISAMPLE);
    for (const GLenum name : {GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE,
                              GL_SAMPLE_MASK, GL_PRIMITIVE_RESTART, GL_PROGRAM_POINT_SIZE, GL_POLYGON_SMOOTH,
                              GL_LINE_SMOOTH, GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE,
                              GL_POLYGON_OFFSET_POINT, GL_TEXTURE_CUBE_MAP_SEAMLESS, GL_SCISSOR_TEST}) {
        gl.Enable(name);
    }
    gl.SampleCoverage(0.25F, GL_TRUE);
    gl.SampleMaski(0, 0x5);
    gl.PrimitiveRestartIndex(2);
    gl.PolygonOffset(3, 5);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl.PointSize(7);
    gl.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    gl.ClampColor(GL_CLAMP_READ_COLOR, GL_TRUE);
    for (GLuint i = 0; i < 8; ++i)
        gl.Enable(GL_CLIP_DISTANCE0 + i);
    if (gl.version >= 43) gl.Enable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    if (gl.version >= 45) gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl.Viewport(3, 5, 7, 11);
    gl.Scissor(2, 1, 1, 2);
    if (gl.version >= 41) {
        gl.ViewportIndexedf(4, 1.5F, 2.5F, 10, 20);
        gl.ScissorIndexed(4, 9, 8, 7, 6);
        gl.Disablei(GL_SCISSOR_TEST, 4);
    }
    for (const GLenum name :
         {GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST})
        gl.PixelStorei(name, 1);
    for (const GLenum name :
         {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
          GL_UNPACK_SKIP_IMAGES, GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_ROWS,
          GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES}) {
        gl.PixelStorei(name, 3);
    }
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 2);
}

void poison_legacy(const Gl& gl) {
    for (const GLenum name : {alpha_test, polygon_stipple, fog, lighting, point_sprite})
        gl.Enable(name);
    function<void (*)(GLenum, GLfloat)>("glAlphaFunc")(GL_GREATER, 0.9F);
    gl.ClampColor(clamp_vertex_color, GL_TRUE);
    gl.ClampColor(clamp_fragment_color, GL_TRUE);
    const auto transfer = function<void (*)(GLenum, GLfloat)>("glPixelTransferf");
    transfer(red_scale, 0.25F);
    transfer(blue_bias, 0.5F);
    transfer(depth_scale, 0.5F);
    transfer(map_color, 1);
    gl.PolygonMode(GL_FRONT, GL_POINT);
    gl.PolygonMode(GL_BACK, GL_LINE);
    function<void (*)(const GLubyte*)>("glPolygonStipple")(std::array<GLubyte, 128>{}.data());
    function<void (*)(GLenum)>("glMatrixMode")(GL_TEXTURE);
    function<void (*)(GLfloat, GLfloat, GLfloat, GLfloat)>("glColor4f")(0.1F, 0.2F, 0.3F, 0.4F);
}

}  // namespace

GlSnapshot take_snapshot(const HeadlessContext& context) {
    const Gl& gl = context.gl();
    GlSnapshot snapshot;
    Recorder record(gl, snapshot);
    snap_bindings(gl, record);
    snap_textures(gl, record);
    snap_raster(gl, record);
    snap_pixel_store(record);
    if (gl.compatibility) snap_legacy(record);
    return snapshot;
}

std::string differences(const GlSnapshot& before, const GlSnapshot& after) {
    std::ostringstream text;
    const auto list = [&](const std::vector<double>& values) {
        for (const double value : values)
            text << ' ' << value;
    };
    for (const auto& [name, values] : before) {
        const auto found = after.find(name);
        if (found != after.end() && found->second == values) continue;
        text << name << ": was";
        list(values);
        text << ", is";
        if (found != after.end()) list(found->second);
        text << '\n';
    }
    return text.str();
}

PoisonedState::PoisonedState(const HeadlessContext& context) : program_(make_program(context.gl())) {
    const Gl& gl = context.gl();
    // While the upload state is still plain: polygon stipple and images would read through it.
    if (gl.compatibility) {
        gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        poison_legacy(gl);
    }
    poison_objects(gl, program_);
    const GLint front = GL_POINT, back = GL_LINE;
    poison_raster(gl);
    if (gl.compatibility) {
        gl.PolygonMode(GL_FRONT, static_cast<GLenum>(front));
        gl.PolygonMode(GL_BACK, static_cast<GLenum>(back));
    }
}

}  // namespace seaglare::test
