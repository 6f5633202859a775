#include "lightdb/lamp_glow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::lightdb {

namespace {

// One colour's lamp: how fast it follows.
struct Lamp {
    Colour colour;
    double heating_s;  // time constants
    double cooling_s;
};

Lamp lamp_of(const Rhythm& rhythm, Colour colour) {
    return {colour, std::max(rhythm.rise_s, 0.0) / std::numbers::ln10,
            std::max(rhythm.fall_s, 0.0) / std::numbers::ln10};
}

double asked_of(const Lamp& lamp, const Phase& phase) {
    return phase.lit && phase.colour == lamp.colour ? phase.level : 0;
}

double time_constant_s(const Lamp& lamp, double glow, double asked) {
    return glow < asked ? lamp.heating_s : lamp.cooling_s;
}

// What is left after `elapsed_s` of the distance to what is asked; 0 for a lamp that follows at once.
double left_after(double elapsed_s, double constant_s) {
    if (!(elapsed_s > 0)) return 1;
    return constant_s > 0 ? std::exp(-elapsed_s / constant_s) : 0;
}

double glow_after(const Lamp& lamp, double glow, double asked, double elapsed_s) {
    return asked + (glow - asked) * left_after(elapsed_s, time_constant_s(lamp, glow, asked));
}

// Integral of the glow from `from_s` to `to_s` after a phase began at `glow`.
double glow_integral_s(const Lamp& lamp, double glow, double asked, double from_s, double to_s) {
    const double constant_s = time_constant_s(lamp, glow, asked);
    double sum_s = asked * (to_s - from_s);
    if (constant_s > 0) {
        sum_s += (glow - asked) * left_after(from_s, constant_s) * constant_s *
                 -std::expm1(-(to_s - from_s) / constant_s);
    }
    return sum_s;
}

// One period from `glow` on: where it ends, and where the period would begin and end alike if every phase kept the direction
// (heating or cooling) that it took here, for then the whole period is one affine map of the glow.
struct Turn {
    double end = 0;
    double fixed = 0;
};

Turn turn_from(const Rhythm& rhythm, const Lamp& lamp, double glow) {
    Turn turn{glow, 0};
    double constants = 0;  // the period's length in time constants
    double added = 0;      // by the map to a glow of 0
    for (const Phase& phase : rhythm.phases) {
        const double asked = asked_of(lamp, phase);
        const double constant_s = time_constant_s(lamp, turn.end, asked);
        const double left = left_after(phase.duration_s, constant_s);
        constants += constant_s > 0 ? phase.duration_s / constant_s : HUGE_VAL;
        added = added * left + asked * (constant_s > 0 ? -std::expm1(-phase.duration_s / constant_s) : 1);
        turn.end = asked + (turn.end - asked) * left;
    }
    const double lost = -std::expm1(-constants);  // 1 - the map's slope, without cancellation
    turn.fixed = lost > 0 ? added / lost : glow;
    return turn;
}

// The glow with which every period begins. Light that is on or off settles in one step, because its phases heat or cool
// whatever the glow; with several levels the direction may hang on it, and the bracket makes the steps end.
double glow_at_start(const Rhythm& rhythm, const Lamp& lamp) {
    double low = 0;
    double high = 0;
    for (const Phase& phase : rhythm.phases)
        high = std::max(high, asked_of(lamp, phase));
    constexpr int most_steps = 60;  // halvings of the bracket down to the last bit
    double glow = low;
    for (int step = 0; step < most_steps; ++step) {
        const Turn turn = turn_from(rhythm, lamp, glow);
        if (std::abs(turn.fixed - glow) <= 1e-16) break;
        (turn.end > glow ? low : high) = glow;
        glow = turn.fixed >= low && turn.fixed <= high ? turn.fixed : low + (high - low) / 2;
        if (glow == low || glow == high) {
            const Turn there = turn_from(rhythm, lamp, glow);
            if (std::abs(there.end - glow) <= 1e-15) break;
        }
    }
    return glow;
}

// Calls `use` for the lamp of each colour that is ever lit.
template <class Use>
void for_each_lamp(const Rhythm& rhythm, const Use& use) {
    unsigned seen = 0;
    for (const Phase& phase : rhythm.phases) {
        const unsigned bit = 1U << static_cast<unsigned>(phase.colour);
        if (!phase.lit || (seen & bit) != 0) continue;
        seen |= bit;
        use(lamp_of(rhythm, phase.colour));
    }
}

}  // namespace

LitFractions glow_at(const Rhythm& rhythm, double position_s) {
    LitFractions result{};
    for_each_lamp(rhythm, [&](const Lamp& lamp) {
        double glow = glow_at_start(rhythm, lamp);
        double start_s = 0;
        for (const Phase& phase : rhythm.phases) {
            const double elapsed_s = std::min(phase.duration_s, position_s - start_s);
            glow = glow_after(lamp, glow, asked_of(lamp, phase), elapsed_s);
            start_s += phase.duration_s;
            if (position_s < start_s) break;
        }
        result[static_cast<std::size_t>(lamp.colour)] = glow;
    });
    return result;
}

void add_glow_seconds(const Rhythm& rhythm, double from_s, double to_s, LitFractions& glow_s) {
    for_each_lamp(rhythm, [&](const Lamp& lamp) {
        double glow = glow_at_start(rhythm, lamp);
        double start_s = 0;
        for (const Phase& phase : rhythm.phases) {
            const double asked = asked_of(lamp, phase);
            const double end_s = start_s + phase.duration_s;
            const double a_s = std::max(from_s - start_s, 0.0);
            const double b_s = std::min(to_s - start_s, phase.duration_s);
            if (b_s > a_s) {
                glow_s[static_cast<std::size_t>(lamp.colour)] += glow_integral_s(lamp, glow, asked, a_s, b_s);
            }
            if (end_s >= to_s) break;
            glow = glow_after(lamp, glow, asked, phase.duration_s);
            start_s = end_s;
        }
    });
}

}  // namespace seaglare::lightdb
