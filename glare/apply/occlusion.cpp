#include "glare/apply/occlusion.h"

#include <algorithm>

#include "glare/apply/depth_model.h"
#include "glare/apply/screen_uniforms.h"

namespace seaglare::glare {

namespace {

constexpr int visibility_width = 256;
constexpr int chunk_rows = static_cast<int>(lights_per_chunk) / visibility_width;

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
      free_(gl, GlKind::texture),
      reader_(gl),
      seen_{FloatBuffer(gl), FloatBuffer(gl)},
      previous_buffer_(gl, GlKind::buffer),
      previous_texture_(gl, GlKind::texture),
      previous_bytes_(64 * sizeof(std::int32_t)),
      readback_(gl) {
    const std::vector<float> ones(static_cast<std::size_t>(visibility_width) * chunk_rows, 1.0F);
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, free_.name());
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, visibility_width, chunk_rows, 0, GL_RED, GL_FLOAT, ones.data());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    for (const GlProgram* program : {&program_, &program_ms_}) {
        program->use();
        program->set("lights", 0);
        program->set("seen_before", 1);
        program->set("depth", 2);
        program->set("previous", 3);
    }
    gl_.BindBuffer(GL_TEXTURE_BUFFER, previous_buffer_.name());
    gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(previous_bytes_), nullptr, GL_STREAM_DRAW);
    gl_.ActiveTexture(GL_TEXTURE3);
    gl_.BindTexture(GL_TEXTURE_BUFFER, previous_texture_.name());
    gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_R32I, previous_buffer_.name());
}

void Occlusion::begin(const Frame& frame, std::span<const LightInstance> lights,
                      std::span<const std::uint32_t> tags) {
    // What a frame that failed should have left is not there.
    if (!complete_) history_.clear();
    complete_ = false;
    depth_ = reader_.read(frame);
    smooths_ = false;
    reading_ = false;
    if (!can_hide()) {
        history_.clear();
        return;
    }
    history_.begin(frame.time_s, frame.occlusion.smoothing_s);
    if (wanted_) {
        readback_.poll(history_.begins_anew());
        reading_ = readback_.begin(tags, frame.occlusion.wait);
    }
    now_ = 1 - now_;
    const auto rows = static_cast<int>((lights.size() + visibility_width - 1) / visibility_width);
    if (seen_[now_].height_px() < rows) {
        // In steps, so that a light more does not mean another texture.
        seen_[now_].resize(GL_R32F, visibility_width, (rows + 7) / 8 * 8, "the lights' visibility");
    }
    smooths_ = frame.occlusion.smoothing_s > 0;
    if (smooths_) history_.match(lights, tags, previous_);
}

std::uint32_t Occlusion::draw(const Frame& frame, const ScreenGeometry& g, std::size_t first, int count) {
    if (can_hide()) look(frame, g, first, count);
    bind();
    return can_hide() ? 1 : 0;
}

void Occlusion::bind() const {
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, can_hide() ? seen_[now_].texture() : free_.name());
}

void Occlusion::look(const Frame& frame, const ScreenGeometry& g, std::size_t first, int count) {
    const bool multisampled = depth_.target == GL_TEXTURE_2D_MULTISAMPLE;
    const GlProgram& program = multisampled ? program_ms_ : program_;
    const int first_row = static_cast<int>(first) / visibility_width;
    const int rows = (count + visibility_width - 1) / visibility_width;
    program.use();
    set_geometry(program, g, g.pitch);
    program.set("first_row", first_row);
    program.set("light_count", count);
    program.set("depth_samples", depth_.samples);
    program.set("body_m", frame.occlusion.body_m);
    program.set("blend", smooths_ ? history_.blend() : 1.0);
    set_depth(program, depth_model(frame), depth_);
    if (smooths_) {
        const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(std::int32_t);
        gl_.BindBuffer(GL_TEXTURE_BUFFER, previous_buffer_.name());
        previous_bytes_ = std::max(previous_bytes_, bytes);
        // Orphaned: the GPU may still be reading the last frame's.
        gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(previous_bytes_), nullptr, GL_STREAM_DRAW);
        gl_.BufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), previous_.data() + first);
    }
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, seen_[1 - now_].texture());
    gl_.ActiveTexture(GL_TEXTURE2);
    gl_.BindTexture(depth_.target, depth_.texture);
    gl_.ActiveTexture(GL_TEXTURE3);
    gl_.BindTexture(GL_TEXTURE_BUFFER, previous_texture_.name());
    gl_.Disable(GL_BLEND);
    seen_[now_].bind_for_drawing();
    gl_.Viewport(0, first_row, visibility_width, rows);
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    if (reading_) readback_.read(visibility_width, first_row, rows);
}

void Occlusion::end() {
    complete_ = true;
    if (reading_) readback_.end();
    reading_ = false;
}

void Occlusion::wait() {
    if (reading_) readback_.end_now();
    reading_ = false;
}

std::optional<float> Occlusion::known(std::uint32_t tag) const {
    if (!can_hide()) return 1.0F;
    return wanted_ ? readback_.known(tag) : std::nullopt;
}

double Occlusion::memory_bytes() const {
    return 4.0 * visibility_width * chunk_rows + reader_.memory_bytes() + seen_[0].memory_bytes() +
           seen_[1].memory_bytes() + static_cast<double>(previous_bytes_) + readback_.memory_bytes();
}

void Occlusion::forget() {
    program_.forget();
    program_ms_.forget();
    free_.forget();
    reader_.forget();
    for (FloatBuffer& seen : seen_)
        seen.forget();
    previous_buffer_.forget();
    previous_texture_.forget();
    readback_.forget();
}

}  // namespace seaglare::glare
