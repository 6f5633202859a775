#include "lightdb/rotation.h"

#include <algorithm>
#include <cmath>

#include "lightdb/profile.h"

namespace seaglare::lightdb {

namespace {

constexpr double full_turn_deg = 360;

double finite_or_zero(double value) {
    return std::isfinite(value) ? value : 0;
}

// Integral of the factor over a part of the circle, and that part's width as the sums had it: of a sweep of billionths of a
// degree, rounding takes a share of both alike, and their quotient stands.
struct Swept {
    double factor_deg = 0;
    double width_deg = 0;
};

Swept operator+(const Swept& a, const Swept& b) {
    return {a.factor_deg + b.factor_deg, a.width_deg + b.width_deg};
}

// From `from_deg` to `to_deg`, both within the turn that begins at the table's first angle.
Swept swept_in_turn(const AngleTable& table, double from_deg, double to_deg) {
    const std::size_t count = table.angle_deg.size();
    const double turn_end_deg = table.angle_deg.front() + full_turn_deg;
    const auto above = std::upper_bound(table.angle_deg.begin(), table.angle_deg.end(), from_deg);
    Swept swept;
    for (auto i = static_cast<std::size_t>(above - table.angle_deg.begin()); i <= count; ++i) {
        const double left_deg = i == 0 ? table.angle_deg.front() : table.angle_deg[i - 1];
        const double right_deg = i < count ? table.angle_deg[i] : turn_end_deg;
        const double width_deg = right_deg - left_deg;
        const double a_deg = std::max(left_deg, from_deg);
        const double b_deg = std::min(right_deg, to_deg);
        if (width_deg > 0 && b_deg > a_deg) {
            const double left = i == 0 ? table.factor.front() : table.factor[i - 1];
            const double right = i < count ? table.factor[i] : table.factor.front();
            // Of a straight piece the middle is the mean.
            const double middle_deg = a_deg + (b_deg - a_deg) / 2;
            swept.factor_deg +=
                (b_deg - a_deg) * (left + (right - left) * ((middle_deg - left_deg) / width_deg));
            swept.width_deg += b_deg - a_deg;
        }
        if (right_deg >= to_deg) break;
    }
    return swept;
}

// Over `width_deg`, less than a turn, from `from_deg` on.
Swept swept_from(const AngleTable& table, double from_deg, double width_deg) {
    const double first_deg = table.angle_deg.front();
    double start_deg = first_deg + std::fmod(from_deg - first_deg, full_turn_deg);
    if (start_deg < first_deg) start_deg += full_turn_deg;
    if (start_deg >= first_deg + full_turn_deg) start_deg = first_deg;  // -1e-20 + 360 is 360
    const double end_deg = start_deg + width_deg;
    const double turn_end_deg = first_deg + full_turn_deg;
    if (end_deg <= turn_end_deg) return swept_in_turn(table, start_deg, end_deg);
    return swept_in_turn(table, start_deg, turn_end_deg) +
           swept_in_turn(table, first_deg, end_deg - full_turn_deg);
}

}  // namespace

double mean_beam_factor(const RotatingBeam& rotation, double bearing_from_ahead_deg, double end_s,
                        double duration_s) {
    const AngleTable& beam = rotation.beam;
    if (beam.angle_deg.empty()) return 1;
    const double bearing_deg = finite_or_zero(bearing_from_ahead_deg);
    const double period_s = finite_or_zero(rotation.period_s);
    if (period_s == 0) return periodic_factor(beam, bearing_deg);
    end_s = finite_or_zero(end_s);
    duration_s = finite_or_zero(duration_s);

    // fmod is exact, so a clock of months turns the beam as precisely as one of seconds.
    const double turned_deg = full_turn_deg * (std::fmod(end_s, period_s) / period_s);
    const double end_deg = bearing_deg - turned_deg;  // the eye's bearing from the optic's zero
    if (!(duration_s > 0)) return periodic_factor(beam, end_deg);

    const double swept_s = std::fmod(duration_s, std::abs(period_s));
    const double turns = std::round((duration_s - swept_s) / std::abs(period_s));
    const double swept_deg = full_turn_deg * (swept_s / std::abs(period_s));
    // The eye runs through the optic's bearings against the turn: clockwise turning came from larger bearings.
    const double from_deg = period_s > 0 ? end_deg : end_deg - swept_deg;
    Swept swept;
    if (swept_deg > 0) swept = swept_from(beam, from_deg, swept_deg);
    if (turns > 0) {
        const double first_deg = beam.angle_deg.front();
        const Swept turn = swept_in_turn(beam, first_deg, first_deg + full_turn_deg);
        swept = swept + Swept{turns * turn.factor_deg, turns * turn.width_deg};
    }
    return swept.width_deg > 0 ? swept.factor_deg / swept.width_deg : periodic_factor(beam, end_deg);
}

}  // namespace seaglare::lightdb
