// How much of each light the host's picture leaves visible, from its depth: one texel a light, in a texture that the
// vertex shader of the lights reads (shaders/light_quad.vert.glsl).
//
// The value is smoothed in time on the GPU: two textures take turns, each with a frame's values in the order of its lights,
// and a light finds in the other one what it had before (visibility_history.h). Nothing is read back, unless somebody wants
// to know the values on the CPU, and then late and without waiting. Without a depth source nothing of this is done.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "glare/apply/depth_reader.h"
#include "glare/apply/hdr_buffers.h"
#include "glare/apply/light_buffer.h"
#include "glare/apply/screen_geometry.h"
#include "glare/apply/visibility_history.h"
#include "glare/apply/visibility_readback.h"
#include "glare/device/gl_program.h"

namespace seaglare::glare {

class Occlusion {
  public:
    // Throws GlError when a shader does not compile. Uses texture units 0 and 3 and leaves a framebuffer bound.
    explicit Occlusion(const Gl& gl);
    // Takes the frame's depth and its lights, `tags` parallel to `lights`; both must live until end(). One call a frame,
    // before the first draw(). Throws as DepthReader::read.
    void begin(const Frame& frame, std::span<const LightInstance> lights,
               std::span<const std::uint32_t> tags);
    // Of the `count` lights from `first` on, which are in the LightBuffer on texture unit 0: chunk after chunk, each of
    // lights_per_chunk but the last. Uses texture units 2 and 3, leaves its result on unit 1 and blending off. Returns the
    // draw calls made. What reads the result in a vertex shader must be drawn next, before any other framebuffer is drawn
    // to: Mesa's llvmpipe (22.3) runs vertex shaders on the CPU, and waits for a texture only while that is the target.
    std::uint32_t draw(const Frame& frame, const ScreenGeometry& geometry, std::size_t first, int count);
    // Where light `first` of the chunk drawn stands in the texture on unit 1, 256 lights a row.
    int first_texel(std::size_t first) const { return can_hide() ? static_cast<int>(first) : 0; }
    // What this frame drew, to texture unit 1 again.
    void bind() const;
    void end();
    // After draw() of every chunk: waits until the values of this very frame are known() on the CPU. The chunks are then
    // drawn once more, for the texture that their lights read.
    void wait();

    // False: nothing hides the lights of this frame.
    bool can_hide() const { return depth_.samples > 0; }
    // Before begin(): values on the CPU from this frame on, for as long as it is true.
    void want_known(bool wanted) { wanted_ = wanted; }
    // The smoothed visibility of a light, 0 ... 1, a frame or two late; nothing when none has arrived, as of a light that
    // was not drawn then. Without a depth source: 1.
    std::optional<float> known(std::uint32_t tag) const;

    double memory_bytes() const;
    void forget();

  private:
    void look(const Frame& frame, const ScreenGeometry& geometry, std::size_t first, int count);

    const Gl& gl_;
    GlProgram program_;
    GlProgram program_ms_;
    GlObject free_;  // a texture of ones
    DepthReader reader_;
    DepthImage depth_;

    VisibilityHistory history_;
    std::array<FloatBuffer, 2> seen_;  // of the frame before and of this one, by turns
    std::size_t now_ = 0;
    bool smooths_ = false;
    bool complete_ = false;               // the frame before came to its end
    std::vector<std::int32_t> previous_;  // index in the frame before, or -1
    GlObject previous_buffer_;
    GlObject previous_texture_;
    std::size_t previous_bytes_ = 0;

    bool wanted_ = false;
    bool reading_ = false;
    VisibilityReadback readback_;
};

}  // namespace seaglare::glare
