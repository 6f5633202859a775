// What a loss of glare may cost in display codes: a bound of what the display shows of it.
#include "glare/apply/code_slopes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace seaglare::test {
namespace {

using namespace glare;

constexpr double adaptation_cd_m2 = 0.001;
using Rgbv = std::array<double, 4>;

CodeBudget one_code() {
    CodeBudget budget;
    budget.codes = 1;
    budget.curve = tone_curve({}, adaptation_cd_m2);
    return budget;
}

// Largest change of a channel of a pixel, in codes, before a host pixel of some linear value.
double shown_codes(const Rgb& background, const Rgbv& glare, const Rgbv& loss) {
    const auto pixel = [&](double times) {
        Rgb shown = display_delta(
            {}, adaptation_cd_m2, 0, background,
            {glare[0] - times * loss[0], glare[1] - times * loss[1], glare[2] - times * loss[2]},
            glare[3] - times * loss[3]);
        for (std::size_t c = 0; c < 3; ++c)
            shown[c] = 255 * srgb_encode(background[c] + shown[c]);
        return shown;
    };
    const Rgb before = pixel(0);
    const Rgb after = pixel(1);
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, std::abs(after[c] - before[c]));
    return most;
}

struct Case {
    Rgbv glare{};
    Rgbv loss{};
    Rgb background{};
    double bound = 0;
};

// Glare of any colour inside the gamut; of each channel up to a hundredth is lost or added.
class Cases {
  public:
    Case next(const CodeBudget& budget, bool with_background) {
        Case made;
        const double luminance = std::pow(10.0, -5 + 6 * uniform_(random_));
        Rgbv least{};
        for (std::size_t c = 0; c < 4; ++c) {
            least[c] = luminance * (0.1 + uniform_(random_)) * (c == 3 ? d65_scotopic_ratio : 1);
            made.loss[c] = 0.01 * luminance * (2 * uniform_(random_) - 1);
        }
        // As bright as the least, or brighter.
        const double times = uniform_(random_) < 0.5 ? 1.01 : std::pow(10.0, 2 * uniform_(random_));
        for (std::size_t c = 0; c < 4; ++c)
            made.glare[c] = times * least[c];
        if (with_background) {
            const double grey = std::pow(10.0, -3 + 3 * uniform_(random_));
            for (double& channel : made.background)
                channel = grey * (0.25 + 0.75 * uniform_(random_));
        }
        std::array<float, 4> size{};
        for (std::size_t c = 0; c < 4; ++c)
            size[c] = static_cast<float>(std::abs(made.loss[c]));
        made.bound = static_cast<double>(code_slopes(budget, 0, least).part_of(size));
        return made;
    }

  private:
    std::mt19937_64 random_{20};
    std::uniform_real_distribution<double> uniform_{0, 1};
};

}  // namespace

TEST(CodeSlopes, BoundWhatALossShowsBeforeADarkSky) {
    Cases cases;
    double closest = 0;
    for (int i = 0; i < 20000; ++i) {
        const Case one = cases.next(one_code(), false);
        const double shown = shown_codes({}, one.glare, one.loss);
        EXPECT_LE(shown, 1.03 * one.bound) << "luminance " << one.glare[1];
        closest = std::max(closest, shown / one.bound);
    }
    EXPECT_GT(closest, 0.7) << "a bound that is never nearly reached leaves out too little";
}

TEST(CodeSlopes, BoundWhatALossShowsBeforeAnyBackgroundThatIsNotOfOnePureColour) {
    Cases cases;
    for (int i = 0; i < 20000; ++i) {
        const Case one = cases.next(one_code(), true);
        EXPECT_LE(shown_codes(one.background, one.glare, one.loss), 1.03 * one.bound)
            << one.background[0] << ", " << one.background[1] << ", " << one.background[2];
    }
}

TEST(CodeSlopes, RedLossesShowLittleWhereRodsSeeAndMuchWhereConesDo) {
    const auto of_red = [](double luminance) {
        const CodeSlopes slopes =
            code_slopes(one_code(), 0, {luminance, luminance, luminance, d65_scotopic_ratio * luminance});
        return slopes.part_of({1, 0, 0, 0}) / slopes.part_of({1, 1, 1, 2.464F});
    };
    EXPECT_LT(of_red(1e-3), 0.8F * of_red(0.1));
}

TEST(CodeSlopes, TwiceTheBudgetCostsHalf) {
    CodeBudget twice = one_code();
    twice.codes = 2;
    const Rgbv least = {0.01, 0.02, 0.03, 0.04};
    const std::array<float, 4> loss = {0.1F, 0.2F, 0.3F, 0.4F};
    EXPECT_NEAR(code_slopes(twice, 0, least).part_of(loss),
                0.5F * code_slopes(one_code(), 0, least).part_of(loss), 1e-3F);
}

TEST(CodeSlopes, WithoutCodesEveryChannelMayLoseWhatIsSaid) {
    CodeBudget none;
    const CodeSlopes slopes = code_slopes(none, 0.25, {1, 1, 1, 1});
    EXPECT_FLOAT_EQ(slopes.part_of({0.25F, 0, 0, 0}), 1);
    EXPECT_FLOAT_EQ(slopes.part_of({0, 0, 0.125F, 0}), 0.5F);
}

}  // namespace seaglare::test
