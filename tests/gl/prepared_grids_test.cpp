// Lights on grids in GL, of a pattern whose profile and departures somebody has prepared: the picture is the same, and who
// draws makes nothing of its own.
#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "glare/tone/operators.h"
#include "tests/gl/view_fixture.h"

namespace seaglare::test {

namespace {

constexpr double adaptation_cd_m2 = 0.001;

class PreparedGrids : public ViewTest {
  protected:
    // Of enough lights that grids cost less than rectangles.
    std::vector<float> crowd(ViewRenderer& renderer, const Pattern& pattern,
                             const glare::PreparedPattern* prepared) {
        Frame frame = make_frame(320, 200);
        const Target target(gl(), 320, 200);
        target.fill({0, 0, 0, 255});
        frame.target_fbo = target.fbo();
        frame.adaptation_luminance_cd_m2 = adaptation_cd_m2;
        glare::AccumulationPlan plan;
        plan.skirt_threshold_cd_m2 = glare::threshold_luminance_cd_m2({}, adaptation_cd_m2, 0.25);
        plan.tail_threshold_cd_m2 = plan.skirt_threshold_cd_m2 / 64;
        std::mt19937_64 random(7);
        std::uniform_real_distribution<double> uniform(0, 1);
        std::vector<PointSource> sources;
        for (int i = 0; i < 60; ++i) {
            const double x = 320 * uniform(random);
            const double y = 200 * uniform(random);
            sources.push_back(source_at_px(frame, x, y, 1e-4 + 1e-3 * uniform(random)));
        }
        renderer.set_prepared(prepared);
        stats_ = {};
        renderer.render(frame, {}, pattern, sources, plan, stats_);
        EXPECT_TRUE(renderer.use_of_patterns(plan).grids);
        std::vector<float> rgba(std::size_t{320} * 200 * 4);
        renderer.read_hdr(rgba);
        renderer.set_prepared(nullptr);
        return rgba;
    }
    // Needles, so that there are departures.
    Pattern pattern() const {
        SyntheticPattern settings;
        settings.with_tail = true;
        settings.layers = {0.0F, 2.0F};
        Pattern made = make_pattern(glare::screen_geometry(make_frame(320, 200)).pitch, settings);
        for (std::size_t i = 0; i < made.skirt.size(); ++i)
            made.skirt[i] *= i / 4 % 5 == 0 ? 1.2F : 0.95F;
        return made;
    }
    static void prepare(const Pattern& pattern, glare::PreparedPattern& prepared) {
        glare::PatternUses uses;
        uses.add({.draws = true, .grids = true, .gather = nullptr});
        glare::PatternPreparer().prepare(pattern, uses, prepared);
    }
};

TEST_F(PreparedGrids, GiveThePictureOfAPatternThatComesWithoutToTheBit) {
    glare::PreparedPattern prepared;
    for (int i = 0; i < 3; ++i) {
        const Pattern shown = pattern();
        prepare(shown, prepared);
        ViewRenderer without(gl());
        EXPECT_EQ(crowd(*renderer_, shown, &prepared), crowd(without, shown, nullptr)) << "pattern " << i;
    }
}

TEST_F(PreparedGrids, AreReadAndNotMadeOnceMore) {
    const Pattern shown = pattern();
    glare::PreparedPattern prepared;
    prepare(shown, prepared);
    ViewRenderer other(gl());
    const std::vector<float> as_is = crowd(other, shown, &prepared);
    std::fill(prepared.grid_texels.departures.begin(), prepared.grid_texels.departures.end(), glare::Half{0});
    EXPECT_NE(crowd(*renderer_, shown, &prepared), as_is);
}

TEST_F(PreparedGrids, MayBeMissingForAFrameOrBeOfAnotherPattern) {
    const Pattern shown = pattern();
    const Pattern next = pattern();
    glare::PreparedPattern prepared;
    prepare(shown, prepared);
    const std::vector<float> first = crowd(*renderer_, shown, &prepared);
    EXPECT_EQ(crowd(*renderer_, shown, nullptr), first);
    EXPECT_EQ(crowd(*renderer_, shown, &prepared), first);
    ViewRenderer other(gl());
    EXPECT_EQ(crowd(*renderer_, next, &prepared), crowd(other, next, nullptr));
    EXPECT_EQ(crowd(*renderer_, shown, &prepared), first);
}

TEST_F(PreparedGrids, AreMadeForThoseThatUseThemOnly) {
    const Pattern shown = pattern();
    glare::PreparedPattern prepared;
    prepare(shown, prepared);
    ASSERT_NE(prepared.grid_texels_of(shown), nullptr);
    EXPECT_EQ(prepared.grid_texels_of(pattern()), nullptr);
    glare::PatternUses rectangles;
    rectangles.add({.draws = true, .gather = nullptr});
    glare::PatternPreparer().prepare(shown, rectangles, prepared);
    EXPECT_EQ(prepared.grid_texels_of(shown), nullptr);
    EXPECT_NE(prepared.texels_of(shown), nullptr);
}

}  // namespace

}  // namespace seaglare::test
