#include "glare/apply/gl_grids.h"

#include <algorithm>

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

namespace {

constexpr int lights_unit = 0;
constexpr int visibility_unit = 1;
constexpr int pattern_unit = 2;
constexpr int tables_unit = 3;

constexpr std::size_t texel_bytes = 4 * sizeof(float);

// Texels of shaders/grid_quad.vert.glsl.
std::array<float, 20> texels_of(const GatherLight& light, std::int32_t source) {
    const auto number = [](std::int32_t value) { return static_cast<float>(value); };
    return {light.along_u[0],     light.along_u[1],     light.along_u[2],     number(light.lower_table),
            light.along_v[0],     light.along_v[1],     light.along_v[2],     number(light.upper_table),
            light.towards[0],     light.towards[1],     light.towards[2],     light.upper_share,
            light.illuminance[0], light.illuminance[1], light.illuminance[2], light.illuminance[3],
            light.lash[0],        light.lash[1],        light.lash[2],        number(source)};
}

}  // namespace

GlGrids::GlGrids(const Gl& gl, const GlObject& plain)
    : gl_(gl),
      upsample_(gl, "grid upsample", {"screen.vert.glsl"}, {"grid_upsample.frag.glsl"}),
      plain_(plain),
      linear_(gl, GlKind::sampler),
      textures_(gl) {
    const auto program = [&gl](const char* name, const char* fragment, const char* defines) {
        return GlProgram(gl, name, {"grid_quad.vert.glsl"}, {"radial.glsl", fragment}, defines);
    };
    const auto of = [this](QuadKind kind) -> GlProgram& { return programs_[static_cast<std::size_t>(kind)]; };
    constexpr const char* mean = "grid_mean.frag.glsl";
    constexpr const char* near = "grid_near.frag.glsl";
    constexpr const char* departure = "grid_departure.frag.glsl";
    of(QuadKind::mean_of_one) = program("grid mean", mean, "");
    of(QuadKind::mean_of_two) = program("grid mean", mean, "#define TWO_LAYERS\n");
    of(QuadKind::near_one) = program("grid near", near, "");
    of(QuadKind::near_two) = program("grid near", near, "#define TWO_LAYERS\n");
    of(QuadKind::near_and_tail) = program("grid near", near, "#define TWO_LAYERS\n#define TAIL\n");
    of(QuadKind::departs_one) = program("grid departure", departure, "");
    of(QuadKind::departs_two) = program("grid departure", departure, "#define TWO_LAYERS\n");
    of(QuadKind::departs_fading) =
        program("grid departure", departure, "#define TWO_LAYERS\n#define FADES\n");
    near_lashes_ = program("grid near", near, "#define TWO_LAYERS\n#define TAIL\n#define LASHES\n");
    departs_lashes_ =
        program("grid departure", departure, "#define TWO_LAYERS\n#define FADES\n#define LASHES\n");
    for_each_program([](const GlProgram& each) {
        each.use();
        each.set("lights", lights_unit);
        each.set("visibility", visibility_unit);
        each.set("pattern", pattern_unit);
        each.set("departures", pattern_unit);
        each.set("radial", tables_unit);
    });
    upsample_.use();
    upsample_.set("above", tables_unit);
    for (const GLenum parameter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.SamplerParameteri(linear_.name(), parameter, GL_LINEAR);
    GLint most_texels = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most_texels);
    // Indices stand in floats.
    most_bytes_ = std::min<std::size_t>(static_cast<std::size_t>(most_texels), 1U << 24) * texel_bytes;
    // Beyond its edges there is nothing: the colour of borders is zero when nobody sets it.
    for (const GLenum parameter : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        gl.SamplerParameteri(linear_.name(), parameter, GL_CLAMP_TO_BORDER);
}

template <typename Visit>
void GlGrids::for_each_program(Visit visit) {
    for (GlProgram& program : programs_)
        visit(program);
    visit(near_lashes_);
    visit(departs_lashes_);
}

const GlProgram& GlGrids::program_of(QuadKind kind) const {
    if (lashes_ && kind >= QuadKind::departs_one) return departs_lashes_;
    if (lashes_ && kind >= QuadKind::near_one) return near_lashes_;
    return programs_[static_cast<std::size_t>(kind)];
}

bool GlGrids::prepare(const AccumulationInput& input) {
    const PatternProfile& profile = textures_.update(input.pattern, input.grid_texels);
    tail_table_ = static_cast<int>(profile.tail_table());
    GatherThresholds thresholds{input.reach.threshold_cd_m2, input.reach.tail_threshold_cd_m2,
                                input.structure};
    thresholds.unknown_too = true;
    lists_.build(input.geometry, input.pattern, profile, thresholds, input.lights, input.visible);
    const bool has_tail = input.pattern.tail_scale > 0 && input.pattern.pitch > 0;
    tail_from_nodes_ = has_tail ? input.pattern.window_inner / input.pattern.pitch : 1e9;
    quads_.build(input.geometry, lists_, input.lights, tail_from_nodes_);
    if (!upload()) return false;
    set_uniforms(input);
    while (grids_.size() + 1 < lists_.levels().size())
        grids_.emplace_back(gl_);
    for (int level = 1; level < lists_.levels_used(); ++level) {
        const GridLevel& grid = lists_.levels()[static_cast<std::size_t>(level)];
        FloatBuffer& buffer = grids_[static_cast<std::size_t>(level - 1)];
        buffer.resize(GL_RGBA32F, grid.width, grid.height, "a grid of the HDR sum");
        if (level + 1 < lists_.levels_used()) continue;
        buffer.bind_for_drawing();
        buffer.clear();
    }
    return true;
}

bool GlGrids::upload() {
    const std::span<const GatherLight> lights = lists_.lights();
    const std::span<const std::int32_t> sources = lists_.sources();
    texels_.resize(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i)
        texels_[i] = texels_of(lights[i], sources[i]);
    const std::size_t light_bytes = texels_.size() * sizeof(texels_[0]);
    const std::size_t needed = light_bytes + quads_.quads().size_bytes();
    if (needed > most_bytes_) return false;
    if (!buffer_) {
        buffer_ = GlObject(gl_, GlKind::buffer);
        buffer_texture_ = GlObject(gl_, GlKind::texture);
    }
    gl_.BindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
    const bool is_new = bytes_ == 0;
    bytes_ = std::max({bytes_, needed, texel_bytes});
    // Orphaned: the GPU may still be reading the last frame's.
    gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes_), nullptr, GL_STREAM_DRAW);
    gl_.BufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(light_bytes), texels_.data());
    gl_.BufferSubData(GL_TEXTURE_BUFFER, static_cast<GLintptr>(light_bytes),
                      static_cast<GLsizeiptr>(quads_.quads().size_bytes()), quads_.quads().data());
    if (!is_new) return true;
    label(gl_, GL_BUFFER, buffer_.name(), "Seaglare: lights on grids");
    gl_.ActiveTexture(GL_TEXTURE0 + lights_unit);
    gl_.BindTexture(GL_TEXTURE_BUFFER, buffer_texture_.name());
    gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_.name());
    return true;
}

