// Adding many lights up, beside the naive way of 2012 in the same run: one textured square of 512 x 512 pixels a light, the
// same pattern at the same angular size, blended in GL into a floating-point target. Prints CSV: processor time of all
// threads, medians, and errors in 8-bit display codes over a black picture against the same pattern summed in double
// precision with nothing left out, at pixels chosen at random. The crowd is that of config/scenes/thesis_many_lights.json
// (figure 6.19 of the 2012 master's thesis). Cores, which every way draws alike, are in the squares and in no other sum.
//
//   bench_lights [--lights N,N...] [--codes C,C...] [--frames F] [--no-yardstick] [--pixels P]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "glare/apply/cl_gather.h"
#include "glare/colour/lamp_list.h"
#include "glare/device/gl_object.h"
#include "glare/device/gl_touched_state.h"
#include "glare/eye/eye_model.h"
#include "glare/plan/light_summary.h"
#include "glare/plan/plan.h"
#include "glare/psf/cie_curve.h"
#include "glare/psf/pattern.h"
#include "glare/tone/operators.h"
#include "host_stub/headless.h"
#include "host_stub/report/billboard_yardstick.h"
#include "host_stub/timing.h"

namespace {

using namespace seaglare;
using namespace seaglare::glare;

constexpr int width_px = 1280;
constexpr int height_px = 720;
constexpr double adaptation_cd_m2 = 0.001;

double cpu_now_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

Frame frame_of_45_degrees() {
    Frame frame;
    frame.viewport_px = {0, 0, width_px, height_px};
    frame.adaptation_luminance_cd_m2 = adaptation_cd_m2;
    const double f = 1 / std::tan(22.5 * std::numbers::pi / 180);
    auto& m = frame.clip_from_view;
    m[0] = f * height_px / width_px;
    m[5] = f;
    m[10] = m[11] = -1;
    m[14] = -0.2;
    return frame;
}

// As seaglare-host makes the crowd of thesis_many_lights: anywhere in the picture, 160 m above the water, in air of 10 nm.
std::vector<PointSource> crowd(const ScreenGeometry& g, int count) {
    constexpr double eye_height_m = 160;
    constexpr double extinction_per_m = 1.6176e-4;
    constexpr std::array<int, 8> colours = {0, 0, 0, 1, 1, 2, 2, 3};
    std::mt19937_64 random(2012);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto log_uniform = [&](double low, double high) {
        return low * std::pow(high / low, uniform(random));
    };
    std::vector<PointSource> lights;
    for (int i = 0; i < count; ++i) {
        const double x = width_px * (0.02 + 0.96 * uniform(random));
        const double y = height_px * (0.02 + 0.96 * uniform(random));
        const Vec3 ray = ray_of_px(g, x, y);
        double distance_m = log_uniform(370, 9000);
        if (ray[1] < 0) distance_m = std::min(distance_m, 0.9 * eye_height_m / -ray[1]);
        const double lux =
            log_uniform(2, 150) * std::exp(-extinction_per_m * distance_m) / (distance_m * distance_m);
        PointSource light;
        light.radius_m = static_cast<float>(log_uniform(0.03, 0.15));
        const int colour = colours[random() % colours.size()];
        const UnitColour unit = navigation_colour(colour);
        light.lamp = static_cast<std::uint32_t>(colour);
        for (std::size_t k = 0; k < 3; ++k) {
            light.position_view_m[k] = static_cast<float>(ray[k] * distance_m);
            light.illuminance_rgb_lx[k] = static_cast<float>(lux * static_cast<double>(unit.rgb[k]));
        }
        light.illuminance_scotopic_lx =
            static_cast<float>(lux * static_cast<double>(unit.scotopic_per_photopic));
        lights.push_back(light);
    }
    return lights;
}

Pattern pattern_for(const ScreenGeometry& g) {
    PatternSettings settings;
    settings.transform_size = 512;
    settings.wide_field_size = 4096;
    const EyeModel eye = young_eye();
    const auto source = make_cl_pattern_source(eye, settings, 1);
    PatternRequest request;
    request.pupil_mm = request.resting_pupil_mm = resting_pupil_diameter_mm(eye, adaptation_cd_m2);
    request.pitch = g.pitch;
    request.lamps = 0xf;
    request.largest_disc_nodes = 0.4F;
    return source->make(request);
}

// What a light's skirt and tail are by glare/psf/pattern.h, in double precision; shares nothing with the ways to add up.
class Truth {
  public:
    explicit Truth(const Pattern& pattern) : p_(pattern), side_(2 * pattern.radius_nodes + 1) {
        for (std::size_t i = 0; i < curve_.size(); ++i)
            curve_[i] = cie_total_glare_sr(90 * std::sqrt(static_cast<double>(i) / curve_steps),
                                           p_.tail_age_years, p_.tail_pigmentation);
    }
    std::array<double, 4> psf(std::size_t slot, double u, double v, double cosine, double disc_nodes) const {
        std::array<double, 4> sum{};
        if (cosine <= 0) return sum;
        const auto& radii = p_.layer_radius_nodes;
        // Four times a layer's second moment: a disc's, and a cell's beside it.
        const auto moment = [](float radius) {
            const auto r = static_cast<double>(radius);
            return r > 0 ? r * r + 1.0 / 3 : 0.0;
        };
        const double first = moment(radii[0]);
        const double span = moment(radii[std::min<std::size_t>(1, radii.size() - 1)]) - first;
        const double share = span > 0 ? std::clamp((disc_nodes * disc_nodes - first) / span, 0.0, 1.0) : 0.0;
        add_layer(slot, 0, u, v, 1 - share, sum);
        if (share > 0) add_layer(slot, 1, u, v, share, sum);
        const double sine = std::hypot(u, v) * p_.pitch;
        if (p_.tail_scale > 0 && sine > p_.window_inner) {
            const double t = std::min((sine - p_.window_inner) / (p_.window_outer - p_.window_inner), 1.0);
            const double fade = std::clamp(cosine / 0.17, 0.0, 1.0);
            const double tail = p_.tail_scale *
                                curve(std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi) *
                                (0.5 - 0.5 * std::cos(std::numbers::pi * t)) * fade * fade * (3 - 2 * fade);
            for (double& channel : sum)
                channel += tail;
        }
        return sum;
    }

