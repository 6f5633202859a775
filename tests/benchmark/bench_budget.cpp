// What budgets buy, as CSV: every shipped scene at error budgets of 0.5, 1, 2 and 4 codes, and under time budgets of 4, 8, 16
// and 33 ms, which the clock of this machine decides about. Errors are against the same instant with nothing left out.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "tests/accuracy/scene_picture.h"

namespace seaglare::host {
namespace {

constexpr const char* size = "1280x720";
constexpr double interval_s = 0.1;  // as a slow machine has it
constexpr int frames = 70;          // a time budget has come to rest after four seconds
constexpr int counted = 15;         // of which these are the last

double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// One frame counts as drawn when its pixels have been read, so that the processor time of a software rasteriser is in it.
double frame_ms(ScenePicture& picture, Glare& glare, std::uint32_t flags) {
    const double begin_ms = processor_ms();
    static_cast<void>(picture.draw(glare, flags, interval_s));
    return processor_ms() - begin_ms;
}

constexpr std::array<const char*, 8> pass_names = {"",       "evaluate",  "visibility", "pattern",
                                                   "upload", "occlusion", "accumulate", "composite"};

std::string given_up(const seaglare_stats& stats) {
    constexpr std::array<const char*, 4> names = {"error budget", "motion", "discs", "own patterns"};
    std::string list;
    for (std::size_t k = 0; k < names.size(); ++k) {
        if ((stats.given_up >> k & 1U) == 0) continue;
        if (!list.empty()) list += " + ";
        list += names.at(k);
    }
    return list;
}

void print(const std::string& scene, const std::string& budget, const Shown& shown, double error, double ms,
           double taken_ms) {
    std::printf("%s,%s,%.3f,%.3f,%.3f,%.2f,%.1f,%.1f,%.1f,%s,%s\n", scene.c_str(), budget.c_str(), error,
                shown.stats.error_bound_codes, shown.stats.max_error_codes, shown.stats.quality_loss, ms,
                taken_ms, shown.stats.predicted_ms, given_up(shown.stats).c_str(),
                pass_names.at(shown.stats.limiting_pass));
    std::fflush(stdout);
}

void measure(const std::string& scene) {
    ScenePicture picture(scene, size);
    const Shown everything = picture.at_budget(0);
    for (const double codes : {0.5, 1.0, 2.0, 4.0}) {
        const std::unique_ptr<Glare> glare = picture.attached(codes);
        std::vector<double> ms;
        Shown shown = picture.draw(*glare, SEAGLARE_FRAME_WAIT);
        for (int i = 0; i < 7; ++i)
            ms.push_back(frame_ms(picture, *glare, SEAGLARE_FRAME_WAIT));
        print(scene, std::to_string(codes) + " codes", shown, largest_difference_codes(everything, shown),
              median(ms), shown.stats.render_ms);
    }
    for (const double time_ms : {4.0, 8.0, 16.0, 33.0}) {
        const std::unique_ptr<Glare> glare = picture.attached(0.5, "", time_ms);
        std::vector<double> ms, taken_ms;
        for (int i = 0; i < frames; ++i) {
            ms.push_back(frame_ms(picture, *glare, 0));
            taken_ms.push_back(glare->stats().taken_ms);
        }
        ms.erase(ms.begin(), ms.end() - counted);
        taken_ms.erase(taken_ms.begin(), taken_ms.end() - counted);
        const seaglare_stats last = glare->stats();
        // The same quality once more, of the instant that `everything` is of.
        Shown shown = picture.draw(*glare, SEAGLARE_FRAME_WAIT);
        shown.stats = last;
        print(scene, std::to_string(time_ms) + " ms", shown, largest_difference_codes(everything, shown),
              median(ms), median(taken_ms));
    }
}

}  // namespace
}  // namespace seaglare::host

int main(int argc, char** argv) {
    using namespace seaglare::host;
    try {
        const HeadlessContext gl;
        std::printf(
            "scene,budget,error_codes,bound_codes,allowed_codes,quality_loss,processor_ms_with_reading,"
            "taken_ms,predicted_ms,given_up,cannot_be_kept_for\n");
        std::vector<std::string> scenes(argv + 1, argv + argc);
        if (scenes.empty()) {
            scenes = {"great_belt_night", "ships_at_night", "sonderborg_leading_line", "storebaelt_dusk",
                      "thesis_many_lights"};
        }
        for (const std::string& scene : scenes)
            measure(scene);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_budget: %s\n", error.what());
        return 1;
    }
    return 0;
}
