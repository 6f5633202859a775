#include "plugin_api/gl_state_guard.h"

#include <algorithm>
#include <span>

#include "plugin_api/gl_legacy.h"

namespace seaglare::plugin {

namespace {

using glare::Gl;
using glare::has_extension;

constexpr std::array<GLenum, 4> texture_targets = {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY,
                                                   GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BUFFER};
constexpr std::array<GLenum, 4> texture_bindings = {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY,
                                                    GL_TEXTURE_BINDING_2D_MULTISAMPLE,
                                                    GL_TEXTURE_BINDING_BUFFER};

// The element array buffer belongs to the vertex array object and comes back with it.
constexpr std::array<GLenum, 6> buffer_targets = {GL_ARRAY_BUFFER,        GL_PIXEL_PACK_BUFFER,
                                                  GL_PIXEL_UNPACK_BUFFER, GL_COPY_READ_BUFFER,
                                                  GL_COPY_WRITE_BUFFER,   GL_TEXTURE_BUFFER};
constexpr std::array<GLenum, 6> buffer_bindings = {
    GL_ARRAY_BUFFER_BINDING,     GL_PIXEL_PACK_BUFFER_BINDING, GL_PIXEL_UNPACK_BUFFER_BINDING,
    GL_COPY_READ_BUFFER_BINDING, GL_COPY_WRITE_BUFFER_BINDING, GL_TEXTURE_BUFFER_BINDING};

constexpr std::array<GLenum, 16> pixel_store_names = {
    GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST,   GL_UNPACK_ROW_LENGTH,  GL_UNPACK_IMAGE_HEIGHT,
    GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT,
    GL_PACK_SWAP_BYTES,   GL_PACK_LSB_FIRST,     GL_PACK_ROW_LENGTH,    GL_PACK_IMAGE_HEIGHT,
    GL_PACK_SKIP_ROWS,    GL_PACK_SKIP_PIXELS,   GL_PACK_SKIP_IMAGES,   GL_PACK_ALIGNMENT};

// Pixel transfer of the compatibility profile: it acts on every upload and read-back, and scales by its value.
constexpr std::array<GLenum, 12> pixel_transfer_names = {
    legacy::red_scale, legacy::green_scale, legacy::blue_scale,  legacy::alpha_scale,
    legacy::red_bias,  legacy::green_bias,  legacy::blue_bias,   legacy::alpha_bias,
    legacy::map_color, legacy::map_stencil, legacy::depth_scale, legacy::depth_bias};
constexpr std::array<GLfloat, 12> pixel_transfer_neutral = {1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 0};

void set_enabled(const Gl& gl, GLenum capability, bool on) {
    if (on) {
        gl.Enable(capability);
    } else {
        gl.Disable(capability);
    }
}

GLint get_integer(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

}  // namespace

GlStateCaps gl_state_caps(const Gl& gl, glare::GetProc get_proc, void* user) {
    GlStateCaps caps;
    // A get_proc may return an address for a function that the context does not have: the version decides.
    caps.indexed_blend =
        gl.version >= 40 && gl.BlendFuncSeparatei != nullptr && gl.BlendEquationSeparatei != nullptr;
    caps.sample_shading = gl.version >= 40 && gl.MinSampleShading != nullptr;
    caps.feedback_pause = gl.PauseTransformFeedback != nullptr && gl.ResumeTransformFeedback != nullptr &&
                          (gl.version >= 40 || has_extension(gl, "GL_ARB_transform_feedback2"));
    caps.viewport_array = gl.version >= 41 && gl.ViewportIndexedf != nullptr &&
                          gl.ScissorIndexed != nullptr && gl.GetFloati_v != nullptr;
    caps.fixed_index_restart = gl.version >= 43;
    caps.clip_control =
        gl.ClipControl != nullptr && (gl.version >= 45 || has_extension(gl, "GL_ARB_clip_control"));
    caps.compatibility = gl.compatibility;
    caps.draw_buffers = std::clamp(get_integer(gl, GL_MAX_DRAW_BUFFERS), 1, guarded_draw_buffers);
    caps.viewports =
        caps.viewport_array ? std::clamp(get_integer(gl, GL_MAX_VIEWPORTS), 1, guarded_viewports) : 1;
    caps.clip_distances = std::clamp(get_integer(gl, GL_MAX_CLIP_DISTANCES), 0, guarded_clip_distances);
    caps.sample_mask_words = std::clamp(get_integer(gl, GL_MAX_SAMPLE_MASK_WORDS), 1, 4);
    caps.texture_units =
        std::clamp(get_integer(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS), 1, guarded_texture_units);
    if (caps.compatibility) {
        caps.PixelTransferf = reinterpret_cast<void (*)(GLenum, GLfloat)>(get_proc(user, "glPixelTransferf"));
    }
    return caps;
}

GlStateGuard::GlStateGuard(const Gl& gl, const GlStateCaps& caps, GuardMode mode)
    : gl_(gl), caps_(caps), mode_(mode) {
    refuse_modes_without_drawing();
    pause_transform_feedback();
    if (mode_ == GuardMode::save_and_restore) {
        save_framebuffers_and_objects();
        save_textures();
        save_fragment_operations();
        save_rasterisation();
        save_pixel_transfer();
    }
    set_known_state();
}

GlStateGuard::~GlStateGuard() {
    if (mode_ == GuardMode::save_and_restore) {
        restore_pixel_transfer();
        restore_rasterisation();
        restore_fragment_operations();
        restore_textures();
        restore_framebuffers_and_objects();
    }
    // Last, because resuming needs the program that was current when the feedback was paused.
    if (paused_feedback_) {
        if (mode_ == GuardMode::host_restores) gl_.UseProgram(static_cast<GLuint>(program_));
        gl_.ResumeTransformFeedback();
    }
}

void GlStateGuard::refuse_modes_without_drawing() const {
    if (!caps_.compatibility) return;
    if (get_integer(gl_, legacy::list_index) != 0) {
        throw glare::GlError("a display list is being compiled: call glEndList before Seaglare");
    }
    if (get_integer(gl_, legacy::render_mode) != static_cast<GLint>(legacy::render)) {
        throw glare::GlError("glRenderMode is selection or feedback: set GL_RENDER before calling Seaglare");
    }
}

void GlStateGuard::pause_transform_feedback() {
    if (!caps_.feedback_pause) return;
    // The program cannot be changed while transform feedback runs, and our vertices are none of the host's.
    if (get_integer(gl_, GL_TRANSFORM_FEEDBACK_ACTIVE) == 0) return;
    if (get_integer(gl_, GL_TRANSFORM_FEEDBACK_PAUSED) != 0) return;
    gl_.PauseTransformFeedback();
    paused_feedback_ = true;
    program_ = get_integer(gl_, GL_CURRENT_PROGRAM);
}

void GlStateGuard::save_framebuffers_and_objects() {
    draw_framebuffer_ = get_integer(gl_, GL_DRAW_FRAMEBUFFER_BINDING);
    read_framebuffer_ = get_integer(gl_, GL_READ_FRAMEBUFFER_BINDING);
    renderbuffer_ = get_integer(gl_, GL_RENDERBUFFER_BINDING);
    program_ = get_integer(gl_, GL_CURRENT_PROGRAM);
    vertex_array_ = get_integer(gl_, GL_VERTEX_ARRAY_BINDING);
    for (std::size_t i = 0; i < buffer_bindings.size(); ++i)
        buffers_[i] = get_integer(gl_, buffer_bindings[i]);
    uniform_buffer_ = get_integer(gl_, GL_UNIFORM_BUFFER_BINDING);
    for (GLuint i = 0; i < uniform_bindings_.size(); ++i) {
        gl_.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &uniform_bindings_[i].buffer);
        gl_.GetInteger64i_v(GL_UNIFORM_BUFFER_START, i, &uniform_bindings_[i].start);
        gl_.GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, i, &uniform_bindings_[i].size);
    }
}

