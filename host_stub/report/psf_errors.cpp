#include "host_stub/report/psf_errors.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iostream>

namespace seaglare::report {

namespace {

using Clock = std::chrono::steady_clock;

double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// As OpenCL's drivers for processors, and the plain source, call themselves.
bool is_processor(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name.find("cpu") != std::string::npos || name.find("pthread") != std::string::npos ||
           name.find("processor") != std::string::npos;
}

class Stopwatch {
  public:
    explicit Stopwatch(const glare::PatternSource& source)
        : by_processor_(is_processor(source.device_name())) {}
    Cost read() const {
        const double wall = std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
        return {wall, by_processor_ ? processor_ms() - spent_ : wall};
    }

  private:
    bool by_processor_;
    Clock::time_point start_ = Clock::now();
    double spent_ = processor_ms();
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::unique_ptr<glare::PatternSource> source_of(const Subject& subject) {
    try {
        return glare::make_cl_pattern_source(subject.eye, subject.settings, subject.seed);
    } catch (const std::runtime_error& error) {
        static bool said = false;
        if (!said) std::cerr << "seaglare-report: " << error.what() << "; the plain source instead\n";
        said = true;
        return glare::make_cpu_pattern_source(subject.eye, subject.settings, subject.seed);
    }
}

glare::PatternRequest request_of(const Subject& subject) {
    glare::PatternRequest request;
    request.pupil_mm = subject.pupil_mm;
    request.time_s = subject.time_s;
    request.pitch = subject.pitch;
    request.largest_disc_nodes = 1000;
    return request;
}

Subject limited(Subject subject) {
    float largest = 0;
    for (const float radius : subject.settings.layer_radii_px)
        largest = std::max(largest, radius);
    const int margin = static_cast<int>(std::ceil(largest)) + 1;
    subject.settings.max_radius_nodes = std::min(subject.settings.max_radius_nodes, subject.radius + margin);
    return subject;
}

reference::ReferenceRequest reference_request(const Subject& subject) {
    reference::ReferenceRequest request;
    request.eye = subject.eye;
    request.pupil_mm = subject.pupil_mm;
    request.time_s = subject.time_s;
    request.seed = subject.seed;
    request.pitch = subject.pitch;
    request.radius = subject.radius;
    request.angular_scale = subject.settings.angular_scale;
    return request;
}

float to_half(float value) {
    const auto magnitude = static_cast<double>(std::abs(value));
    if (magnitude > 65519) return std::copysign(65504.0F, value);
    const int exponent = std::max(magnitude > 0 ? std::ilogb(magnitude) : -14, -14);
    const double step = std::ldexp(1.0, exponent - 10);
    return std::copysign(static_cast<float>(std::nearbyint(magnitude / step) * step), value);
}

Cost cost_of(glare::PatternSource& source, const glare::PatternRequest& request) {
    std::vector<double> wall;
    std::vector<double> work;
    for (int run = 0; run < 6; ++run) {
        glare::PatternRequest r = request;
        r.pupil_mm *= 1 + 1e-6 * (run + 1);
        const Stopwatch watch(source);
        source.make(r);
        if (run == 0) continue;
        const Cost cost = watch.read();
        wall.push_back(cost.wall_ms);
        work.push_back(cost.work_ms);
    }
    return {median(wall), median(work)};
}

Cost cost_of_frames(glare::PatternSource& source, glare::PatternRequest request, double from_s, int frames) {
    request.time_s = from_s;
    request.resting_pupil_mm = request.pupil_mm;
    source.make(request);
    const Stopwatch watch(source);
    for (int frame = 1; frame <= frames; ++frame) {
        request.time_s = from_s + frame / 60.0;
        request.pupil_mm = request.resting_pupil_mm * (1 + 1e-6 * frame);
        source.make(request);
    }
    const Cost all = watch.read();
    return {all.wall_ms / frames, all.work_ms / frames};
}

Table error_table(std::vector<std::string> first) {
    first.insert(first.end(),
                 {"L1", "skirt L1", "total L1", "worst/peak", "worst/pixel", "core delta E", "ring delta E",
                  "core energy error", "structure scale", "ms", "x FFTW 512", "ms by the clock"});
    return Table(std::move(first));
}

void add_error(Table::Row& row, const reference::PatternError& e) {
    row << e.relative_l1 << e.skirt_l1 << e.total_l1 << e.worst_of_peak << e.worst_relative << e.core_delta_e
        << e.ring_delta_e << e.core_energy << e.structure_scale;
}

void add_error(Table::Row& row, const reference::PatternError& e, const Cost& cost, double unit_ms) {
    add_error(row, e);
    row << cost.work_ms << cost.work_ms / unit_ms << cost.wall_ms;
}

}  // namespace seaglare::report
