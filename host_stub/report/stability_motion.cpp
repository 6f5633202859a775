// Every part of the eye and of a light that moves, at time steps from nothing to ten seconds and at times up to 1e7 s. The
// expected values are closed forms in long double, written down here apart from the product's.
#include <array>
#include <numbers>
#include <utility>

#include "glare/eye/accommodation.h"
#include "glare/eye/adaptation.h"
#include "glare/eye/aperture.h"
#include "glare/eye/exact_step.h"
#include "glare/eye/eye_model.h"
#include "glare/eye/eye_state.h"
#include "glare/eye/lids.h"
#include "glare/eye/vitreous.h"
#include "host_stub/report/stability.h"
#include "lightdb/rhythm.h"

namespace seaglare::report {

namespace {

using namespace glare;

double decayed(double from, double to, double step_s, double time_constant_s) {
    const long double share = std::exp(-static_cast<long double>(step_s) / time_constant_s);
    return static_cast<double>(to + (static_cast<long double>(from) - to) * share);
}

void light_adaptation(std::vector<Check>& checks) {
    Check closed{"light adaptation", "every step, every pair of luminances", "closed form, relative", 0,
                 1e-12};
    Check halves{"light adaptation", "the same", "two half steps are one, relative", 0, 1e-12};
    Check between{"light adaptation", "the same", "stays between start and goal", 0, 0};
    for (const double from : adaptations_cd_m2) {
        for (const double to : adaptations_cd_m2) {
            const double scale = std::max({from, to, 1e-30});
            const double rods = 0.04 / (0.04 + to);
            for (const double step_s : steps_s) {
                const double after = light_adapted_cd_m2(from, to, step_s);
                closed.see(std::abs(after - decayed(from, to, step_s, rods * 0.4 + (1 - rods) * 0.1)) /
                           scale);
                const double twice =
                    light_adapted_cd_m2(light_adapted_cd_m2(from, to, step_s / 2), to, step_s / 2);
                halves.see(std::abs(after - twice) / scale);
                between.see_within(after, std::min(from, to), std::max(from, to));
            }
        }
    }
    checks.insert(checks.end(), {closed, halves, between});
}

void dark_adaptation(std::vector<Check>& checks) {
    Check closed{"pigments (bleaching)", "every step, every luminance, from 0 and 1", "closed form", 0,
                 1e-12};
    Check halves{"pigments (bleaching)", "the same", "two half steps are one", 0, 1e-12};
    Check inside{"pigments (bleaching)", "the same", "between start and rest", 0, 0};
    Check recovery{"pigments (bleaching)", "from 0 in the dark, 60 to 1800 s", "published table", 0, 5e-4};
    for (const double luminance : adaptations_cd_m2) {
        const double rod_rest = 0.04 / (0.04 + luminance);
        const double cone_rest = 2e6 / (2e6 + luminance);
        for (const double start : {0.0, 1.0}) {
            for (const double step_s : steps_s) {
                const Pigments after = bleached({start, start}, luminance, step_s);
                closed.see(
                    std::abs(after.rod - decayed(start, rod_rest, step_s, 1 / (1.0 / 400 + luminance / 16))));
                closed.see(std::abs(after.cone -
                                    decayed(start, cone_rest, step_s, 1 / (1.0 / 110 + luminance / 2.2e8))));
                const Pigments twice =
                    bleached(bleached({start, start}, luminance, step_s / 2), luminance, step_s / 2);
                halves.see(std::max(std::abs(after.rod - twice.rod), std::abs(after.cone - twice.cone)));
                const Pigments rest = pigments_at_rest(luminance);
                inside.see_within(after.rod, std::min(start, rest.rod), std::max(start, rest.rod));
                inside.see_within(after.cone, std::min(start, rest.cone), std::max(start, rest.cone));
            }
        }
    }
    constexpr double table[][3] = {
        {60, 0.139, 0.420}, {300, 0.528, 0.935}, {600, 0.777, 0.9957}, {1800, 0.989, 1.000}};
    for (const auto& row : table) {
        const Pigments p = bleached({0, 0}, 0, row[0]);
        recovery.see(std::max(std::abs(p.rod - row[1]), std::abs(p.cone - row[2])));
    }
    checks.insert(checks.end(), {closed, halves, inside, recovery});
}

void springs(std::vector<Check>& checks) {
    Check closed{"damped spring", "damping 0.2, 1, 2; every step; omega 0.1 to 1e4 per s",
                 "textbook solution", 0, 1e-11};
    Check halves{"damped spring", "damping 0.2 to 1e4, and 1 +- 1e-6", "two half steps are one", 0, 1e-10};
    Check bounded{"damped spring", "the same, from rest at 1", "never beyond its start", 0, 1e-12};
    for (const double omega : {0.1, 1.0, 50.0, 1e4}) {
        for (const double step_s : steps_s) {
            const long double t = step_s;
            const long double w = omega;
            const long double wd = w * std::sqrt(1 - 0.04L);
            const long double under =
                std::exp(-0.2L * w * t) * (std::cos(wd * t) + 0.2L * w / wd * std::sin(wd * t));
            closed.see(std::abs(sprung({1, 0}, 0, step_s, omega, 0.2).position - static_cast<double>(under)));
            const long double critical = std::exp(-w * t) * (1 + w * t);
            closed.see(
                std::abs(sprung({1, 0}, 0, step_s, omega, 1).position - static_cast<double>(critical)));
            const long double slow = w * (2 - std::sqrt(3.0L));
            const long double fast = w * (2 + std::sqrt(3.0L));
            const long double over =
                (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow);
            closed.see(std::abs(sprung({1, 0}, 0, step_s, omega, 2).position - static_cast<double>(over)));
            for (const double damping : {0.2, 1 - 1e-6, 1.0, 1 + 1e-6, 3.0, 1e4}) {
                const SpringState once = sprung({1, 0}, 0, step_s, omega, damping);
                const SpringState half = sprung({1, 0}, 0, step_s / 2, omega, damping);
                const SpringState twice = sprung(half, 0, step_s / 2, omega, damping);
                halves.see(std::abs(once.position - twice.position));
                halves.see(std::abs(once.velocity - twice.velocity) / omega);
                bounded.see_within(once.position, -1, 1);
            }
        }
    }
    checks.insert(checks.end(), {closed, halves, bounded});
}

void vitreous_cloud(std::vector<Check>& checks) {
    Check closed{"vitreous cloud", "head starts to roll at 1 rad/s; every step; drag 0.1 to 100 per s",
                 "angle -(1 - exp(-drag t))/drag", 0, 1e-12};
    Check halves{"vitreous cloud", "a head that turns about all axes, up to 5.4 rad/s",
                 "two half steps are one", 0, 1e-12};
    Check unit{"vitreous cloud", "1e5 steps of 1/60 s with a head that shakes", "the quaternion has length 1",
               0, 1e-14};
    for (const double drag : {0.1, 2.0, 100.0}) {
        for (const double step_s : steps_s) {
            const VitreousState lags = turned({}, {0, 0, 1}, drag, 0);
            const double wanted =
                -static_cast<double>(-std::expm1(-static_cast<long double>(drag) * step_s) / drag);
            const double angle = roll_about_sight_rad(turned(lags, {0, 0, 1}, drag, step_s));
            closed.see(std::abs(std::remainder(angle - wanted, 2 * std::numbers::pi)));
            const std::array<double, 3> head = {0.3, -2, 5};
            const VitreousState start = turned({}, head, drag, 0);
            const VitreousState once = turned(start, head, drag, step_s);
            const VitreousState twice = turned(turned(start, head, drag, step_s / 2), head, drag, step_s / 2);
            for (std::size_t i = 0; i < 4; ++i)
                halves.see(std::abs(once.orientation[i] - twice.orientation[i]));
        }
    }
    VitreousState state;
    for (int i = 0; i < 100000; ++i) {
        const double t = i / 60.0;
        state = turned(state, {std::sin(3 * t), std::cos(2 * t), 5 * std::sin(7 * t)}, 2, 1.0 / 60);
        double squared = 0;
        for (const double q : state.orientation)
            squared += q * q;
        unit.see(std::abs(squared - 1));
    }
    checks.insert(checks.end(), {closed, halves, unit});
}

// Parts that are functions of the time alone: bounded, smooth from one frame to the next, the same when asked again.
void pure_functions(std::vector<Check>& checks) {
    const EyeModel eye = young_eye();
    Check pupil{"pupil with hippus", "every instant, every adaptation", "1.5 to 8.5 mm", 0, 0};
    Check steady{"pupil with hippus", "frames of 1/240 s, each adaptation", "no step above 0.02 mm", 0, 0.02};
    Check monotonic{"pupil at rest", "adaptation 0 to 1e6", "never wider in more light", 0, 0};
    double before = 9;
    for (const double luminance : adaptations_cd_m2) {
        const double mean = mean_pupil_diameter_mm(luminance);
        monotonic.see(std::max(0.0, mean - before));
        before = mean;
        for (const double time_s : instants_s) {
            const double now = pupil_diameter_mm(eye, luminance, time_s, 7);
            pupil.see_within(now, 1.5, 8.5);
            steady.see(std::abs(pupil_diameter_mm(eye, luminance, time_s + 1.0 / 240, 7) - now));
        }
    }
    LidMotion lids;
    lids.blink_interval_s = 4;
    lids.squint = 0.5;
    Check lid{"lids", "every instant, every adaptation", "closure 0 to 1", 0, 0};
    AccommodationMotion focus;
    focus.slow_dioptre = 0.3;
    focus.quick_dioptre = 0.1;
    Check accommodation{"accommodation", "every instant, pupil 1.5 to 8.5 mm", "at most 0.4 dioptre", 0,
                        1e-12};
    Check again{"pupil, lids, accommodation", "every instant, asked twice", "the same to the last bit", 0, 0};
    for (const double time_s : instants_s) {
        for (const double luminance : adaptations_cd_m2) {
            const double closure = lid_closure(lids, luminance, time_s, 7);
            lid.see_within(closure, 0, 1);
            again.see(closure == lid_closure(lids, luminance, time_s, 7) ? 0 : 1);
            const double mm = pupil_diameter_mm(eye, luminance, time_s, 7);
            again.see(mm == pupil_diameter_mm(eye, luminance, time_s, 7) ? 0 : 1);
            const double dioptre = accommodation_dioptre(focus, mm, time_s, 7);
            accommodation.see_within(dioptre, -0.4, 0.4);
            again.see(dioptre == accommodation_dioptre(focus, mm, time_s, 7) ? 0 : 1);
        }
    }
    EyeModel drifting = young_eye();
    for (ParticleFamily& family : drifting.particles)
        family.drift_um = 200;
    const ApertureParts parts(drifting, 7);
    Check drift{"particle drift", "every instant, and 1/240 s later", "no step above 2 um (9 mm over 4096)",
                0, 2e-3 * 4096 / 9};
    std::vector<Disc> now;
    std::vector<Disc> later;
    for (const double time_s : instants_s) {
        EyeInstant instant;
        instant.pupil_mm = 7;
        instant.time_s = time_s;
        parts.place(instant, 4096, 9, now);
        instant.time_s = time_s + 1.0 / 240;
        parts.place(instant, 4096, 9, later);
        drift.see(now.size() == later.size() ? 0 : 1e9);
        for (std::size_t i = 0; i < std::min(now.size(), later.size()); i += 97)
            drift.see(static_cast<double>(std::hypot(now[i].x - later[i].x, now[i].y - later[i].y)));
    }
    checks.insert(checks.end(), {pupil, steady, monotonic, lid, accommodation, again, drift});
}

// What accumulates, as a frame steps it: adaptation and the vitreous body, over frames that come when they come.
void accumulated_state(std::vector<Check>& checks) {
    EyeModel eye = no_lash_eye();
    Check jump{"eye state", "0 to 1e6 cd/m2 and back, each in one frame, every step, every instant",
               "between the two, and the exact step; relative", 0, 1e-8};
    Check views{"eye state", "five views of an instant, clocks set back, NaN", "one step or none", 0, 0};
    Check resumed{"eye state", "100 frames with a head that turns, read and set half way",
                  "the same to the last bit", 0, 0};
    for (const double from_s : instants_s) {
        for (const double step_s : steps_s) {
            for (const auto& [was, goal] : {std::pair{0.0, 1e6}, {1e6, 0.0}, {1e-6, 1e4}}) {
                const EyeState before = advanced({}, eye, {was, {}, from_s});
                const EyeState after = advanced(before, eye, {goal, {}, from_s + step_s});
                // The step that two rounded times leave of it.
                const double taken_s = (from_s + step_s) - from_s;
                const double rods = 0.04 / (0.04 + goal);
                const double expected =
                    taken_s > 0 ? decayed(was, goal, taken_s, rods * 0.4 + (1 - rods) * 0.1) : was;
                jump.see(std::abs(*after.adapted_cd_m2 - expected) / std::max(was, goal));
                jump.see_within(*after.adapted_cd_m2, std::min(was, goal), std::max(was, goal));
                for (int view = 0; view < 4; ++view)
                    views.see(advanced(after, eye, {goal, {}, from_s + step_s}).adapted_cd_m2 ==
                                      after.adapted_cd_m2
                                  ? 0
                                  : 1);
                for (const double time_s : {from_s - 5, std::numeric_limits<double>::quiet_NaN()})
                    views.see(advanced(after, eye, {goal, {}, time_s}).adapted_cd_m2 == after.adapted_cd_m2
                                  ? 0
                                  : 1);
            }
        }
        const auto frame = [&](int i) {
            const double t = i / 60.0;
            return EyeSurroundings{
                std::pow(10, std::sin(t)), {std::sin(3 * t), 0, 5 * std::cos(t)}, from_s + t};
        };
        EyeState whole;
        EyeState parts;
        for (int i = 0; i < 100; ++i) {
            whole = advanced(whole, eye, frame(i));
            parts = advanced(parts, eye, frame(i));
            if (i == 50) parts = EyeState{parts};
        }
        resumed.see(whole == parts ? 0 : 1);
    }
    checks.insert(checks.end(), {jump, views, resumed});
}

void lids_and_focus(std::vector<Check>& checks) {
    LidMotion lids;
    lids.blink_interval_s = 4;
    lids.blink_duration_s = 0.3;
    Check mean{"blink", "1000 intervals from 0 and from 1e6 s",
               "shut for half of its duration, in all: relative", 0, 1e-4};
    // The steepest of 6t^5 - 15t^4 + 10t^3 is 15/8 in its own time, and a blink shuts in a third of its.
    Check smooth{"blink", "frames of 1/240 s over 1000 intervals", "no step above what its course allows", 0,
                 15.0 / 8 / 0.1 / 240};
    Check squint{"squint", "adaptation 0 to 1e6", "never more open in more light; half at its half", 0,
                 1e-12};
    for (const double from_s : {0.0, 1e6}) {
        double sum = 0;
        double before = lid_closure(lids, 0, from_s, 7);
        constexpr int frames = 1000 * 4 * 240;
        for (int i = 0; i < frames; ++i) {
            const double now = lid_closure(lids, 0, from_s + (i + 0.5) / 240, 7);
            sum += now / 240;
            smooth.see(std::abs(now - before));
            before = now;
        }
        mean.see(std::abs(sum / (1000 * 0.3 / 2) - 1));
    }
    lids.squint = 0.5;
    lids.blink_interval_s = 0;
    double before = 0;
    for (const double luminance : adaptations_cd_m2) {
        const double now = lid_closure(lids, luminance, 0, 7);
        squint.see(std::max(0.0, before - now));
        before = now;
    }
    squint.see(std::abs(lid_closure(lids, lids.squint_half_cd_m2, 0, 7) - 0.25));
    AccommodationMotion focus;
    focus.slow_dioptre = 0.3;
    focus.quick_dioptre = 0.1;
    // Noise of two octaves whose steepest is 15/8 of a swing of 2, and a sine of at most 2.1 Hz and its wandering.
    Check course{"accommodation", "frames of 1/240 s at every instant", "no step above 0.015 dioptre", 0,
                 0.015};
    Check scale{"lens", "the same, and 1e3 dioptre", "scaled by 0.5 to 2", 0, 0};
    for (const double from_s : instants_s) {
        double last = accommodation_dioptre(focus, 7, from_s, 7);
        for (int i = 1; i < 480; ++i) {
            const double now = accommodation_dioptre(focus, 7, from_s + i / 240.0, 7);
            course.see(std::abs(now - last));
            last = now;
            scale.see_within(lens_scale(focus, 7, from_s + i / 240.0, 7), 0.5, 2);
            scale.see_within(lens_scale({1e3, 1e3}, 7, from_s + i / 240.0, 7), 0.5, 2);
        }
    }
    checks.insert(checks.end(), {mean, smooth, squint, course, scale});
}

void rhythms(std::vector<Check>& checks) {
    using namespace lightdb;
    Rhythm rhythm;
    rhythm.phases = {{0.005, true, Colour::white}, {1.995, false}, {1, true, Colour::red}, {4.1, false}};
    rhythm.period_s = 7.1;
    const double duty = (0.005 + 1) / 7.1;
    const auto sum = [](const LitFractions& lit) { return lit[0] + lit[1]; };
    Check mean{"rhythm", "one period ending at every instant, sharp and with a lamp", "the duty cycle", 0,
               1e-12};
    Check lost{"rhythm, a flash of 5 ms", "frames of 1/24 to 1/240 s over 1000 periods",
               "no light is lost, relative", 0, 1e-9};
    Check phase{"rhythm", "an edge at 1e7 s", "within 1 us", 0, 1e-6};
    for (const double lamp_s : {0.0, 0.3}) {
        rhythm.rise_s = lamp_s;
        rhythm.fall_s = lamp_s;
        for (const double time_s : instants_s)
            mean.see(std::abs(sum(mean_lit(rhythm, time_s, rhythm.period_s)) - duty));
    }
    rhythm.rise_s = rhythm.fall_s = 0;
    for (const double rate_hz : {24.0, 1000 / 33.37, 60.0, 100 * std::numbers::e / 3, 240.0}) {
        const int frames = static_cast<int>(std::round(1000 * 7.1 * rate_hz));
        const double dt = 7100.0 / frames;
        double seconds = 0;
        for (int i = 1; i <= frames; ++i)
            seconds += mean_lit(rhythm, i * dt, dt)[0] * dt;
        lost.see(std::abs(seconds / 5 - 1));
    }
    // The first edge to darkness at or after 1e7 s: period 1408450 begins at 9999995 s and is dark from 9999995.005 s.
    const double period_begin_s = 1408450 * 7.1;
    for (const double beside_s : {-1e-6, 1e-6})
        phase.see(mean_lit(rhythm, period_begin_s + 0.005 + beside_s, 0)[0] == (beside_s < 0 ? 1 : 0) ? 0
                                                                                                      : 1);
    checks.insert(checks.end(), {mean, lost, phase});
}

}  // namespace

std::vector<Check> moving_parts() {
    std::vector<Check> checks;
    light_adaptation(checks);
    dark_adaptation(checks);
    springs(checks);
    vitreous_cloud(checks);
    accumulated_state(checks);
    pure_functions(checks);
    lids_and_focus(checks);
    rhythms(checks);
    return checks;
}

}  // namespace seaglare::report
