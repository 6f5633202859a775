// Spectra in files: CSV, IES TM-27-14, and what a light's "spectrum" may say.
#include "lightdb/spectrum_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "glare/colour/named_spectra.h"
#include "lightdb/evaluate.h"
#include "lightdb/lamp_choice.h"
#include "lightdb/light_file.h"
#include "lightdb/light_store.h"

namespace seaglare::lightdb {
namespace {

namespace fs = std::filesystem;

std::string message_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "nothing was thrown";
}
std::string csv_error(const std::string& text) {
    return message_of([&] { parse_spectrum_csv(text, "lamp.csv"); });
}
std::string spdx_error(const std::string& text) {
    return message_of([&] { parse_spectrum_spdx(text, "lamp.spdx"); });
}
std::string spdx(const std::string& rows, const std::string& quantity = "relative") {
    return "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"http://www.ies.org/iestm2714\" "
           "version=\"1.0\"><Header>"
           "<Description>A &amp; B</Description></Header>\n<SpectralDistribution><SpectralQuantity>" +
           quantity + "</SpectralQuantity>\n" + rows + "</SpectralDistribution></IESTM2714>";
}
SpectrumTable uneven() {
    SpectrumTable table;
    for (int i = 0; i < 50; ++i) {
        table.wavelength_nm.push_back(380 + 8.1 * i + 0.3 * std::sin(i));
        table.value.push_back(i % 7 == 0 ? 0 : 1e-3 * std::exp(0.3 * i) / 3);
    }
    table.quantity = SpectralQuantity::power;
    table.description = "three <bands> & more";
    return table;
}

TEST(SpectrumCsv, ReadsRowsCommentsAndOneHeader) {
    const SpectrumTable table = parse_spectrum_csv(
        "\xEF\xBB\xBF# measured\r\nwavelength_nm, power\r\n\r\n 400 , 0\r\n500;1.5\n600\t+2e-1", "x");
    EXPECT_EQ(table.wavelength_nm, (std::vector<double>{400, 500, 600}));
    EXPECT_EQ(table.value, (std::vector<double>{0, 1.5, 0.2}));
}

TEST(SpectrumCsv, ComesBackToTheLastBit) {
    const SpectrumTable table = uneven();
    const SpectrumTable back = parse_spectrum_csv(format_spectrum_csv(table), "x");
    EXPECT_EQ(back.wavelength_nm, table.wavelength_nm);
    EXPECT_EQ(back.value, table.value);
}

TEST(SpectrumSpdx, ComesBackToTheLastBit) {
    EXPECT_EQ(parse_spectrum_spdx(format_spectrum_spdx(uneven()), "x"), uneven());
}

TEST(SpectrumCsv, SaysWhereAndWhatIsWrong) {
    EXPECT_EQ(csv_error("400,1\n500,x\n"), "lamp.csv:2:5: 'x' is not a number");
    EXPECT_EQ(csv_error("nm,power\nfoo,1\n"), "lamp.csv:2:1: 'foo' is not a number of nanometres");
    EXPECT_EQ(csv_error("400,1\n 390,1\n"),
              "lamp.csv:2:2: wavelength 390 nm comes after 400 nm: they must ascend");
    EXPECT_EQ(csv_error("400,1\n400,1\n"), "lamp.csv:2:1: wavelength 400 nm stands twice");
    EXPECT_EQ(csv_error("400,-1\n"), "lamp.csv:1:5: a spectrum has no negative values, but here is -1");
    EXPECT_EQ(
        csv_error("0.4,1\n"),
        "lamp.csv:1:1: wavelength 0.4 is less than 100 nm: is it in micrometres? Nanometres are needed");
    EXPECT_EQ(csv_error("400,1,2\n"),
              "lamp.csv:1:6: a third column: a row is a wavelength in nm and one power");
    EXPECT_EQ(csv_error("400\n"),
              "lamp.csv:1:4: a value is missing: a row is a wavelength in nm, a comma and a power");
    EXPECT_EQ(csv_error("400,0\n500,0\n"), "lamp.csv:3:1: the spectrum is 0 everywhere");
    EXPECT_EQ(csv_error(""), "lamp.csv:1:1: a spectrum needs two wavelengths, and here is 0");
    EXPECT_EQ(csv_error("400,nan\n"), "lamp.csv:1:5: 'nan' is not a number");
}

TEST(SpectrumSpdx, SaysWhereAndWhatIsWrong) {
    EXPECT_EQ(spdx_error("<a/>"),
              "lamp.spdx:1:1: the root is <a>, not <IESTM2714>: this is no IES TM-27-14 file");
    EXPECT_EQ(spdx_error(spdx("<SpectralData>1</SpectralData>")),
              "lamp.spdx:4:1: SpectralData has no attribute 'wavelength'");
    EXPECT_EQ(spdx_error(spdx("<SpectralData wavelength=\"400\">one</SpectralData>")),
              "lamp.spdx:4:1: the value of SpectralData is not a number");
    EXPECT_NE(spdx_error(spdx("", "reflectance")).find("neither what a lamp sends out"), std::string::npos);
    EXPECT_NE(spdx_error("<IESTM2714>").find("not well-formed XML: no element found"), std::string::npos);
    EXPECT_NE(spdx_error(std::string(64, '<')).find("lamp.spdx:1:"), std::string::npos);
}

TEST(SpectrumSpdx, RefusesEntitiesAndFilesThatAreTooLarge) {
    const std::string bomb =
        "<!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n<IESTM2714/>";
    EXPECT_EQ(spdx_error(bomb), "lamp.spdx:1:13: a spectrum file has no DOCTYPE");
    EXPECT_EQ(spdx_error("<!DOCTYPE x SYSTEM \"file:///etc/passwd\"><x/>"),
              "lamp.spdx:1:40: a spectrum file has no DOCTYPE");
    EXPECT_NE(spdx_error(std::string(largest_spectrum_file_bytes + 1, ' ')).find("too large"),
              std::string::npos);
    std::string deep;
    for (int i = 0; i < 100; ++i)
        deep += "<a>";
    EXPECT_NE(spdx_error(spdx(deep)).find("too deep"), std::string::npos);
}

// A folder for files, gone with the test.
class LampFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("seaglare_lamps_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    LightFile lights(const std::string& spectrum, const std::string& rest) const {
        return parse_light_file(R"({"lights": [{"name": "x", "position": [0, 0, 5], "spectrum": )" +
                                    spectrum + ", " + rest + "}]}",
                                path("lights.json"));
    }
    fs::path folder_;
};
const std::string white = R"("character": "F W", "intensity_cd": 100)";
const std::string green = R"("character": "F G", "intensity_cd": 100)";
const std::string sectors =
    R"("character": "F WR", "intensity_cd": 100, "sectors": [{"colour": "W", "from": 0, "to": 180}, {"colour": "R", "from": 180, "to": 0}])";