void GlStateGuard::restore_framebuffers_and_objects() const {
    // A program that the host had marked for deletion ended when ours became current; its name is no longer valid.
    if (program_ == 0 || gl_.IsProgram(static_cast<GLuint>(program_)) == GL_TRUE)
        gl_.UseProgram(static_cast<GLuint>(program_));
    gl_.BindVertexArray(static_cast<GLuint>(vertex_array_));
    for (GLuint i = 0; i < uniform_bindings_.size(); ++i) {
        const UniformBinding& binding = uniform_bindings_[i];
        const auto buffer = static_cast<GLuint>(binding.buffer);
        if (binding.size == 0) {
            gl_.BindBufferBase(GL_UNIFORM_BUFFER, i, buffer);
        } else {
            gl_.BindBufferRange(GL_UNIFORM_BUFFER, i, buffer, static_cast<GLintptr>(binding.start),
                                static_cast<GLsizeiptr>(binding.size));
        }
    }
    gl_.BindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(uniform_buffer_));
    for (std::size_t i = 0; i < buffer_targets.size(); ++i)
        gl_.BindBuffer(buffer_targets[i], static_cast<GLuint>(buffers_[i]));
    gl_.BindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(renderbuffer_));
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
}

void GlStateGuard::save_textures() {
    active_texture_ = get_integer(gl_, GL_ACTIVE_TEXTURE);
    for (int unit = 0; unit < caps_.texture_units; ++unit) {
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        TextureUnit& saved = units_[static_cast<std::size_t>(unit)];
        for (std::size_t i = 0; i < texture_bindings.size(); ++i)
            saved.texture[i] = get_integer(gl_, texture_bindings[i]);
        saved.sampler = get_integer(gl_, GL_SAMPLER_BINDING);
    }
}

