#include "host_stub/report/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace seaglare::report {

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (terminal_ && width_ > 0) std::cerr << "\r" << std::string(width_, ' ') << "\r" << std::flush;
}

void Progress::show(const std::string& what, double fraction) {
    if (!terminal_) return;
    std::string line = what;
    if (fraction >= 0) {
        constexpr int cells = 30;
        const int done = static_cast<int>(std::lround(std::min(fraction, 1.0) * cells));
        line += " [" + std::string(static_cast<std::size_t>(done), '#') +
                std::string(static_cast<std::size_t>(cells - done), '.') + "] " +
                std::to_string(std::lround(100 * std::min(fraction, 1.0))) + " %";
    }
    const std::size_t before = width_;
    width_ = line.size();
    if (line.size() < before) line += std::string(before - line.size(), ' ');
    std::cerr << "\r" << line << std::flush;
}

}  // namespace seaglare::report