void GlGrids::set_uniforms(const AccumulationInput& input) {
    const ScreenGeometry& g = input.geometry;
    const Pattern& pattern = input.pattern;
    const int layers = pattern.skirt.empty() ? 0 : static_cast<int>(pattern.layer_radius_nodes.size());
    slots_ = pattern.lamps.size();
    lashes_ = pattern.lash_turn_rad != 0 || pattern.lash_bend_per_rad != 0;
    const auto& m = g.ray_from_ndc;
    for_each_program([&](const GlProgram& program) {
        program.use();
        program.set("ray_constant", m[6] - m[0] - m[3], m[7] - m[1] - m[4], m[8] - m[2] - m[5]);
        program.set("ray_per_x", 2 * m[0] / g.width_px, 2 * m[1] / g.width_px, 2 * m[2] / g.width_px);
        program.set("ray_per_y", 2 * m[3] / g.height_px, 2 * m[4] / g.height_px, 2 * m[5] / g.height_px);
        program.set("hides", input.visible.empty() ? 0 : 1);
        program.set("quads_from", static_cast<int>(texels_.size() * sizeof(texels_[0]) / texel_bytes));
        program.set("layer_count", layers);
        program.set("radius_nodes", pattern.radius_nodes);
        program.set("tail_table", tail_table_);
        program.set("tail_from2", tail_from_nodes_ * tail_from_nodes_);
        program.set("departures_scale", static_cast<double>(textures_.departures_scale()));
        program.set("middle", 0.5);
        program.set("per_node", 1.0 / std::max(textures_.nodes_across(), 1));
    });
}