void GlStateGuard::restore_textures() const {
    for (int unit = 0; unit < caps_.texture_units; ++unit) {
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        const TextureUnit& saved = units_[static_cast<std::size_t>(unit)];
        for (std::size_t i = 0; i < texture_targets.size(); ++i)
            gl_.BindTexture(texture_targets[i], static_cast<GLuint>(saved.texture[i]));
        gl_.BindSampler(static_cast<GLuint>(unit), static_cast<GLuint>(saved.sampler));
    }
    gl_.ActiveTexture(static_cast<GLenum>(active_texture_));
}

void GlStateGuard::save_fragment_operations() {
    for (int i = 0; i < caps_.draw_buffers; ++i) {
        const auto index = static_cast<GLuint>(i);
        DrawBufferState& saved = draw_buffers_[index];
        saved.blend = gl_.IsEnabledi(GL_BLEND, index) == GL_TRUE;
        gl_.GetBooleani_v(GL_COLOR_WRITEMASK, index, saved.write_mask.data());
        if (!caps_.indexed_blend && i > 0) continue;
        const auto get = [&](GLenum name) {
            GLint value = 0;
            if (caps_.indexed_blend) {
                gl_.GetIntegeri_v(name, index, &value);
            } else {
                gl_.GetIntegerv(name, &value);
            }
            return value;
        };
        saved.source_rgb = get(GL_BLEND_SRC_RGB);
        saved.destination_rgb = get(GL_BLEND_DST_RGB);
        saved.source_alpha = get(GL_BLEND_SRC_ALPHA);
        saved.destination_alpha = get(GL_BLEND_DST_ALPHA);
        saved.equation_rgb = get(GL_BLEND_EQUATION_RGB);
        saved.equation_alpha = get(GL_BLEND_EQUATION_ALPHA);
    }
    gl_.GetFloatv(GL_BLEND_COLOR, blend_colour_.data());
    gl_.GetFloatv(GL_COLOR_CLEAR_VALUE, clear_colour_.data());
    gl_.GetDoublev(GL_DEPTH_CLEAR_VALUE, &clear_depth_);
    clear_stencil_ = get_integer(gl_, GL_STENCIL_CLEAR_VALUE);
    gl_.GetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    depth_function_ = get_integer(gl_, GL_DEPTH_FUNC);
    logic_operation_ = get_integer(gl_, GL_LOGIC_OP_MODE);
    gl_.GetFloatv(GL_SAMPLE_COVERAGE_VALUE, &sample_coverage_);
    gl_.GetBooleanv(GL_SAMPLE_COVERAGE_INVERT, &sample_coverage_invert_);
    for (int i = 0; i < caps_.sample_mask_words; ++i)
        gl_.GetIntegeri_v(GL_SAMPLE_MASK_VALUE, static_cast<GLuint>(i),
                          &sample_mask_[static_cast<std::size_t>(i)]);
    if (caps_.sample_shading) gl_.GetFloatv(GL_MIN_SAMPLE_SHADING_VALUE, &min_sample_shading_);
}

