// The complex half of the transform, which the plan leaves out for an eye that is focused: with it and without it there is one
// picture, and without it the launches of a whole transform are not made. An eye out of focus needs both halves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "glare/plan/plan.h"
#include "glare/psf/pattern_sources.h"
#include "glare/tone/operators.h"
#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

using glare::Omission;
using glare::Omitted;

constexpr double adaptation_cd_m2 = 0.001;
// What the plan says that this omission costs, and single precision on top.
constexpr double bound_codes = 0;
constexpr double rounding_codes = 0.01;
// So little that no phase is 1e-6 of a turn, and yet not zero: the device computes both halves.
constexpr double hardly_out_of_focus_dioptre = 1e-9;

// An open eye at rest: all that its pattern depends on is the focus.
glare::EyeModel eye_with(double defocus_dioptre) {
    glare::EyeModel eye = glare::young_eye();
    eye.defocus_dioptre = defocus_dioptre;
    return eye;
}

class ComplexHalf : public ViewTest {
  protected:
    struct Drawn {
        std::vector<double> codes;  // of every channel of every pixel over a black picture, before rounding
        int launches = 0;           // that made the pattern
    };
    // Bright lights near each other, through the pattern of an eye.
    Drawn seen_by(const glare::EyeModel& eye) {
        Frame frame = make_frame(192, 120, 8);
        frame.adaptation_luminance_cd_m2 = adaptation_cd_m2;
        const double pitch = glare::screen_geometry(frame).pitch;
        glare::PatternSettings settings;
        settings.transform_size = 512;
        settings.plane_width_mm = 4.5;
        settings.wavelengths = 12;
        glare::PatternRequest request;
        request.pupil_mm = 3.5;
        request.pitch = pitch;
        const auto source = glare::make_cl_pattern_source(eye, settings, 5);
        const Pattern& pattern = source->make(request);
        std::vector<PointSource> lights;
        for (int i = 0; i < 6; ++i)
            lights.push_back(
                source_at_px(frame, 20.3 + 28.7 * i, 60.1 + 7.9 * (i % 3), std::pow(10.0, -3 - 0.4 * i)));
        Drawn drawn;
        drawn.launches = pattern.kernel_launches;
        const std::vector<float> hdr = hdr_of(frame, pattern, lights);
        const glare::ToneCurve curve = glare::tone_curve({}, adaptation_cd_m2);
        for (std::size_t i = 0; i < hdr.size(); ++i) {
            if (i % 4 == 3) continue;
            const double shown = glare::tone_map(curve, static_cast<double>(hdr[i]));
            drawn.codes.push_back(255 * glare::srgb_encode(std::clamp(shown, 0.0, 1.0)));
        }
        return drawn;
    }
    static double largest_difference(const Drawn& a, const Drawn& b) {
        EXPECT_EQ(a.codes.size(), b.codes.size());
        double largest = 0;
        for (std::size_t i = 0; i < a.codes.size(); ++i)
            largest = std::max(largest, std::abs(a.codes[i] - b.codes[i]));
        return largest;
    }
    void SetUp() override {
        ViewTest::SetUp();
        if (IsSkipped()) return;
        glare::PatternSettings small;
        small.transform_size = 256;
        try {
            glare::make_cl_pattern_source(glare::young_eye(), small, 1);
        } catch (const std::exception& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

TEST_F(ComplexHalf, OfAFocusedEyeChangesNoPixelAndIsNotComputed) {
    const Drawn without = seen_by(eye_with(0));
    const Drawn with = seen_by(eye_with(hardly_out_of_focus_dioptre));
    EXPECT_GT(*std::max_element(without.codes.begin(), without.codes.end()), 200)
        << "there is glare to compare";
    EXPECT_LE(largest_difference(without, with), bound_codes + rounding_codes);
    // A drawing of the aperture, a transform of one launch at least, and its sums.
    EXPECT_GE(with.launches, without.launches + 3);
}

TEST_F(ComplexHalf, OfAnEyeOutOfFocusIsSeen) {
    const Drawn focused = seen_by(eye_with(0));
    const Drawn blurred = seen_by(eye_with(0.5));
    EXPECT_GT(largest_difference(focused, blurred), 1) << "leaving it out would show";
    EXPECT_GE(blurred.launches, focused.launches + 3);
}

TEST(ComplexHalfPlan, LeavesItOutOfFocusedEyesAlone) {
    glare::PlanInput input;
    const Frame frame = make_frame(192, 120, 8);
    input.geometry = glare::screen_geometry(frame);
    const glare::PatternSettings settings;
    input.pattern = &settings;
    input.radius_nodes = 40;
    input.window_inner = 30 * input.geometry.pitch;
    input.window_outer = 40 * input.geometry.pitch;
    const std::vector<PointSource> lights = {source_at_px(frame, 90, 60, 1e-3)};
    glare::LightSummary summary;
    glare::summarise(input.geometry, lights, 40, summary);
    input.lights = &summary;
    for (const bool focused : {true, false}) {
        input.eye_focused = focused;
        const glare::Plan plan = glare::make_plan(input, {}, {});
        const auto all = plan.left_out.all();
        const auto found = std::find_if(all.begin(), all.end(),
                                        [](const Omission& o) { return o.what == Omitted::complex_half; });
        EXPECT_EQ(found != all.end(), focused);
        if (found != all.end()) {
            EXPECT_EQ(found->bound_codes, bound_codes);
        }
    }
}

}  // namespace
}  // namespace seaglare::test
