// What the last pass of a frame is given: the host's picture and the sum of its lights.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace seaglare::benchmark {

// A frame of the stub host: its picture before, lower row first, as sRGB values; and the lights' sum.
struct Captured {
    int width_px = 0, height_px = 0;
    double adaptation_cd_m2 = 0;
    double ldr_white_cd_m2 = 0;
    std::vector<std::uint8_t> codes;  // RGBA
    std::vector<float> rgbv;
};

// Of the shipped scene of that name, 1280 x 720, as the stub host and the plug-in make it. Needs a GL context.
Captured capture(const std::string& name);

}  // namespace seaglare::benchmark