void GlStateGuard::restore_fragment_operations() const {
    for (int i = 0; i < caps_.draw_buffers; ++i) {
        const auto index = static_cast<GLuint>(i);
        const DrawBufferState& saved = draw_buffers_[index];
        if (saved.blend) {
            gl_.Enablei(GL_BLEND, index);
        } else {
            gl_.Disablei(GL_BLEND, index);
        }
        gl_.ColorMaski(index, saved.write_mask[0], saved.write_mask[1], saved.write_mask[2],
                       saved.write_mask[3]);
        const auto source_rgb = static_cast<GLenum>(saved.source_rgb);
        const auto destination_rgb = static_cast<GLenum>(saved.destination_rgb);
        const auto source_alpha = static_cast<GLenum>(saved.source_alpha);
        const auto destination_alpha = static_cast<GLenum>(saved.destination_alpha);
        const auto equation_rgb = static_cast<GLenum>(saved.equation_rgb);
        const auto equation_alpha = static_cast<GLenum>(saved.equation_alpha);
        if (caps_.indexed_blend) {
            gl_.BlendFuncSeparatei(index, source_rgb, destination_rgb, source_alpha, destination_alpha);
            gl_.BlendEquationSeparatei(index, equation_rgb, equation_alpha);
        } else if (i == 0) {
            gl_.BlendFuncSeparate(source_rgb, destination_rgb, source_alpha, destination_alpha);
            gl_.BlendEquationSeparate(equation_rgb, equation_alpha);
        }
    }
    gl_.BlendColor(blend_colour_[0], blend_colour_[1], blend_colour_[2], blend_colour_[3]);
    gl_.ClearColor(clear_colour_[0], clear_colour_[1], clear_colour_[2], clear_colour_[3]);
    gl_.ClearDepth(clear_depth_);
    gl_.ClearStencil(clear_stencil_);
    gl_.DepthMask(depth_mask_);
    gl_.DepthFunc(static_cast<GLenum>(depth_function_));
    gl_.LogicOp(static_cast<GLenum>(logic_operation_));
    gl_.SampleCoverage(sample_coverage_, sample_coverage_invert_);
    for (int i = 0; i < caps_.sample_mask_words; ++i)
        gl_.SampleMaski(static_cast<GLuint>(i),
                        static_cast<GLbitfield>(sample_mask_[static_cast<std::size_t>(i)]));
    if (caps_.sample_shading) gl_.MinSampleShading(min_sample_shading_);
}

