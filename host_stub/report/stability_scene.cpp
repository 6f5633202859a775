// The ends of what a scene can hold: how many lights, how far away, how small or large the picture.
#include <numbers>

#include "glare/apply/view_renderer.h"
#include "host_stub/report/psf_errors.h"
#include "host_stub/report/stability.h"
#include "lightdb/evaluate.h"

namespace seaglare::report {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

lightdb::Light lamp(double east_m, double north_m, double intensity_cd) {
    lightdb::Light light;
    light.position_m = {east_m, north_m, 10};
    light.intensity_cd[static_cast<std::size_t>(lightdb::Colour::white)] = intensity_cd;
    return light;
}

// Looks north: x right, y up, z back.
lightdb::Observer at(double east_m, double north_m) {
    lightdb::Observer observer;
    observer.eye_m = {east_m, north_m, 10};
    observer.view_from_scene = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -east_m, -10, north_m, 1};
    observer.geographic_horizon = false;
    return observer;
}

glare::Frame frame_of(int width_px, int height_px, double vfov_deg) {
    glare::Frame frame;
    frame.viewport_px = {0, 0, width_px, height_px};
    const double t = std::tan(vfov_deg * std::numbers::pi / 360);
    frame.clip_from_view = {height_px / (width_px * t), 0, 0, 0, 0, 1 / t, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0};
    frame.adaptation_luminance_cd_m2 = 0.001;
    return frame;
}

double lux_of(const glare::PointSource& source) {
    double lux = 0;
    for (const float channel : source.illuminance_rgb_lx)
        lux += std::isfinite(channel) ? static_cast<double>(std::abs(channel)) : infinity;
    for (const float metre : source.position_view_m)
        lux += std::isfinite(metre) ? 0 : infinity;
    return lux;
}

void counts(std::vector<Check>& checks, int most_lights) {
    Check all{"lights", "0, 1 and " + std::to_string(most_lights) + ", over 40 km, every one seen",
              "each is evaluated or told why not; finite", 0, 0};
    for (const int count : {0, 1, most_lights}) {
        lightdb::LightStore store;
        const int across = std::max(1, static_cast<int>(std::sqrt(count)));
        for (int i = 0; i < count; ++i) {
            const int row = i / across;
            store.add(lamp(40e3 * (i % across) / across - 20e3, 40e3 * row / across, 100));
        }
        store.optimise();
        lightdb::Evaluated out;
        evaluate(store, at(0, -100), out);
        all.see(std::abs(
            static_cast<double>(out.sources.size() + out.dark + out.below_horizon + out.too_faint) - count));
        for (const glare::PointSource& source : out.sources)
            all.see_within(lux_of(source), 0, 1e14);
    }
    checks.push_back(all);
}

void distances(std::vector<Check>& checks) {
    Check same{"distance from the origin", "a light at 1 m to 60 km, seen from 0 to 1e7 m from the origin",
               "illuminance as at the origin, relative", 0, 1e-6};
    Check finite{"camera",
                 "inside the light, before and behind it, on the near plane, 0 to 1e7 m from the origin",
                 "finite; a light behind gives no more than all of its own", 0, 0};
    const glare::Frame frame = frame_of(1280, 720, 45);
    for (const double origin_m : {0.0, 1e3, 1e6, 1e7}) {
        for (const double away_m : {-1e3, -0.1, -0.01, 0.0, 1e-9, 0.03, 0.1, 1.0, 1e3, 6e4}) {
            lightdb::LightStore store;
            store.add(lamp(origin_m, -origin_m + away_m, 1e6));
            lightdb::Evaluated out;
            evaluate(store, at(origin_m, -origin_m), out);
            finite.see(out.sources.size() == 1 ? 0 : 1);
            for (const glare::PointSource& source : out.sources) {
                const double lux = lux_of(source);
                finite.see_within(lux, 0, 3e6 / (0.05 * 0.05) * 1.0001);
                // At 1e7 m a double knows a place to 2e-9 m.
                if (away_m >= 1) same.see(std::abs(lux / (3e6 / (away_m * away_m)) - 1));
            }
            glare::RenderStats stats;
            const std::size_t kept = glare::ViewRenderer::cull(frame, {}, out.sources, stats);
            finite.see_within(static_cast<double>(kept), 0, 1);
        }
    }
    checks.insert(checks.end(), {same, finite});
}

void viewports(std::vector<Check>& checks) {
    Check kept{"viewport", "1 x 1 to 16384 x 16384 pixels, 0.01 to 179.9 degrees, a light ahead",
               "it is kept, once", 0, 0};
    Check away{"viewport", "the same, a light that is not finite, or has no light", "it is left out", 0, 0};
    for (const int size_px : {1, 2, 720, 16384}) {
        for (const double vfov_deg : {0.01, 1.0, 45.0, 179.0, 179.9}) {
            const glare::Frame frame = frame_of(size_px, size_px, vfov_deg);
            glare::PointSource source;
            source.position_view_m = {0, 0, -1000};
            source.illuminance_rgb_lx = {1, 1, 1};
            source.illuminance_scotopic_lx = 2.5F;
            std::vector<glare::PointSource> lights = {source, source, source};
            lights[1].position_view_m[1] = std::numeric_limits<float>::quiet_NaN();
            lights[2].illuminance_rgb_lx = {0, 0, 0};
            lights[2].illuminance_scotopic_lx = 0;
            glare::RenderStats stats;
            const std::size_t count = glare::ViewRenderer::cull(frame, {}, lights, stats);
            kept.see(std::abs(static_cast<double>(count) - 1));
            away.see(count > 0 && lights[0].illuminance_rgb_lx[0] == 1 ? 0 : 1);
        }
    }
    checks.insert(checks.end(), {kept, away});
}

// What a half float cannot hold, which is why sums are floats and textures are scaled.
void halves(std::vector<Check>& checks) {
    Check clamped{"half floats", "5e-6 to 1e16, both signs, NaN left out", "finite, at most 65504", 0, 65504};
    Check exact{"half floats", "6.1e-5 to 65504", "relative error of rounding", 0, 1.0 / 2048};
    for (const double value : {5e-6, 6.1e-5, 1e-3, 1.0, 1000.0, 65504.0, 1e5, 1e16}) {
        for (const double sign : {-1.0, 1.0}) {
            const auto half = static_cast<double>(to_half(static_cast<float>(sign * value)));
            clamped.see(std::abs(half));
            if (value > 6.2e-5 && value <= 65504) exact.see(std::abs(half / (sign * value) - 1));
        }
    }
    checks.insert(checks.end(), {clamped, exact});
}

}  // namespace

std::vector<Check> scene_extremes(int most_lights) {
    std::vector<Check> checks;
    counts(checks, most_lights);
    distances(checks);
    viewports(checks);
    halves(checks);
    return checks;
}

}  // namespace seaglare::report