  private:
    static constexpr int curve_steps = 1 << 16;
    double curve(double angle_deg) const {
        const double at = angle_deg / 90 * (angle_deg / 90) * curve_steps;
        const auto i = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(curve_steps - 1));
        return curve_[i] + (at - static_cast<double>(i)) * (curve_[i + 1] - curve_[i]);
    }
    void add_layer(std::size_t slot, std::size_t layer, double u, double v, double weight,
                   std::array<double, 4>& sum) const {
        const double x = u + p_.radius_nodes;
        const double y = v + p_.radius_nodes;
        const double last = 2.0 * p_.radius_nodes;
        if (!(x >= 0 && y >= 0 && x < last && y < last)) return;
        const auto i = static_cast<std::size_t>(x);
        const auto j = static_cast<std::size_t>(y);
        const double tx = x - static_cast<double>(i);
        const double ty = y - static_cast<double>(j);
        const auto side = static_cast<std::size_t>(side_);
        const float* at =
            p_.skirt.data() + (((slot * p_.layer_radius_nodes.size() + layer) * side + j) * side + i) * 4;
        for (std::size_t c = 0; c < 4; ++c) {
            const auto node = [&](std::size_t dx, std::size_t dy) {
                return static_cast<double>(at[(dy * side + dx) * 4 + c]);
            };
            sum[c] += weight * ((1 - ty) * ((1 - tx) * node(0, 0) + tx * node(1, 0)) +
                                ty * ((1 - tx) * node(0, 1) + tx * node(1, 1)));
        }
    }
    const Pattern& p_;
    int side_;
    std::array<double, curve_steps + 1> curve_{};
};

struct Sample {
    std::size_t pixel = 0;
    std::array<double, 4> glare{};
};