void GlStateGuard::save_rasterisation() {
    const auto save_toggle = [&](GLenum capability) {
        toggles_.at(toggle_count_++) = {capability, gl_.IsEnabled(capability) == GL_TRUE};
    };
    for (const GLenum capability :
         {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_COLOR_LOGIC_OP, GL_RASTERIZER_DISCARD, GL_DITHER,
          GL_FRAMEBUFFER_SRGB, GL_MULTISAMPLE, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE,
          GL_SAMPLE_COVERAGE, GL_SAMPLE_MASK, GL_PRIMITIVE_RESTART, GL_PROGRAM_POINT_SIZE, GL_POLYGON_SMOOTH,
          GL_POLYGON_OFFSET_FILL, GL_DEPTH_CLAMP}) {
        save_toggle(capability);
    }
    for (int i = 0; i < caps_.clip_distances; ++i)
        save_toggle(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
    if (caps_.sample_shading) save_toggle(GL_SAMPLE_SHADING);
    if (caps_.fixed_index_restart) save_toggle(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    if (caps_.compatibility) {
        save_toggle(legacy::alpha_test);
        save_toggle(legacy::polygon_stipple);
        save_toggle(legacy::index_logic_op);
    }

    for (int i = 0; i < caps_.viewports; ++i) {
        const auto index = static_cast<GLuint>(i);
        if (caps_.viewport_array) {
            scissor_test_[index] = gl_.IsEnabledi(GL_SCISSOR_TEST, index) == GL_TRUE;
            gl_.GetIntegeri_v(GL_SCISSOR_BOX, index, scissor_box_[index].data());
            gl_.GetFloati_v(GL_VIEWPORT, index, viewport_[index].data());
        } else {
            scissor_test_[index] = gl_.IsEnabled(GL_SCISSOR_TEST) == GL_TRUE;
            gl_.GetIntegerv(GL_SCISSOR_BOX, scissor_box_[index].data());
            gl_.GetFloatv(GL_VIEWPORT, viewport_[index].data());
        }
    }
    gl_.GetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
    if (caps_.clip_control) {
        clip_origin_ = get_integer(gl_, GL_CLIP_ORIGIN);
        clip_depth_ = get_integer(gl_, GL_CLIP_DEPTH_MODE);
    }
    provoking_vertex_ = get_integer(gl_, GL_PROVOKING_VERTEX);
    clamp_colour_[0] = get_integer(gl_, GL_CLAMP_READ_COLOR);
    if (caps_.compatibility) {
        clamp_colour_[1] = get_integer(gl_, legacy::clamp_vertex_color);
        clamp_colour_[2] = get_integer(gl_, legacy::clamp_fragment_color);
    }
}

void GlStateGuard::restore_rasterisation() const {
    for (const Toggle& toggle : std::span(toggles_).first(toggle_count_))
        set_enabled(gl_, toggle.capability, toggle.on);
    for (int i = 0; i < caps_.viewports; ++i) {
        const auto index = static_cast<GLuint>(i);
        const std::array<GLint, 4>& box = scissor_box_[index];
        const std::array<GLfloat, 4>& viewport = viewport_[index];
        if (caps_.viewport_array) {
            if (scissor_test_[index]) {
                gl_.Enablei(GL_SCISSOR_TEST, index);
            } else {
                gl_.Disablei(GL_SCISSOR_TEST, index);
            }
            gl_.ScissorIndexed(index, box[0], box[1], box[2], box[3]);
            gl_.ViewportIndexedf(index, viewport[0], viewport[1], viewport[2], viewport[3]);
        } else {
            set_enabled(gl_, GL_SCISSOR_TEST, scissor_test_[index]);
            gl_.Scissor(box[0], box[1], box[2], box[3]);
            gl_.Viewport(static_cast<GLint>(viewport[0]), static_cast<GLint>(viewport[1]),
                         static_cast<GLsizei>(viewport[2]), static_cast<GLsizei>(viewport[3]));
        }
    }
    if (caps_.compatibility) {
        gl_.PolygonMode(GL_FRONT, static_cast<GLenum>(polygon_mode_[0]));
        gl_.PolygonMode(GL_BACK, static_cast<GLenum>(polygon_mode_[1]));
        gl_.ClampColor(legacy::clamp_vertex_color, static_cast<GLenum>(clamp_colour_[1]));
        gl_.ClampColor(legacy::clamp_fragment_color, static_cast<GLenum>(clamp_colour_[2]));
    } else {
        gl_.PolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(polygon_mode_[0]));
    }
    gl_.ClampColor(GL_CLAMP_READ_COLOR, static_cast<GLenum>(clamp_colour_[0]));
    if (caps_.clip_control)
        gl_.ClipControl(static_cast<GLenum>(clip_origin_), static_cast<GLenum>(clip_depth_));
    gl_.ProvokingVertex(static_cast<GLenum>(provoking_vertex_));
}

void GlStateGuard::save_pixel_transfer() {
    for (std::size_t i = 0; i < pixel_store_names.size(); ++i)
        pixel_store_[i] = get_integer(gl_, pixel_store_names[i]);
    if (caps_.PixelTransferf == nullptr) return;
    for (std::size_t i = 0; i < pixel_transfer_names.size(); ++i)
        gl_.GetFloatv(pixel_transfer_names[i], &pixel_transfer_[i]);
}

void GlStateGuard::restore_pixel_transfer() const {
    for (std::size_t i = 0; i < pixel_store_names.size(); ++i)
        gl_.PixelStorei(pixel_store_names[i], pixel_store_[i]);
    if (caps_.PixelTransferf == nullptr) return;
    for (std::size_t i = 0; i < pixel_transfer_names.size(); ++i)
        caps_.PixelTransferf(pixel_transfer_names[i], pixel_transfer_[i]);
}

// The renderer sets the state it draws with (glare/device/gl_touched_state.h); what it does not know of is left here.
void GlStateGuard::set_known_state() const {
    if (caps_.clip_control) gl_.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    if (caps_.PixelTransferf == nullptr) return;
    for (std::size_t i = 0; i < pixel_transfer_names.size(); ++i)
        caps_.PixelTransferf(pixel_transfer_names[i], pixel_transfer_neutral[i]);
}

}  // namespace seaglare::plugin
