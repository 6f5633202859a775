// Stiff and extreme cases: what is tried, what must hold, and how far from it the worst case was.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace seaglare::report {

// One line of the table: the largest error over all its cases and what it may be. A value that is not finite anywhere
// makes the error infinite, so it cannot pass.
struct Check {
    std::string what;   // the part, or the quantity
    std::string cases;  // what it was put through
    std::string holds;  // what must hold
    double worst = 0;
    double allowed = 0;
    int tried = 0;

    void see(double error) {
        ++tried;
        if (!(error <= worst)) worst = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
    }
    // What `value` lies outside low ... high.
    void see_within(double value, double low, double high) {
        see(std::isfinite(value) ? std::max({0.0, low - value, value - high})
                                 : std::numeric_limits<double>::infinity());
    }
    bool passed() const { return tried > 0 && worst <= allowed; }
};

// The steps, instants and adaptations that every moving part is put through.
inline const std::vector<double> steps_s = {0, 1e-9, 1.0 / 240, 1.0 / 60, 1, 10};
inline const std::vector<double> instants_s = {0, 1e-9, 1.0, 3600, 86400, 1e6, 1e7};
inline const std::vector<double> adaptations_cd_m2 = {0, 1e-6, 1e-3, 0.04, 1, 100, 1e4, 1e6};

std::vector<Check> moving_parts();   // of the eye, and rhythms
std::vector<Check> moving_lights();  // and what goes over from one state to another
std::vector<Check> extremes();
std::vector<Check> scene_extremes(int most_lights = 1000000);

}  // namespace seaglare::report
