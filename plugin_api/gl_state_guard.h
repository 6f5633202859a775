// Saves the GL state that Seaglare touches, and more, and puts the saved values back: the actual ones, never defaults.
// Sets what the renderer does not set for itself, so that the picture is the same whatever the host left behind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "glare/device/gl.h"

namespace seaglare::plugin {

// Texture units of which the renderer may use any; it must not touch a unit above.
inline constexpr int guarded_texture_units = 8;
inline constexpr int guarded_draw_buffers = 8;
inline constexpr int guarded_viewports = 16;
inline constexpr int guarded_clip_distances = 8;
inline constexpr int guarded_uniform_bindings = 4;

// What a context can do beyond GL 3.3 core, asked once when the view is made.
struct GlStateCaps {
    bool indexed_blend = false;        // 4.0
    bool sample_shading = false;       // 4.0
    bool feedback_pause = false;       // 4.0: transform feedback can be paused
    bool viewport_array = false;       // 4.1
    bool fixed_index_restart = false;  // 4.3
    bool clip_control = false;         // 4.5 or ARB_clip_control
    bool compatibility = false;
    int draw_buffers = 1;
    int viewports = 1;
    int clip_distances = 0;
    int sample_mask_words = 1;
    int texture_units = 1;

    // Compatibility profile only; null when the host's get_proc knows no such function.
    void (*PixelTransferf)(GLenum name, GLfloat value) = nullptr;
};
// Needs the context current.
GlStateCaps gl_state_caps(const glare::Gl& gl, glare::GetProc get_proc, void* user);

enum class GuardMode {
    save_and_restore,
    host_restores,  // sets the known state only: the host sets its own anew
};

class GlStateGuard {
  public:
    // Throws glare::GlError, with nothing changed, in a mode in which drawing cannot work: a display list is being
    // compiled, or the render mode is selection or feedback.
    GlStateGuard(const glare::Gl& gl, const GlStateCaps& caps, GuardMode mode = GuardMode::save_and_restore);
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

  private:
    // GL_FALSE/GL_TRUE of one capability that has no index.
    struct Toggle {
        GLenum capability = 0;
        bool on = false;
    };
    struct TextureUnit {
        std::array<GLint, 4> texture{};  // in the order of texture_targets
        GLint sampler = 0;
    };
    struct DrawBufferState {
        bool blend = false;
        std::array<GLboolean, 4> write_mask{};
        GLint source_rgb = 0, destination_rgb = 0, source_alpha = 0, destination_alpha = 0;
        GLint equation_rgb = 0, equation_alpha = 0;
    };
    struct UniformBinding {
        GLint buffer = 0;
        GLint64 start = 0;
        GLint64 size = 0;
    };

    void save_framebuffers_and_objects();
    void save_textures();
    void save_fragment_operations();
    void save_rasterisation();
    void save_pixel_transfer();
    void set_known_state() const;
    void restore_framebuffers_and_objects() const;
    void restore_textures() const;
    void restore_fragment_operations() const;
    void restore_rasterisation() const;
    void restore_pixel_transfer() const;
    void refuse_modes_without_drawing() const;
    void pause_transform_feedback();

    const glare::Gl& gl_;
    const GlStateCaps& caps_;
    GuardMode mode_;
    bool paused_feedback_ = false;

    GLint draw_framebuffer_ = 0, read_framebuffer_ = 0, renderbuffer_ = 0;
    GLint program_ = 0, vertex_array_ = 0;
    std::array<GLint, 6> buffers_{};  // in the order of buffer_targets
    GLint uniform_buffer_ = 0;
    std::array<UniformBinding, guarded_uniform_bindings> uniform_bindings_{};

    GLint active_texture_ = 0;
    std::array<TextureUnit, guarded_texture_units> units_{};

    std::array<DrawBufferState, guarded_draw_buffers> draw_buffers_{};
    std::array<GLfloat, 4> blend_colour_{};
    std::array<GLfloat, 4> clear_colour_{};
    GLdouble clear_depth_ = 1;
    GLint clear_stencil_ = 0;
    GLboolean depth_mask_ = GL_TRUE;
    GLint depth_function_ = 0;
    GLint logic_operation_ = 0;
    GLfloat sample_coverage_ = 1;
    GLboolean sample_coverage_invert_ = GL_FALSE;
    std::array<GLint, 4> sample_mask_{};
    GLfloat min_sample_shading_ = 0;

    // A frame allocates nothing: capabilities of every version, and the clip distances.
    std::array<Toggle, 24 + guarded_clip_distances> toggles_{};
    std::size_t toggle_count_ = 0;
    std::array<bool, guarded_viewports> scissor_test_{};
    std::array<std::array<GLint, 4>, guarded_viewports> scissor_box_{};
    std::array<std::array<GLfloat, 4>, guarded_viewports> viewport_{};
    std::array<GLint, 2> polygon_mode_{};
    GLint clip_origin_ = 0, clip_depth_ = 0;
    GLint provoking_vertex_ = 0;
    std::array<GLint, 3> clamp_colour_{};  // read; vertex and fragment in the compatibility profile

    std::array<GLint, 16> pixel_store_{};  // in the order of pixel_store_names
    std::array<GLfloat, 12> pixel_transfer_{};
};

}  // namespace seaglare::plugin
