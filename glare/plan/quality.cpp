#include "glare/plan/quality.h"

namespace seaglare::glare {

std::string_view name_of(Quality kind) {
    static constexpr std::array<std::string_view, quality_kinds> names = {"error budget", "motion", "discs",
                                                                          "own patterns"};
    return names[static_cast<std::size_t>(kind)];
}

double pattern_step_s(double level) {
    // No longer: a blink takes an eighth of a second.
    constexpr std::array<double, 3> steps_s = {0, 1.0 / 32, 1.0 / 16};
    const auto step = static_cast<std::size_t>(std::clamp(level, 0.0, 1.0) * steps_s.size());
    return steps_s[std::min(step, steps_s.size() - 1)];
}

}  // namespace seaglare::glare
