#include "host_stub/report/frame_subject.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "glare/colour/lamp_list.h"
#include "glare/psf/pattern_grid.h"
#include "host_stub/headless.h"
#include "host_stub/report/pattern_archive.h"
#include "host_stub/timing.h"
#include "plugin_api/api.h"
#include "plugin_api/context.h"

namespace seaglare::report {

namespace {

constexpr double interval_s = 1.0 / 60;
constexpr int widest_field =
    4096;  // samples: how far the structure of the reference reaches, as the default's does
constexpr int lamp_step_nm = 5;  // of the CIE's tables

host::Plugin linked_product() {
    seaglare_api api{};
    api.struct_size = sizeof api;
    if (plugin::fill_api(SEAGLARE_ABI_MAJOR, &api) < 0)
        throw std::runtime_error("the product's own table cannot be filled");
    return host::Plugin(api);
}

// Of the frame what evaluation looks at.
glare::Frame seen_frame(const seaglare_frame& from) {
    glare::Frame to;
    std::copy_n(from.viewport_px, 4, to.viewport_px.begin());
    std::copy_n(from.clip_from_view, 16, to.clip_from_view.begin());
    to.time_s = from.time_s;
    return to;
}

host::SceneOptions scene_options(const std::filesystem::path& scene, const FrameOptions& options) {
    host::SceneOptions wanted;
    wanted.scene = scene;
    wanted.size = options.size;
    return wanted;
}

}  // namespace

double process_cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

struct FrameSubject::Impl {
    Impl(const host::Plugin& of, const std::filesystem::path& file, const FrameOptions& wanted,
         std::uint32_t crowd_count)
        : plugin(of),
          options(wanted),
          simulation(scene_options(file, wanted)),
          scene(simulation.scene()),
          picture(scene),
          target(simulation.channel().width_px, simulation.channel().height_px, simulation.channel().target),
          settings(plugin::load_settings(scene.quality_file.string())) {
        if (scene.crowd && crowd_count > 0) scene.crowd->count = crowd_count;
        if (options.cache.empty()) options.cache = options.out / "cache";
        std::filesystem::create_directories(options.out);
        start_s = simulation.time_s();
        draw_host(start_s);
        before = target.read_srgb_rgba8();
        const seaglare_frame frame = frame_now();
        screen.emplace(std::bit_cast<std::array<double, 16>>(frame.clip_from_view), target.width_px(),
                       target.height_px());
        look_at_lights(frame);
    }

    void draw_host(double time_s) {
        simulation.go_to(time_s);
        picture.set_moment(simulation.moment());
        glBindFramebuffer(GL_FRAMEBUFFER, target.multisampled_fbo());
        picture.draw(simulation.camera(), simulation.channel());
        target.resolve();
    }

    seaglare_frame frame_now() const {
        seaglare_frame frame = host::make_frame(simulation, simulation.camera(), target,
                                                picture.adaptation_luminance_cd_m2(), interval_s);
        frame.depth_source = SEAGLARE_DEPTH_NONE;
        frame.depth_object = 0;
        return frame;
    }

    std::filesystem::path quality_with(const Changes& changes) {
        std::filesystem::path file = options.out / ("quality_" + scene.name + ".json");
        // Dither moves bytes by up to half a code: it is not what is measured.
        Changes all = changes;
        all.emplace("display.dither", "false");
        write_quality(scene.quality_file, all, file);
        return file;
    }

    // The same scene in the product's parts, linked into this tool, with nothing left out: which lights reach the eye.
    void look_at_lights(const seaglare_frame& frame) {
        const host::Plugin own = linked_product();
        host::Scene all = scene;
        all.quality_file = quality_with({{"budget.max_error_codes", "0"}});
        host::Glare glare(own, all, simulation.channel(), simulation.observer(),
                          host::HeadlessContext::get_proc, {});
        glare.move_lights(frame.time_s);
        lightdb::Evaluated evaluated;
        state = glare.context()->context.evaluate(frame, seen_frame(frame), 0.0, evaluated);
        lights = evaluated.sources;
    }

