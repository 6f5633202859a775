#include "glare/apply/occlusion.h"

#include "glare/apply/depth_model.h"
#include "glare/apply/screen_uniforms.h"

namespace seaglare::glare {

namespace {

constexpr int visibility_width = 256;
constexpr int visibility_height = static_cast<int>(lights_per_chunk) / visibility_width;

void set_depth(const GlProgram& program, const DepthModel& model, const DepthImage& image) {
    program.set("depth_origin", image.origin_px[0], image.origin_px[1]);
    program.set("depth_size", image.width_px, image.height_px);
    program.set("depth_logarithmic", model.logarithmic ? 1 : 0);
    program.set("depth_log", model.log_c, model.log_range);
    program.set("depth_scale_anchor", model.scale, model.anchor);
    program.set("depth_far_z", model.far_z);
    program.set("depth_offset", model.offset[0], model.offset[1], model.offset[2]);
    program.set("depth_constants", model.z_constant, model.w_constant);
    program.set("depth_row_w", model.row_w[0], model.row_w[1], model.row_w[2]);
    // A float near zero, where a reversed projection has its far plane, is exact in proportion; anywhere else it is
    // not better than its largest values.
    const bool proportional = image.quantum_relative > 0 && model.far_z == 0 && model.anchor == 0;
    program.set("depth_quantum", proportional ? 0.0 : image.quantum);
    program.set("depth_quantum_relative", proportional ? image.quantum_relative : 0.0);
}

}  // namespace

Occlusion::Occlusion(const Gl& gl)
    : gl_(gl),
      program_(gl, "visibility", {"screen.vert.glsl"},
               {"geometry.glsl", "lights.glsl", "footprint.glsl", "visibility.frag.glsl"}),
      program_ms_(gl, "visibility of multisampled depth", {"screen.vert.glsl"},
                  {"geometry.glsl", "lights.glsl", "footprint.glsl", "visibility.frag.glsl"},
                  "#define SEAGLARE_DEPTH_MS\n"),
      visibility_(gl),
      reader_(gl) {
    visibility_.resize(GL_R32F, visibility_width, visibility_height, "the lights' visibility buffer");
    for (const GlProgram* program : {&program_, &program_ms_}) {
        program->use();
        program->set("lights", 0);
        program->set("depth", 2);
    }
}

void Occlusion::draw(const Frame& frame, const ScreenGeometry& g, int count) const {
    const bool multisampled = depth_.samples > 0 && depth_.target == GL_TEXTURE_2D_MULTISAMPLE;
    const GlProgram& program = multisampled ? program_ms_ : program_;
    program.use();
    set_geometry(program, g, g.pitch);
    program.set("light_count", count);
    program.set("depth_samples", depth_.samples);
    if (depth_.samples > 0) {
        set_depth(program, depth_model(frame), depth_);
        gl_.ActiveTexture(GL_TEXTURE2);
        gl_.BindTexture(depth_.target, depth_.texture);
    }
    gl_.Disable(GL_BLEND);
    visibility_.bind_for_drawing();
    gl_.Viewport(0, 0, visibility_width, (count + visibility_width - 1) / visibility_width);
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, visibility_.texture());
}

void Occlusion::forget() {
    program_.forget();
    program_ms_.forget();
    visibility_.forget();
    reader_.forget();
}

}  // namespace seaglare::glare