void GlGrids::bind(GLuint pattern) const {
    gl_.ActiveTexture(GL_TEXTURE0 + lights_unit);
    gl_.BindTexture(GL_TEXTURE_BUFFER, buffer_texture_.name());
    if (pattern != 0) {
        gl_.ActiveTexture(GL_TEXTURE0 + pattern_unit);
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, pattern);
    }
    gl_.ActiveTexture(GL_TEXTURE0 + tables_unit);
    gl_.BindTexture(GL_TEXTURE_2D, textures_.radial());
}

std::uint32_t GlGrids::draw(QuadKind kind, const FloatBuffer& to, const GridLevel& grid,
                            QuadRange quads) const {
    if (quads.count() == 0) return 0;
    const GlProgram& program = program_of(kind);
    program.use();
    const double cell = grid.cell_px;
    const double first_px = 0.5 - (0.5 + grid.pad) * cell;
    program.set("cell_px", cell);
    program.set("first_px", first_px, first_px + to.first_row());
    program.set("first_quad", quads.first);
    program.set("buffer_size", static_cast<double>(to.width_px()), static_cast<double>(to.height_px()));
    gl_.Enable(GL_BLEND);
    gl_.DrawArrays(GL_TRIANGLES, 0, 6 * quads.count());
    return 1;
}

// From the grid above level `level`, which `to` is or a band of, and bound.
std::uint32_t GlGrids::upsample(const FloatBuffer& to, int level) const {
    const auto at = static_cast<std::size_t>(level);
    upsample_.use();
    upsample_.set("pad", lists_.levels()[at].pad);
    upsample_.set("bottom", to.first_row());
    gl_.ActiveTexture(GL_TEXTURE0 + tables_unit);
    gl_.BindTexture(GL_TEXTURE_2D, grids_[at].texture());
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    return 1;
}

std::uint32_t GlGrids::draw_grids(const PatternTexture& pattern) {
    pattern_ = pattern.texture();
    for_each_program([&](const GlProgram& program) {
        program.use();
        program.set("pattern_scale", pattern.scale().first(slots_));
    });
    std::uint32_t draws = 0;
    const int used = lists_.levels_used();
    for (int level = used - 1; level > 0; --level) {
        const auto at = static_cast<std::size_t>(level);
        const FloatBuffer& to = grids_[at - 1];
        to.bind_for_drawing();
        gl_.Disable(GL_BLEND);
        if (level + 1 < used) draws += upsample(to, level);
        bind(0);
        for (const QuadKind kind : {QuadKind::mean_of_one, QuadKind::mean_of_two})
            draws += draw(kind, to, lists_.levels()[at], quads_.of_level(level, kind));
    }
    return draws;
}

std::uint32_t GlGrids::draw_band(const FloatBuffer& to, RowRange band) {
    std::uint32_t draws = 0;
    to.bind_for_drawing();
    gl_.Enable(GL_BLEND);
    if (lists_.levels_used() > 1) draws += upsample(to, 0);
    const auto draw_kind = [&](QuadKind kind) {
        draws += draw(kind, to, lists_.levels()[0], quads_.of_band(band, kind));
    };
    bind(pattern_);
    for (const QuadKind kind : {QuadKind::near_one, QuadKind::near_two, QuadKind::near_and_tail})
        draw_kind(kind);
    bind(textures_.departures());
    gl_.BindSampler(pattern_unit, linear_.name());
    for (const QuadKind kind : {QuadKind::departs_one, QuadKind::departs_two, QuadKind::departs_fading})
        draw_kind(kind);
    gl_.BindSampler(pattern_unit, plain_.name());
    return draws;
}

double GlGrids::grid_bytes() const {
    double bytes = 0;
    for (const FloatBuffer& grid : grids_)
        bytes += grid.memory_bytes();
    return bytes;
}

void GlGrids::forget() {
    for_each_program([](GlProgram& program) { program.forget(); });
    upsample_.forget();
    linear_.forget();
    textures_.forget();
    for (FloatBuffer& grid : grids_)
        grid.forget();
    buffer_.forget();
    buffer_texture_.forget();
}

}  // namespace seaglare::glare