TEST_F(LampFiles, ATableOfABuiltInLampIsThatLamp) {
    SpectrumTable table;
    for (int l = 380; l <= 780; ++l) {
        table.wavelength_nm.push_back(l);
        table.value.push_back(glare::gaussian(l, 525, 17));
    }
    write("a.csv", format_spectrum_csv(table));
    write("a.spdx", format_spectrum_spdx(table));
    write("a.json", R"({"gaussians": [{"peak_nm": 525, "sigma_nm": 17}]})");
    LampShelf shelf;
    const SharedLamp exact = shelf.lamp({path("a.json"), ""});
    for (const char* name : {"a.csv", "a.spdx"}) {
        const SharedLamp lamp = shelf.lamp({path(name), ""});
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(lamp->colour().rgb[c], exact->colour().rgb[c], 2e-3F) << name;
        EXPECT_LT(glare::spectral_distance_nm(*lamp, *exact), 0.01) << name;
    }
}

TEST_F(LampFiles, ALightTakesItsColourFromItsSpectrumWithItsSign) {
    const LightFile file = lights("\"led_green\"", green);
    LightStore store;
    for (const Light& light : file.lights)
        store.add(light);
    Observer observer;
    observer.eye_m = {0, -1000, 5};
    observer.view_from_scene = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    Evaluated out;
    evaluate(store, observer, out);
    ASSERT_EQ(out.sources.size(), 1U);
    const auto& rgb = out.sources[0].illuminance_rgb_lx;
    const double y = 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                     0.0722 * static_cast<double>(rgb[2]);
    EXPECT_LT(rgb[0] / y, -0.8);
    EXPECT_GT(rgb[1] / y, 1.5);
    EXPECT_NEAR(static_cast<double>(out.sources[0].illuminance_scotopic_lx) / y, 2.77, 0.02);
    EXPECT_EQ(out.sources[0].lamp, 2U) << "it is the navigation lamp's own spectrum: no second pattern";
}

