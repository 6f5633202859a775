// Two frames of glare, pixel by pixel: in HDR and in the codes of the display.
#include <algorithm>
#include <cmath>
#include <thread>

#include "host_stub/report/frame_subject.h"

namespace seaglare::report {

namespace {

constexpr double touched_codes = 0.1;

double photopic_of(const reference::Rgbv& value) {
    return 0.2126 * value[0] + 0.7152 * value[1] + 0.0722 * value[2];
}

}  // namespace

std::vector<reference::Rgbv> to_double(const std::vector<float>& hdr) {
    std::vector<reference::Rgbv> pixels(hdr.size() / 4);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            pixels[i][c] = static_cast<double>(hdr[4 * i + c]);
    return pixels;
}

std::vector<double> FrameSubject::codes_of(const std::vector<reference::Rgbv>& glare) const {
    const reference::DisplayState shown = display();
    const std::vector<std::uint8_t>& host = before();
    const auto width = static_cast<std::size_t>(width_px());
    const auto height = static_cast<std::size_t>(height_px());
    std::vector<double> codes(3 * width * height);
    const auto rows = [&](std::size_t from, std::size_t to) {
        for (std::size_t y = from; y < to; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t at = 4 * ((height - 1 - y) * width + x);
                const auto result =
                    reference::shown_codes(shown,
                                           {static_cast<double>(host[at]), static_cast<double>(host[at + 1]),
                                            static_cast<double>(host[at + 2])},
                                           glare[y * width + x]);
                std::copy(result.begin(), result.end(),
                          codes.begin() + static_cast<std::ptrdiff_t>(3 * (y * width + x)));
            }
        }
    };
    std::thread upper([&] { rows(height / 2, height); });
    rows(0, height / 2);
    upper.join();
    return codes;
}

std::vector<std::uint8_t> FrameSubject::picture_of(const std::vector<reference::Rgbv>& glare) const {
    const std::vector<double> codes = codes_of(glare);
    const auto width = static_cast<std::size_t>(width_px());
    const auto height = static_cast<std::size_t>(height_px());
    std::vector<std::uint8_t> rgba(4 * width * height, 255);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                rgba[4 * ((height - 1 - y) * width + x) + c] = static_cast<std::uint8_t>(
                    std::lround(std::clamp(codes[3 * (y * width + x) + c], 0.0, 255.0)));
    return rgba;
}

FrameError compare_frames(const FrameSubject& subject, const std::vector<reference::Rgbv>& made,
                          const std::vector<double>& made_codes, const std::vector<reference::Rgbv>& expected,
                          const std::vector<double>& codes, int row_step) {
    FrameError error;
    double apart = 0;
    double whole = 0;
    double energy_made = 0;
    double energy_expected = 0;
    const auto width = static_cast<std::size_t>(subject.width_px());
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (!reference::is_drawn(i / width, row_step)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            apart += std::pow(made[i][c] - expected[i][c], 2);
            whole += std::pow(expected[i][c], 2);
        }
        const std::size_t row = i / width;
        const double sr =
            subject.screen().pixel_sr(static_cast<double>(i % width) + 0.5, static_cast<double>(row) + 0.5);
        energy_made += photopic_of(made[i]) * sr;
        energy_expected += photopic_of(expected[i]) * sr;
    }
    error.relative_l2 = std::sqrt(apart / whole);
    error.energy_ratio = energy_made / energy_expected;

    const std::vector<double> nothing = subject.codes_of(std::vector<reference::Rgbv>(made.size()));
    std::vector<double> differences;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (!reference::is_drawn(i / 3 / width, row_step)) continue;
        const double difference = std::abs(made_codes[i] - codes[i]);
        error.max_codes = std::max(error.max_codes, difference);
        if (std::max(made_codes[i], codes[i]) - nothing[i] > touched_codes) differences.push_back(difference);
    }
    if (differences.empty()) return error;
    for (const double difference : differences)
        error.mean_codes += difference / static_cast<double>(differences.size());
    const auto p99 = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
    std::nth_element(differences.begin(), p99, differences.end());
    error.p99_codes = *p99;
    return error;
}

PictureError compare_pictures(const std::vector<std::uint8_t>& made,
                              const std::vector<std::uint8_t>& expected) {
    PictureError error;
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (i % 4 == 3) continue;
        const int difference = std::abs(static_cast<int>(made[i]) - static_cast<int>(expected[i]));
        error.max_codes = std::max(error.max_codes, difference);
        error.mean_codes += difference / (0.75 * static_cast<double>(made.size()));
    }
    return error;
}

}  // namespace seaglare::report
