// What a time budget can give up: each kind by itself, gradually, and only while it saves time. Plain data.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace seaglare::glare {

enum class Quality : std::uint8_t {
    error,   // the error budget grows from max_error_codes to most_error_codes
    motion,  // the pattern follows the eye less often: pattern_step_s
    discs,   // the discs of near lamps leave their skirts, and their layers the pattern
    lamps,   // the patterns of coloured lamps go over to the white one
};
inline constexpr std::size_t quality_kinds = 4;

// How much of each kind is given up, 0 (nothing) ... 1 (all of it).
struct QualityLoss {
    std::array<double, quality_kinds> level{};

    double of(Quality kind) const { return level[static_cast<std::size_t>(kind)]; }
    double& of(Quality kind) { return level[static_cast<std::size_t>(kind)]; }
    bool any() const {
        return std::any_of(level.begin(), level.end(), [](double l) { return l > 0; });
    }
    // Of all there is, 0 ... 1: a quarter for each kind.
    double mean() const {
        double sum = 0;
        for (const double l : level)
            sum += l;
        return sum / static_cast<double>(quality_kinds);
    }
    friend bool operator==(const QualityLoss&, const QualityLoss&) = default;
};

// "error budget", "motion", "discs", "own patterns".
std::string_view name_of(Quality kind);

// The pattern is that of the last instant that is a whole number of these steps; 0: of every frame. Each step of the ladder is
// twice the one before, so that the instants of a longer one are among those of a shorter: views that give up as much agree.
double pattern_step_s(double level);

}  // namespace seaglare::glare
