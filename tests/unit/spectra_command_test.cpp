// `seaglare-lights spectra`: named lamps and files, against published colours.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "glare/colour/named_spectra.h"
#include "lightdb/colreg_regions.h"
#include "lightdb/json/value.h"
#include "lightdb/tool/spectra_command.h"

namespace seaglare::lights_tool {
namespace {

struct Answer {
    int status;
    std::string out;
    std::string err;
};
Answer ask(const SpectraRequest& request) {
    std::ostringstream out;
    std::ostringstream err;
    const int status = list_spectra(request, out, err);
    return {status, out.str(), err.str()};
}

class SpectraFolder : public testing::Test {
  protected:
    SpectraFolder()
        : folder_(std::filesystem::path(testing::TempDir()) /
                  testing::UnitTest::GetInstance()->current_test_info()->name()) {
        std::filesystem::create_directories(folder_);
    }
    ~SpectraFolder() override { std::filesystem::remove_all(folder_); }
    std::string write(const char* name, const std::string& text) const {
        std::string path = (folder_ / name).string();
        std::ofstream(path) << text;
        return path;
    }
    std::filesystem::path folder_;
};

// CIE 015: D65 (0.3127, 0.3290), A (0.4476, 0.4074), E (1/3, 1/3). S/P of D65 and A: 2.47 and 1.41 (CIE 191:2010 has 1.41
// for incandescent lamps).
TEST(SpectraCommand, IlluminantsHaveTheirPublishedColours) {
    const Answer answer = ask({{"d65", "a", "e"}, "", true});
    ASSERT_EQ(answer.status, 0) << answer.err;
    const json::Document document = json::parse(answer.out, "out");
    const auto& lamps = document.root().array();
    ASSERT_EQ(lamps.size(), 3U);
    const auto expect = [&](std::size_t i, double x, double y) {
        EXPECT_NEAR(lamps[i].find("x")->number(), x, 5e-4) << i;
        EXPECT_NEAR(lamps[i].find("y")->number(), y, 5e-4) << i;
    };
    expect(0, 0.3127, 0.3290);
    expect(1, 0.4476, 0.4074);
    expect(2, 1.0 / 3, 1.0 / 3);
    EXPECT_NEAR(lamps[0].find("scotopic_per_photopic")->number(), 2.47, 0.02);
    EXPECT_NEAR(lamps[1].find("scotopic_per_photopic")->number(), 1.41, 0.01);
    EXPECT_EQ(lamps[0].find("colreg")->string(), "white");
    EXPECT_EQ(lamps[1].find("nearest")->string(), "tungsten");
}

TEST(SpectraCommand, WithoutNamesEveryLampAndEveryGlassIsListed) {
    const Answer answer = ask({{}, "", false});
    EXPECT_EQ(answer.status, 0) << answer.err;
    for (const auto name : glare::spectrum_names())
        EXPECT_NE(answer.out.find("\n" + std::string(name) + " "), std::string::npos) << name;
    for (const auto name : glare::filter_names())
        EXPECT_NE(answer.out.find("\na + " + std::string(name) + " "), std::string::npos) << name;
    std::size_t lines = 0;
    for (const char c : answer.out)
        lines += c == '\n' ? 1 : 0;
    EXPECT_EQ(lines, 1 + glare::spectrum_names().size() + glare::filter_names().size());
}

TEST(SpectraCommand, GlassesStandInTheirRegionsOfColreg) {
    for (const char* colour : {"red", "green", "yellow"}) {
        const Answer answer = ask({{"a"}, colour, true});
        const json::Document document = json::parse(answer.out, "out");
        const json::Value* const region = document.root().array()[0].find("colreg");
        ASSERT_NE(region, nullptr) << colour;
        EXPECT_EQ(region->string(), colour);
    }
}

// Corners belong to their regions, and so does a deep red on the spectral locus; equal energy is no signal's colour but
// white's.
TEST(ColregRegions, AreTheRules) {
    using lightdb::Colour;
    for (const Colour colour : {Colour::white, Colour::red, Colour::green, Colour::yellow}) {
        for (const glare::Chromaticity corner : lightdb::colreg_region(colour))
            EXPECT_TRUE(lightdb::inside_region(lightdb::colreg_region(colour), corner)) << corner.x;
    }
    EXPECT_TRUE(lightdb::inside_region(lightdb::colreg_region(Colour::red), {0.7006, 0.2993}));  // 630 nm
    EXPECT_TRUE(lightdb::inside_region(lightdb::colreg_region(Colour::red), {0.70, 0.29}));
    EXPECT_FALSE(lightdb::inside_region(lightdb::colreg_region(Colour::red), {0.65, 0.33}));
    EXPECT_TRUE(lightdb::inside_region(lightdb::colreg_region(Colour::white), {1.0 / 3, 1.0 / 3}));
    EXPECT_FALSE(lightdb::inside_region(lightdb::colreg_region(Colour::green), {1.0 / 3, 1.0 / 3}));
    // In the notch of the white region's upper edge.
    EXPECT_FALSE(lightdb::inside_region(lightdb::colreg_region(Colour::white), {0.40, 0.43}));
    EXPECT_TRUE(lightdb::colreg_region(Colour::blue).empty());
}

// A laser: its colour lies on the spectral locus, and all of its light at one place.
TEST_F(SpectraFolder, ATableIsWhatItsNumbersSay) {
    const std::string path = write("line.csv", "wavelength,power\n589,0\n590,1\n591,0\n");
    const Answer answer = ask({{path}, "", true});
    ASSERT_EQ(answer.status, 0) << answer.err;
    const json::Document document = json::parse(answer.out, "out");
    const json::Value& lamp = document.root().array()[0];
    EXPECT_NEAR(lamp.find("x")->number(), 0.5752, 2e-3);  // the observer at 590 nm
    EXPECT_NEAR(lamp.find("y")->number(), 0.4242, 2e-3);
    for (const json::Value& nm : lamp.find("flux_nm")->array())
        EXPECT_NEAR(nm.number(), 590, 1);
    EXPECT_EQ(lamp.find("nearest")->string(), "led_yellow");
}

TEST_F(SpectraFolder, WhatIsNoSpectrumIsSaidAndTheOthersAreListed) {
    const std::string torn = write("torn.csv", "500,1\n400,1\n");
    const Answer answer = ask({{"led_whit", torn, "led_white"}, "", false});
    EXPECT_EQ(answer.status, 1);
    EXPECT_NE(answer.err.find("did you mean 'led_white'"), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find(torn + ":2:"), std::string::npos) << answer.err;
    EXPECT_NE(answer.out.find("\nled_white "), std::string::npos) << answer.out;
    EXPECT_NE(ask({{(folder_ / "none.csv").string()}, "", false}).status, 0);
    const Answer glass = ask({{"a"}, "redd", false});
    EXPECT_EQ(glass.status, 1);
    EXPECT_NE(glass.err.find("did you mean 'red'"), std::string::npos) << glass.err;
}

}  // namespace
}  // namespace seaglare::lights_tool
