// What moves outside the eye, and what goes over from one state to another: beams, buoys, photometers, occlusion, the patterns
// between two patterns. Expected values are closed forms in long double, written down here apart from the product's.
#include <array>
#include <numbers>
#include <optional>

#include "glare/apply/visibility_history.h"
#include "glare/plan/filter_blend.h"
#include "glare/psf/motion_keys.h"
#include "glare/psf/pattern_mix.h"
#include "host_stub/report/stability.h"
#include "lightdb/buoy.h"
#include "lightdb/daylight.h"
#include "lightdb/rotation.h"
#include "lightdb/waves.h"

namespace seaglare::report {

namespace {

constexpr double pi = std::numbers::pi;

void rotating_beams(std::vector<Check>& checks) {
    lightdb::RotatingBeam optic;
    optic.period_s = 10;
    // A triangle of one degree to either side: a mean of 1/360.
    optic.beam = {{-1, 0, 1}, {0, 1, 0}};
    const double mean_beam = 1.0 / 360;
    Check turn{"rotating beam", "one turn ending at every instant, eight bearings, 10 s and -0.5 s a turn",
               "the beam's mean around the circle", 0, 1e-11};
    Check halves{"rotating beam", "every exposure of the steps, ending at every instant",
                 "two half exposures are one", 0, 1e-12};
    Check bounded{"rotating beam", "the same", "0 to 1", 0, 0};
    Check lost{"rotating beam, 1 degree in 10 s", "frames of 1/24 to 1/240 s over 100 turns",
               "no light is lost, relative", 0, 1e-9};
    Check phase{"rotating beam", "its axis at 1e7 s, and 1 us beside it", "seen where it points", 0, 1e-4};
    for (const double period_s : {10.0, -0.5}) {
        optic.period_s = period_s;
        for (const double time_s : instants_s) {
            for (int bearing_deg = 0; bearing_deg < 360; bearing_deg += 45) {
                turn.see(
                    std::abs(mean_beam_factor(optic, bearing_deg, time_s, std::abs(period_s)) - mean_beam));
                for (const double step_s : steps_s) {
                    const double all = mean_beam_factor(optic, bearing_deg, time_s, step_s);
                    bounded.see_within(all, 0, 1);
                    if (step_s < 1e-6) continue;  // an instant that time in double precision no longer halves
                    const double first =
                        mean_beam_factor(optic, bearing_deg, time_s - step_s / 2, step_s / 2);
                    const double second = mean_beam_factor(optic, bearing_deg, time_s, step_s / 2);
                    // Of a mean over a part of a turn: times in 1e7 s are known to 2e-9 s, and that of what it is over.
                    const double known = 4 * std::abs(std::nextafter(time_s, 2e7) - time_s) / step_s;
                    halves.see(std::max(0.0, std::abs(all - (first + second) / 2) - known));
                }
            }
        }
    }
    optic.period_s = 10;
    for (const double rate_hz : {24.0, 1000 / 33.37, 60.0, 240.0}) {
        const int frames = static_cast<int>(std::round(1000 * rate_hz));
        double seconds = 0;
        for (int i = 1; i <= frames; ++i)
            seconds += lightdb::mean_beam_factor(optic, 123, i * 1000.0 / frames, 1000.0 / frames) / frames;
        lost.see(std::abs(seconds / mean_beam - 1));
    }
    // At 1e7 s, a whole number of turns, the optic points ahead; a microsecond on, by 3.6e-5 degrees elsewhere.
    for (const double beside_s : {-1e-6, 0.0, 1e-6})
        phase.see(std::abs(lightdb::mean_beam_factor(optic, 0, 1e7 + beside_s, 0) - 1));
    checks.insert(checks.end(), {turn, halves, bounded, lost, phase});
}

void buoys(std::vector<Check>& checks) {
    using namespace lightdb;
    constexpr double infinite_depth = std::numeric_limits<double>::infinity();
    const std::vector<WaveComponent> sea = {wave_of_length(1.5, 30, 80, 0.4, infinite_depth),
                                            wave_of_length(0.4, 80, 21, 2.0, infinite_depth),
                                            wave_of_length(0.2, -60, 9, 5.0, infinite_depth)};
    Buoy buoy;
    buoy.body_id = 1;
    buoy.position_m = {400, -90, 0};
    Check closed{"buoy, heave", "three waves, every instant", "the driven oscillator's steady state, m", 0,
                 1e-7};
    Check step{"buoy, heave", "the same, 1 ms later", "no step above what the waves' speeds allow, relative",
               0, 1};
    Check tilt{"buoy, tilt", "the same, and a sea about to break", "at most max_tilt_deg; a unit quaternion",
               0, 1e-12};
    Check steady{"buoy", "resonance, damping 0.001 to 10, wave periods 0.01 s to 1e4 s",
                 "the gain is finite and at most 1/(2 damping) or so", 0, 1e-9};
    Check still{"buoy", "no waves, a time that is NaN or infinite", "upright, at its mooring", 0, 0};
    const Oscillator heave = heave_of(buoy);
    for (const double time_s : instants_s) {
        const double z = buoy_pose(buoy, sea, time_s).position_m[2];
        long double expected = 0;
        double fastest = 0;
        for (const WaveComponent& wave : sea) {
            const long double w = wave.angular_frequency_rad_s;
            const long double w0 = 2 * std::numbers::pi_v<long double> / heave.period_s;
            const long double gain_inverse = std::hypot(w0 * w0 - w * w, 2 * heave.damping * w0 * w);
            const long double lag = std::atan2(2 * heave.damping * w0 * w, w0 * w0 - w * w);
            const long double direction = wave.direction_deg * std::numbers::pi_v<long double> / 180;
            const long double along = wave.wavenumber_rad_m * (buoy.position_m[0] * std::sin(direction) +
                                                               buoy.position_m[1] * std::cos(direction));
            const long double size = wave.amplitude_m * w0 * w0 / gain_inverse;
            expected += size * std::cos(along - w * time_s + wave.phase_rad + lag);
            fastest += static_cast<double>(size * w);
        }
        closed.see(static_cast<double>(std::abs(z - expected)));
        const double later = buoy_pose(buoy, sea, time_s + 1e-3).position_m[2];
        step.see(std::abs(later - z) / (1e-3 * fastest));
        for (const double amplitude_m : {1.0, 1e6}) {
            const std::vector<WaveComponent> breaking = {
                wave_of_length(amplitude_m, 0, 30, 1, infinite_depth)};
            const BodyPose pose = buoy_pose(buoy, breaking, time_s);
            const auto& q = pose.orientation;
            const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
            tilt.see(std::abs(length - 1));
            const double leans_rad = 2 * std::acos(std::clamp(std::abs(q[3]) / length, 0.0, 1.0));
            tilt.see_within(leans_rad, 0, buoy.max_tilt_deg * pi / 180 + 1e-12);
        }
    }
    for (const double damping : {0.001, 0.1, 1.0, 10.0}) {
        // The largest gain of an oscillator that is driven: 1 / (2 d sqrt(1 - d^2)), or 1 where it does not resonate.
        const double peak =
            damping < std::sqrt(0.5) ? 1 / (2 * damping * std::sqrt(1 - damping * damping)) : 1;
        for (const double period_s : {0.01, 2.9, 3.0, 3.1, 20.0, 1e4})
            steady.see_within(std::abs(response({3, damping}, 2 * pi / period_s)), 0, peak);
    }
    for (const double time_s : {0.0, 1e7, std::numeric_limits<double>::quiet_NaN(), infinite_depth}) {
        const BodyPose pose = buoy_pose(buoy, {}, time_s);
        still.see(pose.position_m == buoy.position_m && pose.orientation[3] == 1 ? 0 : 1);
        still.see(std::isfinite(buoy_pose(buoy, sea, time_s).position_m[2]) ? 0 : 1);
    }
    checks.insert(checks.end(), {closed, step, tilt, steady, still});
}

void photometer(std::vector<Check>& checks) {
    Check once{"photometer", "adaptation 0 to 1e6 and back in 2000 steps, and between the two in one frame",
               "switches once on each way, up above 30 and down below 15 cd/m2", 0, 0};
    Check holds{"photometer", "a cloud: 16 to 29 cd/m2 to and fro, NaN between", "stays as it was", 0, 0};
    std::optional<bool> day;
    int switched = 0;
    const auto see = [&](double luminance) {
        const bool now = lightdb::is_day(luminance, day);
        if (day && *day != now) ++switched;
        day = now;
        if (luminance > 30) once.see(now ? 0 : 1);
        if (luminance < 15) once.see(now ? 1 : 0);
    };
    see(0);
    for (int i = 0; i <= 2000; ++i)
        see(std::pow(10, -6 + 12 * i / 2000.0));
    once.see(std::abs(switched - 1));
    for (int i = 2000; i >= 0; --i)
        see(std::pow(10, -6 + 12 * i / 2000.0));
    once.see(std::abs(switched - 2));
    for (const double luminance : {1e6, 0.0, 1e6, 0.0})
        see(luminance);
    once.see(std::abs(switched - 6));
    for (const bool was : {false, true})
        for (const double luminance : {16.0, 29.0, 20.0, std::numeric_limits<double>::quiet_NaN()})
            holds.see(lightdb::is_day(luminance, was) == was ? 0 : 1);
    checks.insert(checks.end(), {once, holds});
}

// How much of what is seen counts in a frame that comes `step_s` after another: of a light that both have.
double blend_after(double step_s, double smoothing_s, double time_s) {
    glare::VisibilityHistory history;
    const std::vector<glare::LightInstance> lights(1);
    const std::vector<std::uint32_t> tags = {1};
    std::vector<std::int32_t> previous;
    history.begin(time_s, smoothing_s);
    history.match(lights, tags, previous);
    history.begin(time_s + step_s, smoothing_s);
    return history.blend();
}

void occlusion(std::vector<Check>& checks) {
    Check closed{"occlusion smoothing", "every step up to 1 s, time constants 1 ms to 10 s, from 0 s",
                 "1 - exp(-dt/tau)", 0, 1e-12};
    Check halves{"occlusion smoothing", "the same", "two half steps are one", 0, 1e-12};
    Check late{"occlusion smoothing", "the same at every instant up to 1e7 s", "0 to 1, and as from 0 s", 0,
               1e-6};
    Check anew{"occlusion smoothing", "a hitch of 10 s, a clock set back, NaN", "what is seen counts at once",
               0, 0};
    for (const double tau_s : {1e-3, 0.1, 10.0}) {
        for (const double step_s : steps_s) {
            if (step_s > glare::VisibilityHistory::longest_step_s) continue;
            const double all = blend_after(step_s, tau_s, 0);
            closed.see(
                std::abs(all - static_cast<double>(-std::expm1(-static_cast<long double>(step_s) / tau_s))));
            const double half = blend_after(step_s / 2, tau_s, 0);
            halves.see(std::abs((1 - half) * (1 - half) - (1 - all)));
            for (const double time_s : instants_s) {
                const double then = blend_after(step_s, tau_s, time_s);
                late.see_within(then, 0, 1);
                // Times are rounded to 2e-9 s there, which is that much of the time constant.
                late.see(std::max(0.0, std::abs(then - all) - 4e-9 / tau_s));
            }
        }
        for (const double step_s : {10.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
            anew.see(std::abs(blend_after(step_s, tau_s, 100) - 1));
    }
    checks.insert(checks.end(), {closed, halves, late, anew});
}

void keys_of_motion(std::vector<Check>& checks) {
    using namespace glare;
    EyeModel eye = no_lash_eye();
    eye.lids.motion.blink_interval_s = 0;
    Check sum{"pattern between two patterns", "interpolated, flip book; every instant, every adaptation",
              "weights add up to 1, each 0 to 1", 0, 1e-12};
    Check flow{"pattern between two patterns", "the same, over every key in frames of 1/240 s",
               "no weight jumps by more than the frame's share", 0, 1e-6};
    Check same{"pattern between two patterns", "the same", "pupil within what the two keys have", 0, 1e-12};
    for (const MotionMode mode : {MotionMode::interpolated, MotionMode::flip_book}) {
        PatternMotion motion;
        motion.mode = mode;
        const double keys_per_s =
            mode == MotionMode::interpolated ? motion.rate_hz : motion.frames / motion.loop_s;
        for (const double adaptation : adaptations_cd_m2) {
            for (const double from_s : instants_s) {
                EyeMoment moment;
                moment.request.pitch = 1e-3;
                moment.adaptation_cd_m2 = adaptation;
                double before = -1;
                for (int frame = 0; frame < 60; ++frame) {
                    const double time_s = from_s + frame / 240.0;
                    moment.request = request_at(eye, 7, moment, time_s);
                    const MotionKeys keys = motion_keys(eye, motion, 7, moment);
                    double total = 0;
                    double later = 0;
                    for (int i = 0; i < keys.count; ++i) {
                        const double weight = keys.list[static_cast<std::size_t>(i)].weight;
                        sum.see_within(weight, 0, 1);
                        total += weight;
                        later = weight;
                        same.see_within(keys.list[static_cast<std::size_t>(i)].request.pupil_mm, 1.5, 8.5);
                    }
                    sum.see(std::abs(total - 1));
                    // Where in the row of keys the picture is: a number that rises evenly, modulo one key.
                    const double place = keys.count > 1 ? later : 0;
                    if (before >= 0) {
                        const double moved = std::remainder(place - before - keys_per_s / 240, 1.0);
                        flow.see(std::abs(moved));
                    }
                    before = place;
                }
            }
        }
    }
    checks.insert(checks.end(), {sum, flow, same});
}

// Patterns of `lamps` lamps and one layer; each adds up to 1.
glare::Pattern made_up(std::size_t lamps, int shape) {
    glare::Pattern p;
    p.generation = static_cast<std::uint64_t>(shape) + 1;
    p.radius_nodes = 4;
    p.pitch = 0.1;
    p.layer_radius_nodes = {0};
    p.lamps.clear();
    const std::size_t nodes = 81;
    for (std::size_t lamp = 0; lamp < lamps; ++lamp) {
        p.slot_of_lamp[lamp] = static_cast<std::uint8_t>(lamp);
        p.lamps.push_back(static_cast<std::uint8_t>(lamp));
        p.core_energy[lamp].fill(0.5F);
        for (std::size_t n = 0; n < nodes * 4; ++n)
            p.skirt.push_back(static_cast<float>((1 + std::sin(static_cast<double>(n + lamp) * (shape + 1))) *
                                                 0.5 / 81 / 0.01));
    }
    return p;
}

double energy_of(const glare::Pattern& p, std::size_t slot) {
    const std::size_t floats = p.skirt.size() / p.lamps.size();
    double sum = 0;
    for (std::size_t i = 1; i < floats; i += 4)
        sum += static_cast<double>(p.skirt[slot * floats + i]);
    return static_cast<double>(p.core_energy[slot][1]) + sum * p.pitch * p.pitch;
}

void blends(std::vector<Check>& checks) {
    Check mixed{"patterns mixed", "weights 0 to 1, below, above and NaN", "energy between the two patterns'",
                0, 1e-5};
    Check filtered{"lamps faded into the white one", "blend 0 to 1, below, above",
                   "energy between the two lamps', every lamp", 0, 1e-5};
    Check ends{"patterns mixed, lamps faded", "the ends", "one of the two, to rounding", 0, 1e-5};
    const glare::Pattern a = made_up(3, 0);
    const glare::Pattern b = made_up(3, 1);
    glare::Pattern out;
    for (const double weight : {-1.0, 0.0, 1e-9, 0.3, 1.0, 5.0, std::numeric_limits<double>::quiet_NaN()}) {
        glare::mix_patterns(a, b, weight, out);
        for (std::size_t slot = 0; slot < 3; ++slot) {
            const auto [low, high] = std::minmax({energy_of(a, slot), energy_of(b, slot)});
            mixed.see_within(energy_of(out, slot), low, high);
        }
        if (!(weight < 1)) ends.see(std::abs(energy_of(out, 2) - energy_of(b, 2)));
        if (weight <= 0) ends.see(std::abs(energy_of(out, 2) - energy_of(a, 2)));
        if (std::isnan(weight)) continue;
        glare::blend_towards_first_lamp(a, weight, out);
        for (std::size_t slot = 0; slot < 3; ++slot) {
            const auto [low, high] = std::minmax({energy_of(a, 0), energy_of(a, slot)});
            filtered.see_within(energy_of(out, slot), low, high);
        }
        if (weight >= 1) ends.see(std::abs(energy_of(out, 2) - energy_of(a, 0)));
    }
    checks.insert(checks.end(), {mixed, filtered, ends});
}

}  // namespace

std::vector<Check> moving_lights() {
    std::vector<Check> checks;
    rotating_beams(checks);
    buoys(checks);
    photometer(checks);
    occlusion(checks);
    keys_of_motion(checks);
    blends(checks);
    return checks;
}

}  // namespace seaglare::report