    glare::PatternRequest pattern_request(double time_s) const {
        glare::PatternRequest request;
        request.pupil_mm = state.pupil_mm;
        request.resting_pupil_mm = state.resting_pupil_mm;
        request.time_s = time_s;
        request.pitch = screen->pitch();
        request.lamp_list = state.lamps.get();
        request.lids = state.lids;
        request.vitreous_roll_rad = state.vitreous_roll_rad;
        request.lamps = 0;
        for (const glare::PointSource& light : lights)
            request.lamps |= 1U << light.lamp;
        return request;
    }

    const host::Plugin& plugin;
    FrameOptions options;
    host::Simulation simulation;
    host::Scene scene;
    host::NightScene picture;
    host::RenderTarget target;
    plugin::Settings settings;
    double start_s = 0;
    std::vector<std::uint8_t> before;
    std::optional<reference::FrameScreen> screen;
    plugin::FrameState state;
    std::vector<glare::PointSource> lights;
    std::vector<reference::Rgbv> truth;
    double structure_scale = 1;
};

FrameSubject::FrameSubject(const host::Plugin& plugin, const std::filesystem::path& scene,
                           const FrameOptions& options, std::uint32_t crowd_count)
    : impl_(std::make_unique<Impl>(plugin, scene, options, crowd_count)) {}

FrameSubject::~FrameSubject() = default;

const std::string& FrameSubject::name() const {
    return impl_->scene.name;
}
int FrameSubject::width_px() const {
    return impl_->target.width_px();
}
int FrameSubject::height_px() const {
    return impl_->target.height_px();
}
const plugin::Settings& FrameSubject::settings() const {
    return impl_->settings;
}
std::uint64_t FrameSubject::seed() const {
    return impl_->scene.seed;
}
const std::vector<glare::PointSource>& FrameSubject::lights() const {
    return impl_->lights;
}
const std::vector<std::uint8_t>& FrameSubject::before() const {
    return impl_->before;
}
const reference::FrameScreen& FrameSubject::screen() const {
    return *impl_->screen;
}
double FrameSubject::structure_scale() const {
    return impl_->structure_scale;
}

reference::DisplayState FrameSubject::display() const {
    reference::DisplayState display;
    display.tone = impl_->settings.tone;
    display.adaptation_cd_m2 = impl_->state.adaptation_luminance_cd_m2;
    return display;
}

FrameRun FrameSubject::run(const Changes& changes, int warm_up, int frames, bool wait,
                           std::uint32_t create_flags) {
    Impl& self = *impl_;
    host::Scene changed = self.scene;
    changed.quality_file = self.quality_with(changes);
    host::Glare glare(self.plugin, changed, self.simulation.channel(), self.simulation.observer(),
                      host::HeadlessContext::get_proc, {}, create_flags);
    FrameRun run;
    for (int i = 1 - warm_up - frames; i <= 0; ++i) {
        self.draw_host(self.start_s + i * interval_s);
        glare.move_lights(self.simulation.time_s());
        seaglare_frame frame = self.frame_now();
        // The first has to wait: on a busy machine a few frames would else be over before there is any pattern.
        const bool first = warm_up > 0 && i == 1 - warm_up - frames;
        if (wait || first) frame.flags |= SEAGLARE_FRAME_WAIT;
        glFinish();
        const host::Stopwatch watch;
        const double cpu_before = process_cpu_ms();
        const seaglare_result result = glare.render(frame);
        glFinish();
        if (result < 0)
            throw host::PluginError("rendering " + self.scene.name + ": " +
                                    self.plugin.api().result_string(result) + ": " + glare.last_error());
        if (i <= -frames) continue;
        run.wall_ms.push_back(watch.ms());
        run.cpu_ms.push_back(process_cpu_ms() - cpu_before);
        run.stats.push_back(glare.stats());
    }
    run.hdr = glare.hdr(width_px(), height_px());
    run.after = self.target.read_srgb_rgba8();
    return run;
}

const std::vector<reference::Rgbv>& FrameSubject::truth(Progress& progress) {
    Impl& self = *impl_;
    if (!self.truth.empty()) return self.truth;
    // The field that the default reaches, whatever a scene's quality makes of it.
    glare::PatternSettings widest = self.settings.pattern;
    widest.wide_field_size = 0;
    widest.transform_size = widest_field;
    const glare::PatternGrid grid = glare::plan_grid(widest, self.screen->pitch());

    const glare::PatternRequest wanted = self.pattern_request(self.start_s);
    reference::ShapeRequest request;
    request.eye = self.settings.eye;
    request.pupil_mm = self.state.pupil_mm;
    request.time_s = self.start_s;
    request.seed = self.scene.seed;
    request.pitch = self.screen->pitch();
    request.angular_scale = self.settings.pattern.angular_scale;
    request.core_radius_px = self.settings.pattern.core_radius_nodes;
    request.window_inner = grid.window_inner;
    request.window_outer = grid.window_outer;
    const glare::LampList& lamps =
        wanted.lamp_list != nullptr ? *wanted.lamp_list : glare::navigation_lamps();
    for (std::uint8_t lamp = 0; lamp < glare::most_lamps; ++lamp) {
        if ((wanted.lamps >> lamp & 1U) == 0) continue;
        request.lamps.push_back(lamp);
        const std::shared_ptr<const glare::LampSpectrum> spectrum = lamps.spectra.at(lamp);
        const auto power = [&](double wavelength_nm) {
            return spectrum ? spectrum->power(wavelength_nm)
                            : glare::navigation_spectrum(static_cast<int>(lamp))(wavelength_nm);
        };
        request.lines.push_back(reference::lines_of(power, std::max(self.options.step_nm, lamp_step_nm)));
    }
    const auto show = [&](const std::string& what, double done) {
        progress.show(self.scene.name + ": " + what, done);
    };
    const reference::GlareShape shape =
        reference::make_shape(request, archived_patterns(self.options.cache, show));
    self.structure_scale = shape.structure_scale;
    self.truth = reference::draw_frame(*self.screen, shape, self.lights,
                                       [&](double done) { show("reference frame", done); });
    return self.truth;
}

reference::GlareShape FrameSubject::same_shape(const Changes& changes) {
    Impl& self = *impl_;
    const plugin::Settings settings = plugin::load_settings(self.quality_with(changes).string());
    std::unique_ptr<glare::PatternSource> source;
    try {
        source = glare::make_cl_pattern_source(settings.eye, settings.pattern, self.scene.seed);
    } catch (const std::runtime_error&) {
        source = glare::make_cpu_pattern_source(settings.eye, settings.pattern, self.scene.seed);
    }
    glare::PatternRequest request = self.pattern_request(self.start_s);
    for (const glare::PointSource& light : self.lights) {
        const double distance =
            std::hypot(light.position_view_m[0], light.position_view_m[1], light.position_view_m[2]);
        const double sine = std::min(static_cast<double>(light.radius_m) / std::max(distance, 1e-6), 1.0);
        request.largest_disc_nodes =
            std::max(request.largest_disc_nodes, static_cast<float>(sine / request.pitch));
    }
    return reference::shape_of(source->make(request));
}

std::vector<reference::Rgbv> FrameSubject::same_sum(const Changes& changes, Progress& progress,
                                                    int row_step) {
    return reference::draw_frame(
        *impl_->screen, same_shape(changes), impl_->lights,
        [&](double done) { progress.show(impl_->scene.name + ": sum of the same pattern", done); }, row_step);
}

}  // namespace seaglare::report