std::vector<Sample> truth_at(const ScreenGeometry& g, const Pattern& pattern,
                             const std::vector<LightInstance>& lights, int pixels) {
    const Truth truth(pattern);
    std::mt19937_64 random(7);
    std::vector<Sample> samples(static_cast<std::size_t>(pixels));
    std::vector<Vec3> rays;
    for (Sample& sample : samples) {
        sample.pixel = random() % (static_cast<std::size_t>(width_px) * height_px);
        const std::size_t column = sample.pixel % width_px;
        const std::size_t row = sample.pixel / width_px;
        rays.push_back(
            normalised(ray_of_px(g, static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5)));
    }
    for (const LightInstance& light : lights) {
        const Vec3 towards =
            normalised({static_cast<double>(light.direction[0]), static_cast<double>(light.direction[1]),
                        static_cast<double>(light.direction[2])});
        const Tangents tangents = pattern_tangents(g, towards);
        for (std::size_t s = 0; s < samples.size(); ++s) {
            const auto psf =
                truth.psf(static_cast<std::size_t>(light.lamp_slot), dot(rays[s], tangents.u) / pattern.pitch,
                          dot(rays[s], tangents.v) / pattern.pitch, dot(rays[s], towards),
                          static_cast<double>(light.disc_nodes));
            for (std::size_t c = 0; c < 4; ++c)
                samples[s].glare[c] += static_cast<double>(light.illuminance[c]) * psf[c];
        }
    }
    return samples;
}

struct Error {
    double largest = 0, of_999 = 0, mean = 0;  // codes
};
Error error_of(const std::vector<float>& hdr, const std::vector<Sample>& samples) {
    const auto codes = [](const std::array<double, 4>& glare) {
        Rgb shown = display_delta({}, adaptation_cd_m2, 0, {}, {glare[0], glare[1], glare[2]}, glare[3]);
        for (double& channel : shown)
            channel = 255 * srgb_encode(channel);
        return shown;
    };
    std::vector<double> off;
    Error error;
    for (const Sample& sample : samples) {
        const float* const made = &hdr[sample.pixel * 4];
        const Rgb a = codes({static_cast<double>(made[0]), static_cast<double>(made[1]),
                             static_cast<double>(made[2]), static_cast<double>(made[3])});
        const Rgb b = codes(sample.glare);
        double most = 0;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(a[c] - b[c]));
        off.push_back(most);
        error.mean += most / static_cast<double>(samples.size());
    }
    std::sort(off.begin(), off.end());
    error.largest = off.back();
    error.of_999 = off[off.size() * 999 / 1000];
    return error;
}

struct Options {
    std::vector<double> lights = {100, 250, 500, 1000, 10000};
    std::vector<double> codes = {0.75, 0.25};
    std::vector<double> budgets = {1, 4};
    int frames = 9;
    int pixels = 20000;
    bool yardstick = true;
};
std::vector<double> numbers(const char* text) {
    std::vector<double> list;
    for (char* end = nullptr;; text = end + 1) {
        list.push_back(std::strtod(text, &end));
        if (*end != ',') return list;
    }
}
Options options_of(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0 && i + 1 < argc; };
        if (is("--lights"))
            options.lights = numbers(argv[++i]);
        else if (is("--codes"))
            options.codes = numbers(argv[++i]);
        else if (is("--budgets"))
            options.budgets = numbers(argv[++i]);
        else if (is("--frames"))
            options.frames = std::atoi(argv[++i]);
        else if (is("--pixels"))
            options.pixels = std::atoi(argv[++i]);
        else if (std::strcmp(argv[i], "--no-yardstick") == 0)
            options.yardstick = false;
    }
    return options;
}

