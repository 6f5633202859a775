#include "glare/apply/cost_probe.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <span>
#include <vector>

#include "glare/device/gl_object.h"
#include "glare/device/gl_touched_state.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

namespace {

constexpr int width_px = 128;
constexpr int height_px = 64;
constexpr std::size_t many = 4;
constexpr int runs = 2;  // the better of them counts
// Where the first run says no more than this of any cost, by which it differs from the usual one, there is no second.
constexpr double as_usual = 1.5;

double now_ms() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(since).count();
}

// Whether a device is the one that the usual costs are of. What was disturbed is hardly ever.
bool is_usual(const ProbeTimes& times) {
    const DeviceCosts usual;
    const DeviceCosts costs = measured_costs(times);
    for (std::size_t i = 0; i < work_kinds; ++i) {
        const double ratio = costs.ns[i] / usual.ns[i];
        if (ratio > as_usual || ratio < 1 / as_usual) return false;
    }
    return true;
}

// A picture of which a pixel is as large as a node of the pattern.
Frame small_frame(double pitch) {
    Frame frame;
    frame.viewport_px = {0, 0, width_px, height_px};
    auto& m = frame.clip_from_view;
    m[0] = 2 / (width_px * pitch);
    m[5] = 2 / (height_px * pitch);
    m[10] = m[11] = -1;
    m[14] = -0.2;
    return frame;
}

// Lights in a row, so that nothing is the same for two of them.
std::vector<PointSource> row_of_lights(double pitch) {
    std::vector<PointSource> lights(many);
    for (std::size_t i = 0; i < many; ++i) {
        constexpr double distance_m = 1000;
        const double x_px = width_px * ((static_cast<double>(i) + 0.5) / many - 0.5);
        lights[i].position_view_m = {static_cast<float>(x_px * pitch * distance_m), 0,
                                     static_cast<float>(-distance_m)};
        lights[i].illuminance_rgb_lx = {1e-3F, 1e-3F, 1e-3F};
        lights[i].illuminance_scotopic_lx = 2.5e-3F;
        lights[i].tag = static_cast<std::uint32_t>(i);
    }
    return lights;
}

class Target {
  public:
    explicit Target(const Gl& gl) : texture_(gl, GlKind::texture), framebuffer_(gl, GlKind::framebuffer) {
        set_neutral_pixel_store(gl);
        gl.ActiveTexture(GL_TEXTURE0);
        gl.BindTexture(GL_TEXTURE_2D, texture_.name());
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_px, height_px, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    }
    GLuint fbo() const { return framebuffer_.name(); }

  private:
    GlObject texture_;
    GlObject framebuffer_;
};

struct Picture {
    double ProbeTimes::*time;
    std::size_t lights;
    Accumulation method;
    double threshold_cd_m2;
};
// Below such a threshold nothing but the core is left.
constexpr double all = std::numeric_limits<double>::max();
constexpr std::array<Picture, 5> pictures = {
    {{&ProbeTimes::core, 1, Accumulation::gl_billboards, all},
     {&ProbeTimes::skirt, 1, Accumulation::gl_billboards, 0},
     {&ProbeTimes::many_skirts, many, Accumulation::gl_billboards, 0},
     {&ProbeTimes::gather, 1, Accumulation::cl_tiles, 0},
     {&ProbeTimes::many_gathered, many, Accumulation::cl_tiles, 0}}};
constexpr std::size_t drawn_pictures = 3;

constexpr int no_tail = 0;
constexpr int tail_on_the_picture = 1;
constexpr int tail_on_a_grid = 8;

// Draws pictures on a target of its own, and leaves the renderer as if it had drawn nothing.
class Studio {
  public:
    Studio(const Gl& gl, ViewRenderer& renderer, const Pattern& pattern)
        : gl_(gl),
          renderer_(renderer),
          pattern_(pattern),
          target_(gl),
          frame_(small_frame(pattern.pitch)),
          lights_(row_of_lights(pattern.pitch)) {
        renderer.set_timed(false);
        frame_.target_fbo = target_.fbo();
    }
    ~Studio() {
        renderer_.mark_nothing_drawn({});
        gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
        gl_.BindTexture(GL_TEXTURE_2D, 0);
    }
    Studio(const Studio&) = delete;
    Studio& operator=(const Studio&) = delete;

    std::span<const Picture> possible() const {
        return std::span(pictures).first(renderer_.can_gather() ? pictures.size() : drawn_pictures);
    }
    struct Drawn {
        double ms = 0;
        double draw_calls = 0;
    };
    Drawn draw(const Picture& picture, int tail_cell_px, bool is_timed) {
        AccumulationPlan plan;
        plan.method = picture.method;
        plan.skirt_threshold_cd_m2 = picture.threshold_cd_m2;
        plan.tail_cell_px = tail_cell_px;
        RenderStats stats;
        const double begin_ms = now_ms();
        renderer_.render(frame_, tone_, pattern_, std::span(lights_).first(picture.lights), plan, stats);
        if (is_timed) gl_.Finish();
        return {now_ms() - begin_ms, static_cast<double>(stats.draw_calls)};
    }
    // Of many lights nothing is compiled that one did not need. Tails have programs of their own, on the picture and on its
    // grid: a frame that gathers meets the first of them when a light comes of which it is not known what hides it.
    void draw_each_kind() {
        for (const Picture& picture : possible())
            if (picture.lights == 1) draw(picture, no_tail, false);
        for (const int tail_cell_px : {tail_on_the_picture, tail_on_a_grid})
            draw(pictures[1], tail_cell_px, false);
    }

  private:
    const Gl& gl_;
    ViewRenderer& renderer_;
    const Pattern& pattern_;
    Target target_;
    Frame frame_;
    std::vector<PointSource> lights_;
    ToneSettings tone_;
};

}  // namespace

void draw_each_kind_once(const Gl& gl, ViewRenderer& renderer, const Pattern& pattern) {
    if (pattern.pitch > 0) Studio(gl, renderer, pattern).draw_each_kind();
}

ProbeTimes probe_costs(const Gl& gl, ViewRenderer& renderer, const Pattern& pattern, double at_most_ms) {
    ProbeTimes times;
    if (!(pattern.pitch > 0)) return times;
    times.picture_px = width_px * height_px;
    times.lights = many;
    Studio studio(gl, renderer, pattern);
    gl.Finish();
    double spent_ms = 0;
    for (int run = 0; run < runs && (run == 0 || !is_usual(times)); ++run) {
        for (const Picture& picture : studio.possible()) {
            if (spent_ms >= at_most_ms) break;
            const Studio::Drawn drawn = studio.draw(picture, no_tail, true);
            if (picture.time == &ProbeTimes::core) times.draws = drawn.draw_calls;
            spent_ms += drawn.ms;
            double& best_ms = times.*picture.time;
            best_ms = run == 0 ? drawn.ms : std::min(best_ms, drawn.ms);
        }
    }
    // Two ways of which one alone was measured, on a machine as slow as that, could not be compared.
    const std::span<const Picture> possible = studio.possible();
    const bool complete = std::all_of(possible.begin(), possible.end(),
                                      [&](const Picture& picture) { return times.*picture.time > 0; });
    if (!complete) return {};
    return times;
}

}  // namespace seaglare::glare
