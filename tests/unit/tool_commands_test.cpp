// What `seaglare-lights` answers, and with which exit status.
#include "lightdb/tool/commands.h"
#include "lightdb/tool/import_command.h"
#include "lightdb/tool/lint_command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "lightdb/json/value.h"

namespace seaglare::lights_tool {
namespace {

class LightsTool : public ::testing::Test {
  protected:
    LightsTool() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() / (std::string("seaglare_lights_") + test->name());
        std::filesystem::create_directories(folder_);
    }
    ~LightsTool() override { std::filesystem::remove_all(folder_); }

    std::string write(const char* name, const std::string& text) const {
        std::string path = (folder_ / name).string();
        std::ofstream(path) << text;
        return path;
    }

    std::filesystem::path folder_;
    std::ostringstream out_;
    std::ostringstream err_;
};

TEST_F(LightsTool, ValidFilesAreCountedAndGiveStatus0) {
    const std::string path = std::string(SEAGLARE_SOURCE_DIR) + "/config/lights/great_belt.json";
    EXPECT_EQ(validate({path}, out_, err_), 0);
    EXPECT_NE(out_.str().find("77 lights"), std::string::npos);
    EXPECT_TRUE(err_.str().empty()) << err_.str();
}

TEST_F(LightsTool, AnUnknownKeyIsNamedWithFileLineAndColumn) {
    const std::string path =
        write("bad.json",
              "{\"lights\": [\n  {\"name\": \"A\", \"lat\": 55, \"lon\": 11, \"height_m\": 5,\n"
              "   \"character\": \"Fl R 3s\", \"nominal_rang_nm\": 5}]}\n");
    EXPECT_EQ(validate({path}, out_, err_), 1);
    EXPECT_NE(err_.str().find(path + ":"), std::string::npos) << err_.str();
    EXPECT_EQ(err_.str().find("(warning)"), std::string::npos);
}

TEST_F(LightsTool, EveryFileIsCheckedAndTheWorstStatusHolds) {
    const std::string good = write("good.json", "{\"lights\": []}\n");
    const std::string bad = write("bad.json", "{\"lights\": [}\n");
    EXPECT_EQ(validate({bad, good}, out_, err_), 1);
    EXPECT_NE(out_.str().find("good.json: 0 lights"), std::string::npos);
    EXPECT_EQ(validate({(folder_ / "none.json").string()}, out_, err_), 2);
}

TEST_F(LightsTool, JsonSaysWhereItEnds) {
    EXPECT_EQ(check_json(write("a.json", "[1, 2, {\"a\": null}]"), err_), 0);
    EXPECT_TRUE(err_.str().empty());
    const std::string torn = write("b.json", "{\n  \"a\": 01\n}");
    EXPECT_EQ(check_json(torn, err_), 1);
    EXPECT_NE(err_.str().find(torn + ":2:"), std::string::npos) << err_.str();
    EXPECT_EQ(check_json((folder_ / "none.json").string(), err_), 2);
}

TEST_F(LightsTool, ACharacterIsExplainedAsJson) {
    ASSERT_EQ(explain_character("Fl(2+1)WRG.10s15m12-9M", out_, err_), 0);
    const json::Document document = json::parse(out_.str(), "out");
    EXPECT_EQ(document.root().find("class")->string(), "Fl(2+1)");
    EXPECT_EQ(document.root().find("colours")->array().size(), 3U);
    EXPECT_DOUBLE_EQ(document.root().find("period_s")->number(), 10);
    EXPECT_DOUBLE_EQ(document.root().find("height_m")->number(), 15);
    double sum = 0;
    for (const json::Value& phase : document.root().find("phases")->array()) {
        const json::Value* lit = phase.find("lit");
        sum += lit != nullptr ? lit->number() : phase.find("eclipse")->number();
    }
    EXPECT_NEAR(sum, 10, 1e-12);
    EXPECT_EQ(explain_character("Flx", out_, err_), 1);
    EXPECT_NE(err_.str().find("at its character 3"), std::string::npos) << err_.str();
}

TEST_F(LightsTool, AnImportWritesAFileThatValidatesAndAReport) {
    const std::string list =
        write("list.json",
              "{\"ngalol\": [{\"featureNumber\": \"2652\\nC1030\", \"name\": \"Nordborg.\", \"position\": "
              "\"55\xC2\xB0"
              "04'36\\\"N \\n9\xC2\xB0"
              "42'42\\\"E\", \"charNo\": 1, \"characteristic\": \"Oc.W.R.G.\\nperiod 5s \\nfl. 4.0s, ec. "
              "1.0s \\n\", "
              "\"heightFeetMeters\": \"88\\n27\", \"range\": \"W. 12 \\nR. 10 \\nG. 10\", \"remarks\": \"R. "
              "010\xC2\xB0-020\xC2\xB0, "
              "W.-030\xC2\xB0, G.-040\xC2\xB0.\\n\", \"noticeYear\": \"2015\", \"noticeWeek\": \"19\"},\n"
              "{\"name\": \"-RACON\", \"characteristic\": \"T(- )\\n\", \"charNo\": 2}]}");
    ImportRequest request;
    request.file = list;
    request.output = (folder_ / "out.json").string();
    request.report = (folder_ / "report.txt").string();
    ASSERT_EQ(import_nga(request, out_, err_), 0) << err_.str();
    EXPECT_TRUE(out_.str().empty());
    EXPECT_EQ(validate({request.output}, out_, err_), 0) << err_.str();
    std::ifstream report(request.report);
    std::string first;
    std::getline(report, first);
    EXPECT_EQ(first, "2 records, of these");
    request.file = (folder_ / "none.json").string();
    EXPECT_EQ(import_nga(request, out_, err_), 2);
    request.file = list;
    request.output = (folder_ / "no" / "such" / "folder.json").string();
    EXPECT_EQ(import_nga(request, out_, err_), 2);
}

TEST_F(LightsTool, LintNamesTheLineOfALightBesideAVessel) {
    const std::string path =
        write("v.json", R"({"vessels": [{"name": "v", "kind": "power_driven", "length_m": 60,
        "breadth_m": 10, "body": 1}], "lights": [
        {"name": "b", "position": [0, 0, 5], "character": "Fl W 5s 12m", "intensity_cd": 5}]})");
    LintRequest request;
    request.files = {path};
    EXPECT_EQ(lint_files(request, out_, err_), 0) << err_.str();
    EXPECT_NE(out_.str().find(path + ":3:9: 'b': height_against_character"), std::string::npos) << out_.str();
}

TEST_F(LightsTool, AnImportWithoutAnOutputFileGoesToStandardOutput) {
    ImportRequest request;
    request.file = write("list.json", "{\"ngalol\": []}");
    ASSERT_EQ(import_nga(request, out_, err_), 0);
    const json::Document document = json::parse(out_.str(), "out");
    EXPECT_EQ(document.root().find("lights")->array().size(), 0U);
    EXPECT_EQ(err_.str().rfind("0 records", 0), 0U);
    EXPECT_EQ(err_.str().find('\x1b'), std::string::npos) << "progress is for terminals";
}

}  // namespace
}  // namespace seaglare::lights_tool
