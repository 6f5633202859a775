// A budget of display codes is kept against the truth of its own pattern: all lights of a shipped scene summed at all pixels
// in double precision, with nothing left out, by code that the product does not share.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host_stub/report/frame_subject.h"
#include "tests/scene_host.h"

namespace seaglare::report {
namespace {

class Sum : public testing::TestWithParam<host::ShippedScene> {};

TEST_P(Sum, OfAllLightsIsMetWithinTheBudget) {
    std::string why_not;
    const std::unique_ptr<host::HeadlessContext> gl = host::headless_context(why_not);
    if (!gl) GTEST_SKIP() << why_not;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("seaglare_sum_" + std::to_string(getpid()));
    {
        FrameOptions options;
        options.out = folder;
        options.plugin = SEAGLARE_PLUGIN_FILE;
        options.size = GetParam().size;
        const host::Plugin plugin(options.plugin);
        Progress progress;
        FrameSubject subject(plugin, host::scene_options(GetParam().name, "").scene, options);
        const std::vector<reference::Rgbv> sum = subject.same_sum({}, progress);
        const std::vector<double> codes = subject.codes_of(sum);
        // With nothing left out only rounding is left: halves in the pattern.
        constexpr double of_rounding = 0.15;
        // host_budget_test has those in between, against the frame with nothing left out.
        for (const char* const budget : {"0", "0.5", "4"}) {
            const FrameRun run = subject.run({{"budget.max_error_codes", budget}}, 1, 1, true);
            const std::vector<reference::Rgbv> made = to_double(run.hdr);
            const FrameError error = compare_frames(subject, made, subject.codes_of(made), sum, codes);
            std::printf("%-24s budget %s: off by %.3f codes, energy %.5f\n", GetParam().name, budget,
                        error.max_codes, error.energy_ratio);
            const double allowed = std::stod(budget);
            EXPECT_LE(error.max_codes, allowed > 0 ? allowed : of_rounding);
            // What is left out is the glare's own outskirts, which hold little of its energy.
            EXPECT_NEAR(error.energy_ratio, 1, allowed > 0 ? 0.05 : 1e-3);
        }
    }
    std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(OfEveryShippedScene, Sum, testing::ValuesIn(host::shipped_scenes), host::name_of);

}  // namespace
}  // namespace seaglare::report
