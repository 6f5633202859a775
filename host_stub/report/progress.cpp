#include "host_stub/report/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace seaglare::report {

namespace {

constexpr double line_every_s = 60;  // where nobody watches

std::string bar_of(double fraction) {
    constexpr int cells = 30;
    const int done = static_cast<int>(std::lround(fraction * cells));
    return " [" + std::string(static_cast<std::size_t>(done), '#') +
           std::string(static_cast<std::size_t>(cells - done), '.') + "] " +
           std::to_string(std::lround(100 * fraction)) + " %";
}

}  // namespace

std::string time_left(double elapsed_s, double whole_fraction) {
    constexpr double least_s = 3;
    constexpr double least_fraction = 0.02;
    if (elapsed_s < least_s || whole_fraction < least_fraction) return "";
    const double left_s = elapsed_s * (1 - whole_fraction) / whole_fraction;
    if (left_s < 90) return ", about " + std::to_string(std::lround(left_s / 10) * 10) + " s left";
    return ", about " + std::to_string(std::lround(left_s / 60)) + " min left";
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (terminal_ && width_ > 0) std::cerr << "\r" << std::string(width_, ' ') << "\r" << std::flush;
}

void Progress::part(double from, double to) {
    from_ = from;
    to_ = to;
    furthest_ = std::max(furthest_, from);
}

void Progress::show(const std::string& what, double fraction) {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> since = now - last_line_;
    if (!terminal_ && since.count() < line_every_s) return;
    last_line_ = now;
    std::string line = what;
    const double within = std::clamp(fraction, 0.0, 1.0);
    if (to_ > from_) {
        furthest_ = std::max(furthest_, from_ + (to_ - from_) * within);
        line += bar_of(furthest_) + time_left(std::chrono::duration<double>(now - begun_).count(), furthest_);
    } else if (fraction >= 0) {
        line += bar_of(within);
    }
    if (!terminal_) {
        std::cerr << line << "\n";
        return;
    }
    const std::size_t before = width_;
    width_ = line.size();
    if (line.size() < before) line += std::string(before - line.size(), ' ');
    std::cerr << "\r" << line << std::flush;
}

}  // namespace seaglare::report