TEST_F(LampFiles, OneLampOfASectorLightStandsBehindTheGlassOfEachColour) {
    const Light light = lights("\"a\"", sectors).lights.at(0);
    LampShelf shelf;
    EXPECT_EQ(*light.spectrum->lamp[0], *shelf.lamp({"a", ""}));
    EXPECT_EQ(*light.spectrum->lamp[1], *shelf.lamp({"a", "red"}));
    EXPECT_EQ(light.spectrum->lamp[2], nullptr);
}

TEST_F(LampFiles, SavedLightsHaveTheSameLamps) {
    write("lamp.csv", "400,1\n500,3\n700,1\n");
    fs::create_directories(folder_ / "saved");
    for (const char* spectrum : {"\"led_white\"", "{\"planck_k\": 2700.5}", "\"lamp.csv\"",
                                 "{\"W\": \"lamp.csv\", \"R\": {\"source\": \"a\", \"filter\": \"red\"}}"}) {
        const LightFile file = lights(spectrum, sectors);
        save_light_file(file, path("saved/lights.json"));
        EXPECT_EQ(load_light_file(path("saved/lights.json")).lights, file.lights) << spectrum;
    }
}

TEST_F(LampFiles, MistakesAreNamedWithTheirPlace) {
    write("bad.csv", "400,1\n500,x\n");
    write("two.json", R"({"planck_k": 2856, "source": "a"})");
    write("self.json", R"({"source": "self.json"})");
    write("glass.spdx", spdx("<SpectralData wavelength=\"400\">1</SpectralData><SpectralData "
                             "wavelength=\"700\">1</SpectralData>",
                             "transmittance"));
    const auto error = [&](const std::string& spectrum, const std::string& rest = white) {
        return message_of([&] { lights(spectrum, rest); });
    };
    EXPECT_NE(error("\"led_wite\"").find(":1:62: unknown spectrum 'led_wite', did you mean 'led_white'?"),
              std::string::npos)
        << error("\"led_wite\"");
    EXPECT_NE(error("\"bad.csv\"").find("bad.csv:2:5: 'x' is not a number"), std::string::npos);
    EXPECT_NE(error("\"none.csv\"").find("none.csv': No such file"), std::string::npos);
    EXPECT_NE(error("\"two.json\"").find("give one of 'table', 'gaussians', 'planck_k' and 'source'"),
              std::string::npos);
    EXPECT_NE(error("\"self.json\"").find("files that name files without an end"), std::string::npos);
    EXPECT_NE(error("\"glass.spdx\"").find("transmittance of a glass"), std::string::npos);
    EXPECT_NE(error("\"planck:5\"").find("no temperature from 1000 to 25000 K"), std::string::npos);
    EXPECT_NE(error("{\"source\": \"a\", \"filter\": \"rde\"}").find("did you mean 'red'?"),
              std::string::npos);
    EXPECT_NE(error("{\"G\": \"a\"}").find("a lamp for green, which the light does not show"),
              std::string::npos);
    EXPECT_NE(error("{\"source\": \"a\", \"filter\": \"red\"}", sectors).find("several colours"),
              std::string::npos);
    const LightFile red = lights("\"a\"", R"("character": "F R", "intensity_cd": 100)");
    ASSERT_EQ(red.warnings.size(), 1U);
    EXPECT_NE(red.warnings[0].find("the lamp of the colour red is white: is a 'filter' missing?"),
              std::string::npos);
}

TEST_F(LampFiles, TheFilesOfTheConfigurationAreGood) {
    LampShelf shelf;
    int files = 0;
    for (const auto& entry : fs::directory_iterator(SEAGLARE_SOURCE_DIR "/config/spectra")) {
        if (!is_lamp_file(entry.path().string())) continue;
        EXPECT_NO_THROW(shelf.lamp({entry.path().string(), ""})) << entry.path();
        ++files;
    }
    EXPECT_GT(files, 2);
}

}  // namespace
}  // namespace seaglare::lightdb
