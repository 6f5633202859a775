// What tone mapping glare and adding it to the host's pixels costs, on shipped scenes: the sum of lights and the host's
// picture are taken from the stub host's frame, then the last pass alone is run on them. Prints CSV: processor time of all
// threads, least and median, and the largest error in 8-bit display codes against the operators in double precision.
//
//   bench_composite [SCENE...]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "glare/apply/compositor.h"
#include "glare/device/gl_object.h"
#include "glare/device/gl_touched_state.h"
#include "glare/tone/operators.h"
#include "host_stub/headless.h"
#include "tests/benchmark/composite_scene.h"

namespace {

using namespace seaglare;
using namespace seaglare::glare;
using benchmark::Captured;

constexpr int frames = 15;

double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct TargetKind {
    const char* name;
    GLenum format;
    TargetEncoding encoding;
};
constexpr std::array<TargetKind, 6> target_kinds = {{
    {"RGBA8, sRGB values", GL_RGBA8, TargetEncoding::srgb_values},
    {"SRGB8_ALPHA8", GL_SRGB8_ALPHA8, TargetEncoding::srgb_format},
    {"RGBA8, linear", GL_RGBA8, TargetEncoding::linear},
    {"RGBA16F, linear", GL_RGBA16F, TargetEncoding::linear},
    {"RGBA32F, sRGB values", GL_RGBA32F, TargetEncoding::srgb_values},
    {"RGBA32F, linear", GL_RGBA32F, TargetEncoding::linear},
}};

// A picture of a target's format, filled with what was captured.
class Picture {
  public:
    Picture(const Gl& gl, const Captured& captured, const TargetKind& kind)
        : gl_(gl),
          captured_(captured),
          kind_(kind),
          texture_(gl, GlKind::texture),
          fbo_(gl, GlKind::framebuffer) {
        const bool decoded = kind.encoding == TargetEncoding::linear;
        const std::size_t values = captured.codes.size();
        floats_.resize(values);
        for (std::size_t i = 0; i < values; ++i) {
            const double stored = captured.codes[i] / 255.0;
            floats_[i] = static_cast<float>(decoded && i % 4 != 3 ? srgb_decode(stored) : stored);
        }
        gl.ActiveTexture(GL_TEXTURE0);
        gl.BindTexture(GL_TEXTURE_2D, texture_.name());
        gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(kind.format), captured.width_px,
                      captured.height_px, 0, GL_RGBA, GL_FLOAT, floats_.data());
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        gl.BindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
        // What is stored, after the format's own rounding.
        floats_ = read();
    }
    void restore() const {
        gl_.ActiveTexture(GL_TEXTURE0);
        gl_.BindTexture(GL_TEXTURE_2D, texture_.name());
        gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, captured_.width_px, captured_.height_px, GL_RGBA, GL_FLOAT,
                          floats_.data());
        gl_.Finish();
    }
    GLuint fbo() const { return fbo_.name(); }
    std::span<const float> before() const { return floats_; }
    std::vector<float> read() const {
        std::vector<float> values(captured_.codes.size());
        gl_.BindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
        gl_.Disable(GL_FRAMEBUFFER_SRGB);
        gl_.ReadPixels(0, 0, captured_.width_px, captured_.height_px, GL_RGBA, GL_FLOAT, values.data());
        return values;
    }

  private:
    const Gl& gl_;
    const Captured& captured_;
    TargetKind kind_;
    GlObject texture_;
    GlObject fbo_;
    std::vector<float> floats_;
};

// In 8-bit sRGB codes, of what is stored; an 8-bit target's own rounding is in it.
double worst_error_codes(const Captured& captured, const Frame& frame, const ToneSettings& tone,
                         std::span<const float> before, std::span<const float> after) {
    const bool linear = frame.target_encoding == TargetEncoding::linear;
    double worst = 0;
    for (std::size_t i = 0; i < captured.rgbv.size(); i += 4) {
        const float* const hdr = &captured.rgbv[i];
        Rgb was{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto stored = static_cast<double>(before[i + c]);
            was[c] = linear ? stored : srgb_decode(stored);
        }
        const Rgb delta =
            display_delta(tone, frame.adaptation_luminance_cd_m2, frame.ldr_white_luminance_cd_m2, was,
                          {hdr[0], hdr[1], hdr[2]}, hdr[3]);
        for (std::size_t c = 0; c < 3; ++c) {
            const double is = static_cast<double>(after[i + c]);
            const double error =
                srgb_encode(was[c] + delta[c]) - (linear ? srgb_encode(is) : std::clamp(is, 0.0, 1.0));
            worst = std::max(worst, 255 * std::abs(error));
        }
    }
    return worst;
}