class Bench {
  public:
    explicit Bench(const Options& options)
        : options_(options),
          gl_(load_gl(host::HeadlessContext::get_proc, nullptr)),
          frame_(frame_of_45_degrees()),
          geometry_(screen_geometry(frame_)),
          pattern_(pattern_for(geometry_)),
          target_(gl_, GlKind::texture) {
        gather_.warm_up();
        gl_.BindTexture(GL_TEXTURE_2D, target_.name());
        gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width_px, height_px, 0, GL_RGBA, GL_FLOAT, nullptr);
        hdr_.resize(static_cast<std::size_t>(width_px) * height_px * 4);
    }

    void measure(int count) {
        const std::vector<PointSource> sources = crowd(geometry_, count);
        double yardstick_ms = 0;
        if (options_.yardstick) {
            const reference::FrameScreen screen(frame_.clip_from_view, width_px, height_px);
            const report::BillboardRun run = report::draw_billboards(screen, reference::shape_of(pattern_),
                                                                     sources, false, count > 2000 ? 1 : 3);
            yardstick_ms = host::quantile(run.cpu_ms, 0.5);
            std::printf("%d,512 squares in GL,,%.1f,1,,,,,\n", count, yardstick_ms);
        }
        std::vector<Sample> samples;
        for (const double codes : options_.codes) {
            ReachSettings reach;
            reach.threshold_cd_m2 = threshold_luminance_cd_m2({}, adaptation_cd_m2, codes);
            reach.tail_threshold_cd_m2 = reach.threshold_cd_m2 / 64;
            gather(sources, samples, {"gathered in OpenCL", codes, reach, codes}, yardstick_ms);
        }
        for (const double budget : options_.budgets)
            gather(sources, samples, planned(sources, budget), yardstick_ms);
    }

  private:
    struct Allowed {
        const char* way;
        double codes;  // as the row names it
        ReachSettings reach;
        double structure_codes;
    };
    // What a plan gives the gather of a frame whose budget is so many codes, of which it is one part of several.
    Allowed planned(const std::vector<PointSource>& sources, double budget) const {
        PlanInput input;
        input.geometry = geometry_;
        input.adaptation_cd_m2 = adaptation_cd_m2;
        PatternSettings settings;
        settings.transform_size = 512;
        settings.wide_field_size = 4096;
        input.pattern = &settings;
        input.window_inner = pattern_.window_inner;
        input.window_outer = pattern_.window_outer;
        input.radius_nodes = pattern_.radius_nodes;
        input.tail_age_years = pattern_.tail_age_years;
        input.tail_pigmentation = pattern_.tail_pigmentation;
        input.can_gather = true;
        LightSummary summary;
        summarise(geometry_, sources, pattern_.window_outer / geometry_.pitch, summary);
        input.lights = &summary;
        const AccumulationPlan plan = make_plan(input, {.max_error_codes = budget}, {}).accumulation;
        ReachSettings reach;
        reach.threshold_cd_m2 = plan.skirt_threshold_cd_m2;
        reach.tail_threshold_cd_m2 = plan.tail_threshold_cd_m2;
        return {"gathered as a plan of this budget says", budget, reach, plan.structure_codes};
    }

    void gather(const std::vector<PointSource>& sources, std::vector<Sample>& samples, const Allowed& allowed,
                double yardstick_ms) {
        const CodeBudget structure = {allowed.structure_codes, tone_curve({}, adaptation_cd_m2), true};
        std::vector<LightInstance> instances;
        append_instances(geometry_, pattern_, allowed.reach, sources, instances);
        if (samples.empty())
            samples = truth_at(geometry_, pattern_, instances,
                               sources.size() > 2000 ? options_.pixels / 4 : options_.pixels);
        std::vector<double> cpu;
        std::uint32_t launches = 0;
        for (int i = -2; i < options_.frames; ++i) {
            const double start = cpu_now_ms();
            gl_.BindTexture(GL_TEXTURE_2D, target_.name());
            launches = gather_.prepare({geometry_, pattern_, allowed.reach, instances, {}, structure});
            launches += gather_.sum({0, height_px}, [&](RowRange band, std::span<const float> rgbv) {
                gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, band.first, width_px, band.count, GL_RGBA, GL_FLOAT,
                                  rgbv.data());
            });
            gl_.Finish();
            if (i >= 0) cpu.push_back(cpu_now_ms() - start);
        }
        gather_.sum({0, height_px}, [&](RowRange band, std::span<const float> rgbv) {
            std::copy(rgbv.begin(), rgbv.end(),
                      hdr_.begin() + static_cast<std::ptrdiff_t>(band.first) * width_px * 4);
        });
        const Error error = error_of(hdr_, samples);
        const double ms = host::quantile(cpu, 0.5);
        std::printf("%zu,%s,%g,%.2f,%.1f,%.2f,%.2f,%.3f,%u,%zu\n", sources.size(), allowed.way, allowed.codes,
                    ms, yardstick_ms / ms, error.largest, error.of_999, error.mean, launches,
                    gather_.lists().departures().entries().size());
        std::fflush(stdout);
    }

    Options options_;
    host::HeadlessContext context_;
    Gl gl_;
    Frame frame_;
    ScreenGeometry geometry_;
    Pattern pattern_;
    GlObject target_;
    ClGather gather_;
    std::vector<float> hdr_;
};

}  // namespace

int main(int argc, char** argv) {
    const Options options = options_of(argc, argv);
    Bench bench(options);
    std::puts(
        "lights,way,codes,cpu ms,times faster,largest error codes,of 999 in 1000,mean,launches,departures in "
        "tiles");
    for (const double count : options.lights)
        bench.measure(static_cast<int>(count));
    return 0;
}
