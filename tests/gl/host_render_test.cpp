// seaglare-host as a user runs it: files and fields it writes, and what it says when it cannot.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "host_stub/gl_objects.h"
#include "host_stub/headless.h"
#include "lightdb/json/value.h"

namespace seaglare::host {
namespace {

const std::string scenes = std::string(SEAGLARE_SOURCE_DIR) + "/config/scenes/";

struct Outcome {
    int status = -1;
    std::string text;  // stdout and stderr
};

Outcome run(const std::string& arguments, const std::string& before = "") {
    const std::string command = before + " " SEAGLARE_HOST_PROGRAM " " + arguments + " 2>&1";
    Outcome result;
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return result;
    char buffer[4096];
    while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe))
        result.text.append(buffer, n);
    const int status = pclose(pipe);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

class Host : public testing::Test {
  protected:
    void SetUp() override {
        folder =
            std::filesystem::temp_directory_path() /
            (std::string("seaglare_host_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    void need_gl() const {
        try {
            const HeadlessContext gl;
        } catch (const GlFailure& e) {
            GTEST_SKIP() << e.what();
        }
    }
    std::filesystem::path folder;
    const std::string with_plugin = " --plugin " SEAGLARE_PLUGIN_FILE;
};

TEST_F(Host, MissingLibraryNamesThePathAndTheLoadersReason) {
    const Outcome r = run("render --scene " + scenes + "thesis_many_lights.json --out " + folder.string() +
                          " --plugin /nowhere/libseaglare.so");
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.text.find("/nowhere/libseaglare.so: "), std::string::npos) << r.text;
    EXPECT_NE(r.text.find("No such file"), std::string::npos) << r.text;
    EXPECT_NE(r.text.find("--plugin"), std::string::npos) << r.text;
}

TEST_F(Host, AFileThatIsNoPluginIsToldApart) {
    const Outcome r = run("render --scene " + scenes + "thesis_many_lights.json --out " + folder.string() +
                          " --plugin libm.so.6");
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.text.find("seaglare_get_api"), std::string::npos) << r.text;
}

TEST_F(Host, MissingSceneNamesThePath) {
    const Outcome r = run("render --scene /nowhere/scene.json --out " + folder.string());
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.text.find("/nowhere/scene.json"), std::string::npos) << r.text;
}

TEST_F(Host, BadSceneIsReportedWithFileLineAndColumn) {
    std::ofstream(folder / "bad.json") << "{\n  \"name\": 5\n}";
    const Outcome r = run("render --scene " + (folder / "bad.json").string() + " --out " + folder.string());
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.text.find("bad.json:2:11:"), std::string::npos) << r.text;
}

TEST_F(Host, UnknownObserverIsAnsweredWithThoseThereAre) {
    const Outcome r = run("render --scene " + scenes +
                          "sonderborg_leading_line.json --observer yellow_sector --out " + folder.string());
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.text.find("red_sector"), std::string::npos) << r.text;
}

TEST_F(Host, RenderWritesEveryFileAndNamesItAndTheContractHolds) {
    need_gl();
    if (IsSkipped()) return;
    const Outcome r =
        run("render --scene " + scenes + "great_belt_night.json --size 320x180 --frames 2 --out " +
            folder.string() + with_plugin);
    ASSERT_EQ(r.status, 0) << r.text;
    for (const char* name : {"before.png", "glare.exr", "after.png", "stats.json", "plan.json"}) {
        EXPECT_GT(std::filesystem::file_size(folder / name), 100U) << name;
        EXPECT_NE(r.text.find("wrote " + (folder / name).string()), std::string::npos) << r.text;
    }
    const json::Document stats = json::parse_file((folder / "stats.json").string());
    for (const char* key : {"scene", "channel", "observer", "size_px", "adaptation_luminance_cd_m2", "gl",
                            "plugin", "timing_ms", "frames"})
        EXPECT_NE(stats.root().find(key), nullptr) << key;
    ASSERT_EQ(stats.root().find("frames")->array().size(), 2U);
    const json::Value* last = stats.root().find("frames")->array()[1].find("stats");
    ASSERT_NE(last, nullptr);
    EXPECT_GT(last->find("lights_drawn")->number(), 0);
    EXPECT_GT(last->find("lights_total")->number(), last->find("lights_drawn")->number());
    json::parse_file((folder / "plan.json").string());
}

TEST_F(Host, ThePictureAfterIsNotThePictureBefore) {
    need_gl();
    if (IsSkipped()) return;
    const Outcome r = run("render --scene " + scenes + "thesis_many_lights.json --size 320x180 --out " +
                          folder.string() + with_plugin);
    ASSERT_EQ(r.status, 0) << r.text;
    EXPECT_NE(std::filesystem::file_size(folder / "before.png"),
              std::filesystem::file_size(folder / "after.png"));
}

TEST_F(Host, BenchReportsMedianAndSpreadWithAndWithoutThePlugin) {
    need_gl();
    if (IsSkipped()) return;
    const Outcome r = run("bench --json --scene " + scenes +
                          "great_belt_night.json --size 160x90 --frames 3" + with_plugin);
    ASSERT_EQ(r.status, 0) << r.text;
    const std::size_t brace = r.text.find('{');
    ASSERT_NE(brace, std::string::npos);
    const json::Document report = json::parse(r.text.substr(brace), "bench");
    const json::Value* timing = report.root().find("timing_ms");
    ASSERT_NE(timing, nullptr);
    for (const char* row : {"frame without the plug-in", "frame with the plug-in"}) {
        ASSERT_NE(timing->find(row), nullptr) << row;
        EXPECT_GT(timing->find(row)->find("median")->number(), 0);
        EXPECT_GE(timing->find(row)->find("p95")->number(), timing->find(row)->find("median")->number());
    }
}

TEST_F(Host, TheWindowOpensAndIsShotUnderXvfb) {
    if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0) GTEST_SKIP() << "no xvfb-run";
    const std::string shot = (folder / "window.png").string();
    const Outcome r =
        run("--window --scene " + scenes + "storebaelt_dusk.json --size 320x180 --frames 2 --screenshot " +
                shot + with_plugin,
            "xvfb-run -a -s '-screen 0 800x600x24'");
    ASSERT_EQ(r.status, 0) << r.text;
    EXPECT_NE(r.text.find("look around"), std::string::npos) << "the help is printed: " << r.text;
    EXPECT_GT(std::filesystem::file_size(shot), 1000U);
}

}  // namespace
}  // namespace seaglare::host