struct Cost {
    double least_ms = 0;
    double median_ms = 0;
};
Cost cost_of(const std::function<void()>& prepare, const std::function<void()>& work) {
    std::vector<double> ms;
    for (int i = 0; i < frames + 2; ++i) {
        prepare();
        const double begin_ms = processor_ms();
        work();
        if (i >= 2) ms.push_back(processor_ms() - begin_ms);
    }
    std::sort(ms.begin(), ms.end());
    return {ms.front(), ms[ms.size() / 2]};
}

void measure(const Gl& gl, const std::string& scene) {
    const Captured captured = benchmark::capture(scene);
    set_neutral_state(gl);
    set_neutral_pixel_store(gl);
    const GlObject vertex_array(gl, GlKind::vertex_array);
    gl.BindVertexArray(vertex_array.name());
    for (GLuint unit = 0; unit < touched_texture_units; ++unit)
        gl.BindSampler(unit, 0);
    const int width = captured.width_px;
    const int height = captured.height_px;
    for (const TargetKind& kind : target_kinds) {
        for (const int cell_px : {0, 4}) {
            if (cell_px > 0 && &kind != target_kinds.data()) continue;
            const Picture picture(gl, captured, kind);
            Compositor compositor(gl);
            HdrSum sum(gl);
            Frame frame;
            frame.viewport_px = {0, 0, width, height};
            frame.target_fbo = picture.fbo();
            frame.target_encoding = kind.encoding;
            frame.adaptation_luminance_cd_m2 = captured.adaptation_cd_m2;
            frame.ldr_white_luminance_cd_m2 = captured.ldr_white_cd_m2;
            ToneSettings tone;
            const auto in_bands = [&](bool fill, bool draw) {
                for (int first = 0; first < height; first += band_rows) {
                    const RowRange band{first, std::min(band_rows, height - first)};
                    const auto row = static_cast<std::size_t>(width) * 4;
                    if (fill)
                        sum.fill(band, std::span(captured.rgbv)
                                           .subspan(row * static_cast<std::size_t>(first),
                                                    row * static_cast<std::size_t>(band.count)));
                    if (draw) compositor.draw(frame, tone, sum, {0, band.first, width, band.end()});
                }
                gl.Finish();
            };
            const auto restore = [&] {
                picture.restore();
                set_neutral_state(gl);
                compositor.begin(frame);
                sum.begin(width, height, cell_px, compositor.least_cd_m2(frame, tone));
                if (cell_px > 0) sum.light_grid();
                gl.Finish();
            };
            const Cost fill = cost_of(restore, [&] { in_bands(true, false); });
            const Cost all = cost_of(restore, [&] { in_bands(true, true); });
            tone.dither = false;
            restore();
            in_bands(true, true);
            const double error = worst_error_codes(captured, frame, tone, picture.before(), picture.read());
            std::printf("%s,\"%s\",%d,%.2f,%.2f,%.2f,%.2f,%.3f\n", scene.c_str(), kind.name, cell_px,
                        fill.least_ms, fill.median_ms, all.least_ms - fill.least_ms,
                        all.median_ms - fill.median_ms, error);
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const host::HeadlessContext context;
        const Gl gl = load_gl(host::HeadlessContext::get_proc, nullptr);
        std::printf(
            "scene,target,grid_cell_px,upload_least_ms,upload_median_ms,composite_least_ms,"
            "composite_median_ms,worst_error_codes\n");
        std::vector<std::string> scenes(argv + 1, argv + argc);
        if (scenes.empty()) scenes = {"great_belt_night", "sonderborg_leading_line", "thesis_many_lights"};
        for (const std::string& scene : scenes)
            measure(gl, scene);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_composite: %s\n", error.what());
        return 1;
    }
    return 0;
}
