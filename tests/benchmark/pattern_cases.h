// The patterns that bench_pattern measures.
#pragma once

#include <string>
#include <vector>

#include "glare/psf/pattern.h"

namespace seaglare::benchmark_pattern {

struct Case {
    std::string name;
    glare::PatternSettings settings;
    glare::PatternSettings exact;  // what it is compared with: 480 wavelengths, each in its own colour
    glare::EyeModel eye;
    double largest_disc = 0;
    double pitch = 1 / 869.1;  // 45 degrees over 720 lines
    bool moving = false;
    bool stages = false;  // told apart in the second table
};
std::vector<Case> pattern_cases();

glare::PatternRequest request_at(const Case& c, int frame);

}  // namespace seaglare::benchmark_pattern
